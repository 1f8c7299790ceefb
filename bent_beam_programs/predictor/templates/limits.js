"use strict";
// From and until when the first instants hold to 2 %: the formulas of theory/validity.py, by the same names.
const Limits = (() => {
  const { abs, sqrt, max, min } = Math, V = VALIDITY;

  /** τ at which the contact's end is so near the beam's that its waves count; in T* first. */
  function ends({ b, contact, slow, timeScale }) {
    const { lambda0, r0 } = contact, twice = (2 * V.distance + lambda0) ** -2;
    let time = max(V.distance + lambda0, V.flat * lambda0) ** -2;
    const swing = 4 * sqrt(2) * abs(b.tension) * b.curvature * slow / (b.mass * b.velocity * r0); // a T*
    if (swing * time > V.tolerance)
      time = min(time, max(V.tolerance / swing, min(twice, sqrt(V.tolerance / (2 * swing)))));
    return time * slow / timeScale;
  }

  /** The smallest τ with |second|τ² = 2 % of |1 + first τ|, or |first|τ no longer small. */
  function expansion(first, second) {
    const small = first ? V.small_change / abs(first) : Infinity, half = 0.5 * V.tolerance * first;
    return second ? min(small, (half + sqrt(half * half + V.tolerance * abs(second))) / abs(second)) : small;
  }

  /** τ at which the second order in the loads counts. */
  function loads({ contact, alpha, n }) {
    const { lambda0, r0, ratio, lambda1, r1 } = contact;
    const { lambda2, r2 } = Theory.second(contact, alpha, n, V.flattest_solved);
    let found = Infinity;
    if (lambda0 > 0) found = min(expansion(r1 / r0, r2 / r0), expansion(lambda1 / lambda0, lambda2 / lambda0));
    else if (n) found = expansion(r1, r2);
    else if (r1 < 0) found = -1 / r1; // the force is gone
    const opening = V.opening_alpha * alpha + V.opening_axial * n;
    return lambda0 === 0 && opening < 0 ? min(found, (ratio - 1) / -opening) : found;
  }

  function damping({ b, contact, timeScale, n }) {
    if (!b.damping) return Infinity;
    if (contact.lambda0 > 0) return Point.spreads(contact.ratio) * b.damping / timeScale;
    return n ? V.tolerance / abs(contact.loads.r[1]) : Infinity;
  }

  /** s after which a wall that gives way acts as a rigid one. */
  function rigidFrom({ b, contact: { ratio, lambda0 } }) {
    if (!b.wallStiffness) return 0;
    const time = sqrt(b.mass / b.wallStiffness), zeta = b.wallDamping / (2 * sqrt(b.wallStiffness * b.mass));
    if (ratio >= 1) return time * max(V.point_time, V.sharp_point_time * ratio ** 0.25);
    if (ratio < V.flattest_settled || zeta < V.least_damped) return Infinity;
    return time * max(V.zone_time, (V.zone_lengths / lambda0) ** 2);
  }

  /** `from`, `until` (s) and what spoils them, `after` and `by`, as theory.validity names it; never: until = 0. */
  function limits(problem, yields) {
    const { b, contact, timeScale, n } = problem, never = (by) => ({ from: 0, until: 0, by, after: null });
    const wall = rigidFrom(problem);
    if (yields && !wall) return never("section");
    const alone = Theory.contact(contact.ratio, problem.alpha);
    const leads = n && abs(contact.r1 - alone.r1) >= abs(alone.r1);
    const list = [
      [ends(problem), "waves back from the ends"], [loads(problem), leads ? "tension" : "first-order correction"],
      [(V.slope_limit / contact.steepest) ** 2, "slope"], [damping(problem), "damping"],
    ];
    const [tau, by] = list.reduce((one, other) => (other[0] < one[0] ? other : one)), until = tau * timeScale;
    const shear = b.shear && (contact.ratio < V.flattest_sheared ? Infinity
      : max(V.forgotten, contact.ratio ** -2) * sqrt(b.stiffness * b.mass) / b.shear);
    const [from, after] = shear > wall ? [shear, "shear"] : [wall, "wall"];
    if (!from) return { from, until, by, after: null };
    if (from >= until || yields) return never(from >= until ? after : "section");
    return { from, until, by, after };
  }

  /** s at which waves from the ends swing the force: without damping its mean, else short waves. */
  function swings({ b, contact: { lambda0 }, slow }) {
    const undamped = (sqrt(20 * sqrt(2) / V.swing) + lambda0) ** -2, decay = 2 * Math.log(2 * sqrt(2) / V.swing);
    return slow * max(undamped, Math.cbrt(b.damping / slow / decay));
  }

  return { ends, limits, swings };
})();
