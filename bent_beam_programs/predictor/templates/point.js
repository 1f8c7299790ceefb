"use strict";
// One point of an endless straight beam that is stopped: what damping and shear do to its force and impulse.
const Point = (() => {
  const { abs, exp, hypot, max, sqrt, PI } = Math;

  /** ₁F₁(a; b; x) e^{−x} for a, b, x > 0. */
  function kummer(a, b, x) {
    let term = exp(-x), sum = term;
    for (let k = 0; abs(term) > 1e-17 * sum || k < x; k++) sum += term *= (a + k) / (b + k) * x / (k + 1);
    return sum;
  }
  const GAMMA = [[1.772453850905516, 3.625609908221908], [0.886226925452758, 0.906402477055477],
    [1.329340388179137, 1.133003096319346]]; // Γ(m + ½), Γ(m + ¼)

  /** Over the values without damping at the age T = t/η: reaction (m = 0), impulse (1), impulse of an acceleration (2)
      (theory/damped_point.py). */
  function damped(age, m) {
    if (!(age < 500)) { // the asymptotic series
      let term = 1, sum = 1;
      for (let k = 0; k < 6 && age < Infinity; k++) sum += term *= (k - 0.25) * (k + 0.5 - m) / ((k + 1) * age);
      return sum;
    }
    return GAMMA[m][0] / GAMMA[m][1] * age ** -0.25 * kummer(m + 0.5, m + 0.25, age);
  }

  const erf = (x) => 2 * x / sqrt(PI) * kummer(1, 1.5, x * x);

  /** erf⁻¹(κ/ν)²: the age at which a damped point spreads. */
  function spreads(ratio) {
    if (ratio >= 1) return Infinity;
    let low = 0, high = 6;
    for (let k = 0; k < 60; k++) { const x = (low + high) / 2; if (erf(x) < ratio) low = x; else high = x; }
    return low * low;
  }

  // With shear: units t_s = √(EIμ)/S, force V₀√(Sμ); Laplace transforms (theory/shear.py).
  const times = ([a, b], [c, d]) => [a * c - b * d, a * d + b * c];
  const over = (x, [c, d]) => times(x, [c / (c * c + d * d), -d / (c * c + d * d)]);
  const plus = ([a, b], [c, d]) => [a + c, b + d];
  const root = ([a, b]) => { // no digit lost to a difference
    const large = sqrt((hypot(a, b) + abs(a)) / 2), small = abs(b) / (2 * large);
    return a >= 0 ? [large, b < 0 ? -small : small] : [small, b < 0 ? -large : large];
  };

  /** Reaction, impulse, shear angle beside the force and curvature that it has bent at t > 0, of g and the damping η/t_s:
      Abate and Whitt's sum (1992). */
  function sheared(t, g, damping) {
    const A = 22, means = 15, count = 30 + Math.floor(2 * t / (PI * sqrt(max(g, 0.01)))), one = [1, 0], sums = [0, 0, 0, 0];
    const found = [0, 0, 0, 0];
    for (let k = 0, binomial = 1; k <= count + means; k++) {
      const s = [A / (2 * t), PI * k / t], D = root(plus(one, times([damping, 0], s))), u = over(s, D);
      const wave = plus(u, root(plus(one, times([g, 0], times(u, u))))), inside = over([-1, 0], times(wave, wave));
      const push = times(over(times([2, 0], D), s), root(plus(one, inside))), sign = (k % 2 ? -1 : 1) * (k ? 1 : 0.5);
      const bent = over(one, times(times(s, wave), D)), kink = over(push, times([2, 0], times(D, D)));
      [push, over(push, s), kink, bent].forEach(([re], i) => { sums[i] += sign * re; });
      if (k < count) continue;
      found.forEach((_, i) => { found[i] += binomial * sums[i] / 2 ** means; });
      binomial *= (means - (k - count)) / (k - count + 1);
    }
    return found.map((value) => value * exp(A / 2) / t);
  }

  return { damped, erf, spreads, sheared };
})();
