"use strict";
// Sentences of the page. What `bentbeam predict` says of the contact and the theory, it says by the same words: WORDS.
const Words = (() => {
  const { unit, quantity } = Form, { text, bar } = Draw;
  const COMMAND = "bentbeam bounce impact.toml";

  /** A number in SI, value × size + shift, with its bar, in the unit that suits. */
  function number(name, { value, bar: error, runs }, size = 1, shift = 0) {
    if (value === null) return "–";
    const here = value * size + shift, [symbol, one] = name ? unit(name, here) : ["", 1];
    const written = error === null ? `${text(here / one, 3)} …` : bar(here / one, error * size / one);
    return [written, symbol, runs ? `(band of ${runs} runs)` : ""].filter(Boolean).join(" ");
  }

  /** What a contact does; contact as the theory, which is without shear, solves it. */
  const verdict = (b, { regime }) => (
    (b.shear && regime === "discrete" ? WORDS.short : WORDS.regimes[regime])
    + (b.wallStiffness ? " This holds for a rigid wall; this wall gives way." : ""));

  /** When the first instants hold. */
  function holding({ from, until, forceUntil, by, after }, b, { regime }) {
    if (!until) return `The theory covers no time: ${WORDS.limits[by]}.`;
    const late = after === "shear" && forceUntil > from, holds = late && forceUntil > 2 * from; // the reaction, too
    const before = WORDS.before[after] + (holds ? WORDS.later : "");
    const start = after ? `from ${quantity("time", from, 3)} (before, ${before}) ` : "";
    const swings = `From ${quantity("time", Math.max(forceUntil, from), 3)} on `
      + "it has no reaction: waves from the ends swing the force.";
    const acting = { loads: b.acceleration || b.tension, shear: b.shear, "the wall’s give": b.wallStiffness };
    const left = Object.keys(acting).filter((name) => acting[name]).join(" and ");
    const point = b.shear && (regime === "discrete" || b.damping) // one point, as yet or for good
      ? " Its half contact is within 2 % only without loads and damping." : "";
    return `The theory holds to 2 % ${start}until ${quantity("time", until, 3)}: then ${WORDS.limits[by]}.`
      + (left && ` Its moment leaves out ${left}.`) + point
      + (late && !holds ? ` ${WORDS.never}` : "") + (forceUntil < until ? ` ${swings}` : "");
  }

  /** The theory's numbers at the end of its range. */
  function atEnd(theory) {
    const { until: t, forceUntil } = theory.limits, { halfLength, force, impulse, stress } = Instants.at(theory, t);
    return `Then, at ${quantity("time", t, 3)}, the half contact length is ${quantity("place", halfLength, 3)}, `
      + (forceUntil < t ? "" : `the force ${quantity("force", force, 3)}, `) + `the impulse ${quantity("impulse", impulse, 3)}`
      + (stress === null ? "." : `, the largest stress so far ${quantity("stress", stress, 3)}.`);
  }

  const percent = (ratio) => `${text(100 * ratio, 2)} %`;

  /** What a reader must know of the numbers; whole: whether every bar is there. */
  function warnings(b, { restitution, moment, force, lastContact = {} }, problem, whole) {
    const wide = (one, least = 0) => one.bar > DOUBTS.wide * Math.max(Math.abs(one.value), least);
    const settled = Answer.converges(problem), wides = whole && settled && (wide(moment) || wide(restitution, DOUBTS.least_restitution));
    const late = whole && settled && lastContact.bar > lastContact.value;
    const pressed = Answer.net(problem) > 0, back = restitution.value !== null && pressed;
    const pull = b.tension * b.length ** 2 / (Math.PI ** 2 * b.stiffness); // over the buckling load
    const bends = pull > 0 ? "straightens it" : "bends it further";
    const [slowest, fastest] = DOUBTS.sound, unreal = b.sound < slowest || b.sound > fastest;
    const ratio = b.damping / Beam.dampingTime(b, b.length, 1), sunk = b.velocity * Math.sqrt(b.mass / b.wallStiffness);
    const ofWall = b.wallDamping / (2 * Math.sqrt(b.wallStiffness * b.mass));
    const said = [
      [!settled, "Without damping the outcome is irregular and does not converge: a band is given."],
      [!settled, `${COMMAND} takes more runs for it.`],
      [wides, "The bars are wide: elements, steps and contact law decide here."],
      [late, "It is not sure whether the beam touches the wall once more: the last contact may be much earlier or later, and the rebound may change by more than its bar."],
      [wides || late, `${COMMAND} --set hermite.refine=2 takes finer elements.`],
      [!b.shear, "Short waves are faster without shear; this page takes few elements, and its bars count that."],
      [whole && restitution.value === null, (pressed ? "The loads keep the beam on the wall" : "A run ended with the beam at the wall") + ": no restitution is given."],
      [whole && (moment.value === null || force.value === null), "A largest value still rises when the run ends: it is not given."],
      [back, "The loads bring the beam back to the wall; these numbers are those of the first hit."],
      [(b.curvature - b.wallCurvature) * b.length / 2 >= DOUBTS.steep, "The bow is steep: all this is for small slopes."],
      [Math.abs(pull) > DOUBTS.straightened && b.naturalCurvature === b.curvature, `The bow is not in equilibrium under the axial force, which ${bends}.`],
      [b.tension, `Stresses include ${quantity("stress", Beam.stress(b, 0), 4)} of the axial force.`],
      [b.length < DOUBTS.stubby * b.gyration, `The beam is only ${text(b.length / b.gyration, 2)} radii of gyration long.`],
      [ratio >= DOUBTS.overdamped, `The material damps the first mode with a ratio of ${text(ratio, 2)}, which is no material’s: its field is in percent.`],
      [b.wallStiffness && ofWall > 1, `The wall’s damping ratio is ${text(ofWall, 3)}, beyond critical: its field is in percent.`],
      [b.wallStiffness && sunk > DOUBTS.sunk * b.length, `The wall gives way by some ${quantity("length", sunk, 2)}, the beam is ${quantity("length", b.length)} long: look at the wall’s stiffness.`],
      [unreal, `A speed of sound of ${text(b.sound, 3)} m/s, √(E/ρ), is no material’s: look at modulus and density.`],
      [!unreal && b.strain > DOUBTS.stretched, `The axial force strains the section by ${text(b.strain, 2)}: look at its unit.`],
      [b.weightAdded, "The added mass weighs, too, and no buoyancy is taken off: in a fluid give gravity times the submerged weight over that of all."],
    ];
    return said.filter(([is]) => is).map(([, sentence]) => sentence);
  }

  return { COMMAND, number, verdict, holding, atEnd, percent, warnings };
})();
