"use strict";
// From and until when the first instants hold: formulas, of the undamped theory.
const Limits = (() => {
  const { sqrt, max } = Math;
  const V = VALIDITY; // the constants of `theory.validity`
  const AGE = 1 / (8 * V.tolerance); // t/η from which one point's impulse is that without damping

  /** Until when, s, by cause. */
  function until({ contact, timeScale, slow }) {
    const { lambda0, change, steepest } = contact;
    return {
      ends: slow / max(lambda0 + V.distance, V.flat * lambda0) ** 2,
      loads: sqrt(V.tolerance) / change * timeScale, // the second order is about the square of the first
      slope: (V.slope / steepest) ** 2 * timeScale,
    };
  }

  /** Times √(EIμ)/(κ_s G A) after which Euler and Bernoulli's beam is Timoshenko's. */
  function shearTimes({ regime, ratio, lambda0 }) {
    if (regime === "discrete") return V.shear_point;
    return ratio < V.flattest_sheared ? Infinity : max(V.shear_zone, (V.shear_lengths / lambda0) ** 2, ratio ** -2);
  }

  /** From when, s, by cause. */
  function from({ b, contact }) {
    const point = contact.regime === "discrete";
    return {
      shear: shearTimes(contact) * sqrt(b.stiffness * b.mass) / b.shear,
      damping: b.damping === 0 ? 0 : point ? AGE * b.damping : Infinity, // a zone has no such formula
    };
  }

  /** `from` and `until` (s) with the cause of each; from ≥ until where the first instants hold at no time; sheared: even without damping. */
  function limits(problem) {
    const ends = until(problem), starts = from(problem);
    const last = Object.keys(ends).reduce((a, b) => (ends[a] <= ends[b] ? a : b));
    const first = Object.keys(starts).reduce((a, b) => (starts[a] >= starts[b] ? a : b));
    return { from: starts[first], after: first, until: ends[last], by: last, sheared: starts.shear >= ends[last] };
  }

  return { limits };
})();
