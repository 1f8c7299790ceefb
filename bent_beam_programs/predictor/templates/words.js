"use strict";
// Sentences of the page.
const Words = (() => {
  const REGIMES = {
    discrete: ["Contact stays one point.", "The beam is too curved, or too slow, for the contact to spread (κ/ν ≥ 1)."],
    continuous: ["Contact spreads.", "It grows with √t, and a concentrated force travels with each of its ends."],
    detached: ["Contact spreads as two points.", "They move apart while the middle lifts off the wall between them."],
  };
  const CAUSES = {
    ends: "waves come back from the beam’s ends",
    loads: "the loads change the contact by more than a small correction",
    slope: "the beam’s slopes are no longer small",
    shear: "shear deformation, which is not modelled, matters",
    damping: "material damping matters",
  };
  const YIELDS = "The largest stress exceeds the yield stress: a real beam would deform plastically. "
    + "All numbers are those of an elastic beam.";
  const GIVES_WAY = "0.03 %, for an undamped wall and an infinite beam without loads. It grows with the fourth root of "
    + "the stiffness. All other numbers are those of a rigid wall.";
  const SIMULATE = "simulate it: bentbeam predict impact.toml";
  const SHEARED = "not known, for the simulations do not model shear deformation either";

  return { REGIMES, CAUSES, YIELDS, GIVES_WAY, SIMULATE, SHEARED };
})();
