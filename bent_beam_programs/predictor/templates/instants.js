"use strict";
// The first instants of an impact as the theory has them (theory/prediction.py), SI.
const Instants = (() => {
  const { abs, asinh, min, sqrt, tanh, PI } = Math;

  /** Contact parameters, scales, largest moment and range of the theory; b without a stated damping: of none. */
  function solve(given) {
    const b = { ...given, damping: given.damping || 0 }, c = sqrt(b.stiffness / b.mass), half = b.length / 2;
    const timeScale = c / b.velocity ** 2, slow = half * half / c;
    const alpha = b.acceleration * timeScale / b.velocity, n = b.tension / (b.mass * b.velocity ** 2);
    const contact = Theory.contact((b.curvature - b.wallCurvature) * c / b.velocity, alpha, n);
    const solved = { b, c, half, timeScale, slow, alpha, n, contact };
    const moment = bending(solved, contact, 1, true), stress = Beam.stress(b, moment);
    const limits = Limits.limits(solved, b.yieldStress && stress > b.yieldStress);
    limits.forceUntil = given.damping === null ? limits.until : min(limits.until, Limits.swings(solved));
    return { ...solved, moment, stress, limits, reflected: Limits.ends(solved) * timeScale };
  }

  /** Largest bending moment, N m; of a damped point with `factor` of that at the contact, null where it is not `known`
      ahead of it and may be larger there. */
  function bending({ b }, { moment }, factor, known) {
    const unit = b.velocity * sqrt(b.stiffness * b.mass), before = b.stiffness * (b.naturalCurvature - b.curvature);
    const behind = Math.max(abs(before + unit * moment.contact * factor), abs(before));
    const ahead = abs(before - unit * moment.ahead * factor);
    return ahead > behind && !known ? null : Math.max(behind, ahead);
  }

  /** Half length (shear lengths) of a sheared zone, long after shear waves: X − coth X = gap, by halving. */
  function rim(ratio, lambda0, t) {
    const gap = ratio < 1 ? lambda0 * sqrt(t) : (1 - ratio) * sqrt(PI * t / 2);
    let low = 1e-3 / (1 + abs(gap)), high = 2 + abs(gap);
    for (let k = 0; k < 60; k++) { const x = (low + high) / 2; if (x - 1 / tanh(x) < gap) low = x; else high = x; }
    return low;
  }

  /** Leading order of a beam that shears: half length, √t times force, impulse (theory/shear.py). */
  function sheared(ratio, { lambda0, r0, point }, g, t, damping) {
    const early = t <= 0.5 / ratio, push = 2 * sqrt(2 / PI);
    const place = early ? sqrt(2 * t / ratio) : rim(point ? Math.max(ratio, 1) : ratio, lambda0, t);
    if (point && t <= 500 && (damping > 0 || !early)) { // the zone of one point
      const [R, J, kink, bent] = Point.sheared(t, g, damping), held = ratio > bent ? asinh(kink / (ratio - bent)) : Infinity;
      if (held < place) return [held, R * sqrt(t), J];
    }
    if (early) return [place, place / sqrt(t), 2 * place];
    if (!point) return [place, push * r0, 2 * push * r0 * sqrt(t)];
    if (t <= 500) { const [R, J] = Point.sheared(t, g, damping); return [place, R * sqrt(t), J]; }
    const lag = (3 - g) / (8 * t), age = t / damping;
    return [place, push * Point.damped(age, 0) * (1 + lag), 2 * push * Point.damped(age, 1) * (1 - lag) * sqrt(t)];
  }

  /** Half contact length, force, impulse, moment and stress at t > 0; null where the contact does not exist. */
  function at(p, t) {
    const { b, c, timeScale, alpha, n } = p, tau = t / timeScale, age = t / b.damping, root = sqrt(c * t);
    const single = age <= min(Point.spreads(p.contact.ratio), 1e12); // one point as yet
    const contact = single && p.contact.lambda0 > 0 ? Theory.contact(1, alpha, n) : p.contact;
    const { lambda0, lambda1, r0, r1, uniform } = contact;
    const [ofForce, ofImpulse, ofLoad] = single ? [0, 1, 2].map((m) => Point.damped(age, m)) : [1, 1, 1];
    const momentum = b.mass * b.velocity, front = 2 * Theory.s * momentum * root;
    const pressure = uniform * momentum / timeScale;
    let halfLength = root * (lambda0 + lambda1 * tau);
    let force = front * (ofForce * r0 + ofImpulse * r1 * tau) / t;
    let impulse = 2 * front * (ofImpulse * r0 + ofLoad * r1 * tau / 3)
      + 4 * pressure * root * t * (lambda0 / 3 + lambda1 * tau / 5);
    const exists = lambda0 + lambda1 * tau >= 0 && r0 + r1 * tau > 0 && halfLength <= p.half;
    if (b.shear) { // its own leading order in place of Euler and Bernoulli's
      const length = sqrt(b.stiffness / b.shear), time = length * length / c;
      const unit = b.velocity * sqrt(b.shear * b.mass), g = b.turning / b.mass / length ** 2;
      const zone = { lambda0, r0, point: lambda0 === 0 };
      const [X, R, J] = sheared(p.contact.ratio, zone, g, t / time, b.damping / time);
      halfLength += length * X - root * lambda0;
      force += unit * R / sqrt(t / time) - front * ofForce * r0 / t;
      impulse += unit * time * J - 2 * front * ofImpulse * r0;
    }
    force += 2 * halfLength * pressure;
    if (b.wallStiffness && lambda0 > 0) { // the rim runs ahead of the force
      const spread = b.shear ? sqrt(b.stiffness / b.shear) : 0;
      halfLength += Math.hypot(Math.SQRT2 * (b.stiffness / b.wallStiffness) ** 0.25, spread) - spread;
      halfLength = min(halfLength, p.half);
    }
    const factor = single ? Point.erf(sqrt(min(age, 100))) : 1, known = !single || age >= VALIDITY.ahead_from;
    const moment = bending(p, contact, factor, known);
    return { exists, halfLength, force, impulse, moment, stress: moment === null ? null : Beam.stress(b, moment) };
  }

  return { solve, at };
})();
