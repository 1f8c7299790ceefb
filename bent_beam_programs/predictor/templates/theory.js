"use strict";
// The theory as Python wrote it: COEFFICIENTS of Chebyshev polynomials (predictor/coefficients.py says in which
// variable and why). Units of the fast layer: EI = μ = V₀ = 1, ν = 1. Of a single point, κ/ν ≥ 1, all are limits at 1.
const Theory = (() => {
  const { abs, max, min, sqrt, PI } = Math;
  const s = sqrt(2 / PI), { breaks, middle, functions } = COEFFICIENTS;

  /** Σ c_k T_k(x) by Clenshaw's rule. */
  function clenshaw(c, x) {
    let b1 = 0, b2 = 0;
    for (let k = c.length - 1; k > 0; k--) [b1, b2] = [c[k] + 2 * x * b1 - b2, b1];
    return c[0] + x * b1 - b2;
  }

  /** (1 + b)^power Σ c_k T_k(u), u = (b − 3)/(b + 3), in the interval of u that holds it. */
  function value({ power, pieces }, b) {
    const u = (b - middle) / (b + middle);
    let i = 0;
    while (i < pieces.length - 1 && u >= breaks[i + 1]) i++;
    const [low, high] = [breaks[i], breaks[i + 1]];
    return (1 + b) ** power * clenshaw(pieces[i], (2 * u - low - high) / (high - low));
  }

  /** The number `name` at κ/ν; ν/κ − 1 = √(2/π) b + b²/2. */
  function number(name, ratio) {
    const target = ratio < 1 ? (1 - ratio) / ratio : 0;
    return value(functions[name], 2 * target / (s + sqrt(s * s + 2 * target)));
  }

  /** Regime, λ₀, r₀ and, with everything, λ₁ and r₁. n: N/(μV₀²); α is that of the true free motion. */
  function contact(ratio, alpha = 0, n = 0) {
    // The beam is straight in the zone, where the tension no longer holds it back: the wall carries α′ = α + nκ.
    let pushed = alpha + n * ratio;
    if (abs(pushed) <= 16 * Number.EPSILON * (abs(alpha) + abs(n * ratio))) pushed = 0;
    const point = !(ratio < 1), regime = point ? "discrete" : pushed >= 0 ? "continuous" : "detached";
    const parts = point ? { lambda: [0, 0], r: [2 * pushed, n * (0.5 - 2 * ratio)] } : {
      lambda: [pushed * number(`lambda1_${regime}`, ratio), n * number("lambda_axial", ratio)],
      r: [pushed * number(`r1_${regime}`, ratio), n * number("r_axial", ratio)],
    };
    const lambda0 = point ? 0 : number("lambda0", ratio), r0 = point ? 1 : number("r0", ratio);
    const sum = ([a, b]) => a + b;
    return {
      ratio, regime, lambda0, r0, lambda1: sum(parts.lambda), r1: sum(parts.r),
      uniform: regime === "continuous" ? pushed : 0, // reaction per length in the zone
      loads: parts, moment: { contact: point ? 1 : ratio, ahead: number("moment_ahead", ratio) },
      steepest: number("steepest", ratio), // |slope|/√τ that the impact adds
    };
  }

  /** λ₂ and r₂ of the loads α and n; flatter contacts than `flattest` are like it with other loads. */
  function second({ ratio, regime, lambda0, r0 }, alpha, n, flattest) {
    const like = max(min(ratio, 1), flattest), flatter = min(ratio, 1) / like, here = n * flatter;
    const kind = regime === "detached" ? "detached" : "continuous";
    const sum = (order) => number(`${order}_alpha_${kind}`, like) * alpha ** 2
      + number(`${order}_both_${kind}`, like) * alpha * here + number(`${order}_axial_${kind}`, like) * here ** 2;
    const grown = (name, value) => (flatter < 1 ? value / number(name, like) : 1);
    return { lambda2: sum("lambda2") * grown("lambda0", lambda0), r2: sum("r2") * grown("r0", r0) };
  }

  return { s, contact, second };
})();
