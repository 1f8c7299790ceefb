"use strict";
// The theory in the browser: the closed forms of theory/, in the units of the fast layer (EI = μ = V₀ = 1, ν = 1).
// Numbers in parentheses are equations of A. Delcourt's thesis; docs/theory.md derives what is not in it.
const Theory = (() => {
  const { abs, sqrt, exp, log, cos, sin, atan2, hypot, PI } = Math;
  const s = sqrt(2 / PI);

  // --- φ functions (A.5) ---------------------------------------------------------------------------------------
  // All twelve are combinations of φ_ν = 2f and φ_κ = 2g, the auxiliary Fresnel functions at λ/√(2π). The closed forms
  // cancel for large λ; from λ = 1.5 on the moments
  //     I_k(q) = (√2/π) ∫₀^∞ e^{−qt} t^{k−1/2}/(1 + t²) dt,   q = λ²/4,   φ_ν = I₀,   φ_κ = I₁
  // take their place (theory/phi.py). With t = v²/q the trapezoidal rule converges to round-off in 89 points.
  const SWITCH = 1.5, STEP = 0.09, NODES = 89;

  /** q^{k+1/2} I_k(q) for k = 0…6. */
  function scaledMoments(q) {
    const moments = new Array(7).fill(0);
    for (let i = 0; i < NODES; i++) {
      const v2 = (i * STEP) ** 2;
      let term = (i ? 1 : 0.5) * exp(-v2) / (1 + (v2 / q) ** 2);
      for (let k = 0; k < 7; k++, term *= v2) moments[k] += term;
    }
    return moments.map((sum) => 2 * STEP * sqrt(2) / PI * sum);
  }

  /** Fresnel integrals C and S at λ/√(2π) by their power series, λ < 1.5. */
  function fresnel(x) {
    const q = x * x / 4;
    let c = 0, si = 0;
    for (let n = 0, term = 1; n < 12; n++) {
      c += term / (4 * n + 1);
      term *= q / (2 * n + 1);
      si += term / (4 * n + 3);
      term *= -q / (2 * n + 2);
    }
    return [x / sqrt(2 * PI) * c, x / sqrt(2 * PI) * si];
  }

  /** Every φ at one λ ≥ 0, and the differences that vanish in a limit where their two terms do not. */
  function phi(x) {
    if (x < SWITCH) {
      const [C, S] = fresnel(x), co = cos(x * x / 4), si = sin(x * x / 4);
      const nu = co * (1 - 2 * S) - si * (1 - 2 * C), kappa = co * (1 - 2 * C) + si * (1 - 2 * S);
      const root = sqrt(2 * PI), p = sqrt(PI / 8) * x * nu;
      return {
        nu, kappa, p, pdot: x * kappa, oneMinusP: 1 - p,
        nuMinusKappa: 2 * ((C - S) * co - (1 - C - S) * si),
        alpha: nu - x ** 2 / 2 * kappa,
        lambda: 0.75 * x ** 2 * kappa - x ** 3 / (2 * root) + x ** 4 / 8 * nu,
        kappadot: kappa - s * x + x ** 2 / 2 * nu,
        lambdadot: 4 * s * x - 3 * x ** 2 * nu + x ** 4 / 2 * kappa,
        q: s * x ** 3 + (x ** 6 - 36 * x ** 2) / 24 * kappa + (12 - 7 * x ** 4) / 12 * nu,
        t: x ** 3 / 3 * nu + x * (12 - x ** 4) / 24 * kappa - x ** 2 / root,
        rPlusLambdaKappa: x ** 3 * (x ** 4 - 84) / 192 * nu + x * (3 * x ** 4 - 12) / 32 * kappa
          - x ** 2 * (x ** 4 - 60) / (48 * root),
        kappaMinusS: -(x ** 2) * (36 - x ** 4) / 48 * nu + x ** 4 / 4 * kappa - x * (x ** 4 - 24) / (12 * root),
      };
    }
    const q = x * x / 4, m = scaledMoments(q), scale = sqrt(PI / 2);
    return {
      nu: m[0] / sqrt(q), kappa: m[1] * q ** -1.5, p: scale * m[0], pdot: 2 * m[1] / q,
      oneMinusP: scale * m[2] / q ** 2,
      nuMinusKappa: (m[0] - m[1] / q) / sqrt(q),
      alpha: (2 * m[3] - m[2]) * q ** -2.5,
      lambda: (2 * m[4] - 3 * m[3]) * q ** -2.5,
      kappadot: (m[1] - 2 * m[2]) * q ** -1.5,
      lambdadot: (12 * m[2] - 8 * m[3]) * q ** -1.5,
      q: (8 / 3 * m[5] - 28 / 3 * m[4] + 6 * m[3] - m[2]) * q ** -2.5,
      t: (4 / 3 * m[3] - 8 / 3 * m[2] + m[1]) / q,
      rPlusLambdaKappa: (2 / 3 * m[4] - 3 * m[3] + 3.5 * m[2] - 0.75 * m[1]) / q,
      kappaMinusS: (4 / 3 * m[4] - 4 * m[3] + 3 * m[2]) * q ** -1.5,
    };
  }

  // --- contact zone and reactions ------------------------------------------------------------------------------

  /** λ₀: φ_κ(λ₀)/φ_ν(λ₀) = κ/ν < 1 (2.6.21), by Newton's method for log λ₀. */
  function frontAtLeadingOrder(ratio) {
    const target = (1 - ratio) / ratio;
    let y = log(2 * target / (s + sqrt(s * s + 2 * target)));
    for (let i = 0; i < 30; i++) {
      const x = exp(y), f = phi(x), fall = s * f.oneMinusP; // −φ_κ′ = s(1 − φ_p), φ_ν′ = −(λ/2)φ_κ
      const step = log(f.nuMinusKappa / (target * f.kappa))
        / (x * ((fall - x / 2 * f.kappa) / f.nuMinusKappa + fall / f.kappa));
      y -= step;
      if (abs(step) < 1e-10) break;
    }
    return exp(y);
  }

  /** (r₁, λ₁) in continuous contact, α + ψ ≥ 0 (2.7.40), by Cramer's rule. */
  function continuous(x, r0, f, alpha, psi, chi, pushed) {
    const near = x < 1; // pushed: α + ψ
    const deflection = near ? 2 * alpha - 2 * pushed * f.p : 2 * pushed * f.oneMinusP - 2 * psi;
    const curvature = 4 * chi + sqrt(2 * PI) * pushed * f.pdot;
    const spread = near
      ? 4 * alpha * f.kappadot + 4 * chi * f.alpha
        + pushed * x ** 2 * (2 * f.nu - sqrt(PI / 2) * x * (f.kappa ** 2 + f.nu ** 2))
      : f.alpha * curvature + 2 * f.kappadot * deflection;
    const determinant = f.alpha * f.lambdadot - 4 * f.lambda * f.kappadot;
    return [(f.lambdadot * deflection + 2 * f.lambda * curvature) / determinant, x / r0 * spread / determinant];
  }

  /** (r₁, λ₁) when the middle lifts off, α + ψ < 0 (2.7.71). */
  function detached(x, r0, f, alpha, psi, chi) {
    const q = f.q / 4, deflection = psi * x ** 4 / 24 + chi * x ** 2 / 2 + alpha / 2, slope = psi * x ** 3 / 6 + chi * x;
    const determinant = q * f.kappaMinusS + f.t * f.rPlusLambdaKappa;
    return [
      (f.kappaMinusS * deflection - f.rPlusLambdaKappa * slope) / determinant,
      (q * slope + f.t * deflection) / (determinant * r0),
    ];
  }

  /** (r_N, λ_N): the response to a tension of n = 1 in free flight (docs/theory.md, tension). */
  function tension(x, r0, f) {
    if (x >= SWITCH) {
      const share = -s * r0 / x * f.oneMinusP;
      const [r, lambda] = continuous(x, r0, f, 0, 0, 1, 0);
      return [share * r, share * lambda + 1 / x];
    }
    const a = f.nu, b = f.kappa;
    const determinant = 4 * s * a + 2 * s * x ** 2 * b + s * x ** 4 * a - s ** 2 * x ** 3 - (a * a + b * b) * (3 * x + x ** 5 / 4);
    return [
      r0 * (x * a - 2 * s) * (6 * b - 2 * s * x + x * x * a) / (2 * determinant),
      (-a * a - 3 * b * b + 4 * s * x * b + s * x ** 3 * a - s ** 2 * x ** 2 - x ** 2 * a * b - x ** 4 * (a * a + b * b) / 4)
        / determinant,
    ];
  }

  /** Regime, λ₀, r₀ and, with everything, λ₁ and r₁. `n` is N/(μV₀²); α is that of the true free motion. */
  function contact(ratio, alpha = 0, psi = 0, chi = 0, n = 0) {
    // In the zone the beam is straight, so the tension no longer holds it back: the wall carries α′ + ψ, α′ = α + nκ.
    const raised = alpha + n * ratio, terms = abs(alpha) + abs(n * ratio) + abs(psi);
    let pushed = raised + psi;
    if (abs(pushed) <= 16 * Number.EPSILON * terms) pushed = 0;
    const discrete = !(ratio < 1), regime = discrete ? "discrete" : pushed >= 0 ? "continuous" : "detached";
    const lambda0 = discrete ? 0 : frontAtLeadingOrder(ratio), f = phi(lambda0), r0 = discrete ? 1 : 1 / f.nu;
    const [rN, lambdaN] = discrete ? [0.5 - 2 * ratio, 0] : tension(lambda0, r0, f);
    let r1 = 2 * alpha + n / 2, lambda1 = 0; // of a single point: 2α′ + n r_N
    if (!discrete) {
      [r1, lambda1] = (pushed >= 0 ? continuous : detached)(lambda0, r0, f, raised, psi, chi, pushed);
      r1 += n * rN;
      lambda1 += n * lambdaN;
    }
    return { ratio, alpha, raised, psi, chi, n, regime, lambda0, r0, lambda1, r1, rN, lambdaN,
      uniform: regime === "continuous" ? pushed : 0 };
  }

  // --- the beam's shape ----------------------------------------------------------------------------------------
  // Complex numbers are pairs [re, im].
  const times = (a, b) => [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]];
  const by = (c, a) => [c * a[0], c * a[1]];
  const minus = (a, b) => [a[0] - b[0], a[1] - b[1]];
  const inverse = (a) => by(1 / (a[0] * a[0] + a[1] * a[1]), [a[0], -a[1]]);
  const turn = (angle) => [cos(angle), sin(angle)];
  const T = by(0.5, turn(-PI / 4)), T2 = times(T, T), T3 = times(T2, T); // z = T x

  const root = (a) => {
    const size = hypot(a[0], a[1]), re = sqrt((size + abs(a[0])) / 2), im = a[1] / (2 * re);
    return a[0] >= 0 ? [re, im] : [abs(im), a[1] < 0 ? -re : re];
  };

  /** e^{z²} iᵐerfc(z), m = 0…6, at z = e^{−iπ/4}x/2, x ≥ 0: by recurrence, upwards near 0, else their ratios downwards. */
  function iteratedErfc(x) {
    const z = by(x, T), twice = by(2, z), f = phi(x), list = [[(f.nu + f.kappa) / 2, (f.nu - f.kappa) / 2]];
    if (x < 2) {
      list.push(minus([1 / sqrt(PI), 0], times(z, list[0])));
      for (let m = 2; m <= 6; m++) list.push(by(1 / (2 * m), minus(list[m - 2], by(2, times(z, list[m - 1])))));
      return list;
    }
    const last = 30 + Math.trunc(880 / (x * x)), ratios = [], z2 = times(z, z);
    let ratio = root([z2[0] + 2 * last, z2[1]]);
    ratio = inverse([z[0] + ratio[0], z[1] + ratio[1]]);
    for (let m = last; m > 0; m--) {
      ratio = inverse([twice[0] + 2 * m * ratio[0], twice[1] + 2 * m * ratio[1]]);
      ratios[m - 1] = ratio;
    }
    for (let m = 1; m <= 6; m++) list.push(times(list[m - 1], ratios[m]));
    return list;
  }

  /** The complex A with Re[A a] = p and Re[A b] = q. */
  function amplitude(a, p, b, q) {
    const determinant = a[1] * b[0] - a[0] * b[1];
    return [(a[1] * q - b[1] * p) / determinant, (a[0] * q - b[0] * p) / determinant];
  }

  /** B at the front: E‴ = s r₀ and E″ = −κ there, E′ = 0 in place of the second for a single point. */
  function leadingAmplitude(c, front) {
    const jump = by(-2 / sqrt(PI), T3);
    return c.regime === "discrete"
      ? amplitude(by(-1, times(T, front[1])), 0, jump, s * c.r0)
      : amplitude(times(T2, front[0]), -c.ratio, jump, s * c.r0);
  }

  /**
   * η = τE(x) + τ²E₁(x), x = ξ/√τ: what the wall does to the beam. Ahead of the front
   *     E = Re[B i²erfc z],     E₁ = Re[B₁ i⁴erfc z] + (n/2) Im[B i²erfc z],
   * with B from E″ = −κ, E‴ = s r₀ and B₁ from w = 0, w_ξ = 0 at the front. Behind it w = 0 in continuous contact; where
   * the middle lifts off, w = τ² Q (x² − λ₀²)²/24 with Q(1 + λ₀⁴/12) = α′ + ψ.
   */
  function shape(c) {
    const x0 = c.lambda0, front = iteratedErfc(x0), at = (m, factor) => times(factor, front[m]);
    const B = leadingAmplitude(c, front);
    const F = times(B, front[2])[1], F1 = -times(B, times(T, front[1]))[1]; // Im of the wave, and its slope
    const value = c.alpha / 2 + c.chi * x0 ** 2 / 2 + c.psi * x0 ** 4 / 24, slope = c.chi * x0 + c.psi * x0 ** 3 / 6;
    const B1 = amplitude(front[4], value - c.n * F / 2, by(-1, at(3, T)), slope - c.n * F1 / 2);
    const lift = c.regime === "detached" ? (c.raised + c.psi) / (1 + x0 ** 4 / 12) : 0;
    return { c, B, B1, lift };
  }

  /** Deflection w/τ (positive into the wall, so the gap is −w) and bending, η_ξξ, at x = ξ/√τ and time τ. */
  function beamAt(form, x, tau) {
    const { c, B, B1, lift } = form;
    if (x < c.lambda0) {
      const y = x * x - c.lambda0 ** 2;
      return [tau * lift * y * y / 24, -c.ratio + tau * (c.psi * x * x / 2 + c.chi - lift * (3 * x * x - c.lambda0 ** 2) / 6)];
    }
    const wave = turn((x * x - c.lambda0 ** 2) / 4), list = iteratedErfc(x).map((value) => times(wave, value));
    const second = times(B, list[2]), free = 1 - c.ratio * x * x / 2
      + tau * (c.psi * x ** 4 / 24 + c.chi * x * x / 2 + c.alpha / 2);
    const eta = second[0] + tau * (times(B1, list[4])[0] + c.n / 2 * second[1]);
    const bent = times(times(B, T2), list[0]);
    return [free - eta, bent[0] + tau * (times(times(B1, T2), list[2])[0] + c.n / 2 * bent[1])];
  }

  /**
   * Largest bending moment M/(V₀√(EIμ)) at leading order, and where, x = ξ/√τ (0: in the contact). The wall bends the
   * beam by κ in the zone, by 1 at a single point. Ahead of it E‴ = ρ cos((x² − λ₀²)/4 + θ); the first zero of that is
   * where E″ is largest (theory/moment.py).
   */
  function peakMoment(c) {
    const jump = by(-2 / sqrt(PI), T3), rise = s * c.r0, discrete = c.regime === "discrete";
    const row = times(times(T2, iteratedErfc(c.lambda0)[0]), inverse(jump));
    const bent = discrete ? 1 : c.ratio, swing = (rise * row[0] + bent) / row[1];
    const place = sqrt(c.lambda0 ** 2 + 4 * atan2(rise, swing));
    const crest = hypot(rise, swing) * times(times([0, 1], T2), times(iteratedErfc(place)[0], inverse(jump)))[0];
    const found = { crest, contact: bent, ahead: place };
    return Object.assign(found, crest > bent ? { moment: crest, at: place } : { moment: bent, at: 0 });
  }

  // --- second order and validity -------------------------------------------------------------------------------

  /** x of the 2 × 2 system with columns a, b and right-hand side c. */
  function solve2(a, b, c) {
    const determinant = a[0] * b[1] - a[1] * b[0];
    return [(c[0] * b[1] - c[1] * b[0]) / determinant, (a[0] * c[1] - a[1] * c[0]) / determinant];
  }
  const add = (...lists) => lists[0].map((_, i) => lists.reduce((sum, list) => sum + list[i], 0));
  const scaled = (factor, list) => list.map((value) => factor * value);

  /** λ₂ and r₂: conditions at the moved front in τ², order by order (theory/second_order.py). */
  function secondOrder(c) {
    const { lambda0: x, n, alpha, psi, chi, ratio: kappa } = c, jump = s * c.r0;
    const list = iteratedErfc(x), z = by(x, T), erfc = { "-1": [2 / sqrt(PI), 0] };
    erfc[-2] = by(2, times(z, erfc[-1]));
    erfc[-3] = minus(by(2, times(z, erfc[-2])), by(2, erfc[-1]));
    list.forEach((value, m) => { erfc[m] = value; });
    const turns = [[1, 0]];
    for (let m = 1; m < 6; m++) turns.push(times(turns[m - 1], by(-1, T)));
    /** i^{order}erfc and its derivatives 0…5 in x; Re[factor · those]. */
    const wave = (order) => turns.map((t, m) => times(t, erfc[order - m]));
    const real = (factor, w) => w.map((value) => times(factor, value)[0]);
    const w0 = wave(2), w1 = wave(4), w2 = wave(6), B0 = leadingAmplitude(c, list);
    const fifth = times(B0, w0[5])[0], halfN = [0, -n / 2];

    const free1 = [alpha / 2 + chi * x ** 2 / 2 + psi * x ** 4 / 24, chi * x + psi * x ** 3 / 6, chi + psi * x ** 2 / 2, psi * x, psi];
    const free2 = [n * (chi / 6 + psi * x ** 2 / 4), n * psi * x / 2, n * psi / 2, 0, 0];
    /** (B, λ, r) with Re[B w] + rest = 0, 0, −λ·jump, s r in derivatives 0…3. */
    function system(w, rest) {
      const amplitudeHere = amplitude(w[0], -rest[0], w[1], -rest[1]), left = real(amplitudeHere, w);
      return [amplitudeHere, x > 0 ? -(left[2] + rest[2]) / jump : 0, (left[3] + rest[3]) / s];
    }

    const rest1 = add(real(times(halfN, B0), w0).slice(0, 5), scaled(-1, free1)), detached = c.regime === "detached";
    let a1 = 0, b1 = 0, middle1 = [0, 0, 0, 0, 0];
    if (detached) {
      const quartic = [1 - x ** 4 / 12, -(x ** 3) / 3, -x * x, -2 * x, -2], square = [x * x, 2 * x, 2, 0, 0];
      const inside = add([-n * kappa / 2, 0, 0, 0, 0], scaled(-1, free1));
      [a1, b1] = solve2(quartic, square, [-inside[0], -inside[1]]);
      middle1 = add(inside, scaled(a1, quartic), scaled(b1, square));
    }
    const [B1, l1] = system(w1, add(rest1, scaled(-1, middle1)));
    const d1 = add(rest1, real(B1, w1).slice(0, 5));

    const known2 = add(real(times(halfN, B1), w1), real(by(-n * n / 8, B0), w0), real(by(n * n / 2, B0), w1)).slice(0, 5);
    const moved = [
      0, l1 * d1[2] + l1 * l1 * jump / 2, l1 * (d1[3] - middle1[3]), l1 * (d1[4] - middle1[4]) + l1 * l1 * fifth / 2, 0,
    ];
    let middle2 = [0, 0, 0, 0, 0];
    if (detached) {
      const sextic = [x * x - x ** 6 / 180, 2 * x - x ** 5 / 30, 2 - x ** 4 / 6, -2 * x ** 3 / 3, 0];
      const quartic = [1 - x ** 4 / 4, -(x ** 3), -3 * x * x, -6 * x, 0];
      const inside = add([n * (b1 / 3 - a1 * x * x / 2), -n * a1 * x, -n * a1, 0, 0], scaled(-1, free2));
      const [a2, b2] = solve2(quartic, sextic, [-inside[0], -(inside[1] + l1 * middle1[2])]);
      middle2 = add(inside, scaled(a2, quartic), scaled(b2, sextic));
      middle2[0] = middle2[1] = 0;
    }
    const [, lambda2, r2] = system(w2, add(known2, scaled(-1, free2), moved, scaled(-1, middle2)));
    return { lambda2, r2, opening: d1[2] };
  }

  /** The knot before x and the share of the way to the next one; the outermost knots beyond. */
  function between(knots, x) {
    const at = Math.min(Math.max(x, knots[0]), knots[knots.length - 1]);
    let i = 0;
    while (i < knots.length - 2 && knots[i + 1] < at) i++;
    return [i, (at - knots[i]) / (knots[i + 1] - knots[i])];
  }
  /** The logarithms of a table's column, taken once: an answer looks there hundreds of times. */
  const columns = new WeakMap();
  function logsOf(list) {
    if (!columns.has(list)) columns.set(list, list.map(log));
    return columns.get(list);
  }
  const mixed = (list, [i, share]) => (1 - share) * list[i] + share * list[i + 1];

  /** erf, from its series of positive terms. */
  function erf(x) {
    if (x > 6) return 1;
    let term = 2 / sqrt(PI) * x * exp(-x * x), sum = 0;
    for (let n = 0; n < 200 && term > 1e-18 * sum; n++) {
      sum += term;
      term *= 2 * x * x / (2 * n + 3);
    }
    return sum;
  }

  /** erf⁻¹ on (0, 1), by Newton's method from below, where erf is concave. */
  function erfInverse(y) {
    let x = sqrt(PI) / 2 * y;
    for (let i = 0; i < 60; i++) {
      const step = (y - erf(x)) * sqrt(PI) / 2 * exp(x * x);
      x += step;
      if (abs(step) < 1e-15 * x) break;
    }
    return x;
  }

  /** A stopped point's reaction (c = ¼) or impulse (c = 5/4) over that without damping, t/η = age (theory/damped_point.py). */
  function pointRatio(age, c) {
    let sum = 0, term = 1;
    if (age > 40) {
      for (let n = 0; n < 25; n++) {
        sum += term;
        term *= (n - 0.25) * (n + 0.75 - c) / ((n + 1) * age);
      }
      return sum;
    }
    // Γ(c + ¼)/Γ(c) age^{−1/4} ₁F₁(−¼; c; −age), the latter by Kummer's transformation: positive terms
    for (let n = 0; n < 400; n++) {
      sum += term;
      term *= (c + 0.25 + n) / ((c + n) * (n + 1)) * age;
    }
    const front = c < 1 ? 0.4888705337234618 : 2 * 0.4888705337234618; // Γ(½)/Γ(¼), Γ(3/2)/Γ(5/4)
    return front * age ** -0.25 * exp(-age) * sum;
  }

  /** Half length, reaction, impulse and moment at the contact over those without damping at t/η = age (theory/damped_zone.py). */
  function damped(c, age, table) {
    if (!(age < 1e12)) return { length: 1, reaction: 1, impulse: 1, moment: 1 };
    if (c.regime === "discrete")
      return { length: 1, reaction: pointRatio(age, 0.25), impulse: pointRatio(age, 1.25), moment: exp(-age) / sqrt(PI * age) + erf(sqrt(age)) };
    const point = erfInverse(c.ratio) ** 2;
    if (age <= point) return { length: 0, reaction: pointRatio(age, 0.25) / c.r0, impulse: pointRatio(age, 1.25) / c.r0, moment: 1 };
    const last = table.age[table.age.length - 1], late = age > last ? sqrt(last / age) : 1;
    const [spread, reaction, impulse] = atAge(table, table.touch, c.ratio, age).map((ratio) => 1 + (ratio - 1) * late);
    return { length: spread * (1 - point / age), reaction, impulse, moment: 1 };
  }
  const NAMES = ["half_length", "reaction", "impulse"];
  /** The three of a table over κ/ν and age, bilinear in the logarithms. */
  function atAge(table, touch, ratio, age, rows = table) {
    const [i, share] = between(logsOf(table.kappa_over_nu), log(ratio)), ages = logsOf(table.age);
    // rows move with the age at which the lifted middle comes back to the wall
    const comes = (kappa) => mixed(logsOf(touch.age), between(touch.kappa_over_nu, kappa)), here = comes(ratio);
    const moved = Math.min(Math.max((log(age) - here + log(10)) / log(5), 0), 1);
    const [low, high] = [i, i + 1].map((k) => between(ages, log(age) + moved * (comes(table.kappa_over_nu[k]) - here)));
    return NAMES.map((name) => (1 - share) * mixed(rows[name][i], low) + share * mixed(rows[name][i + 1], high));
  }

  /** How far what damping changes of the answer to loads has ceased to count. */
  const quiet = (c, { quiet: [from, to] }) => Math.min(Math.max((c.ratio - from) / (to - from), 0), 1);
  /** Rates of a load in a damped zone at t/η = age (theory/damped_zone.py). */
  function loadRates(c, age, limits, load) {
    const { zone } = limits, ages = zone.loads.age, last = ages[ages.length - 1];
    const counts = 1 - quiet(c, limits);
    if (!(counts > 0) || age < limits.short * erfInverse(c.ratio) ** 2) return [0, 0, 0];
    const faded = counts * (age > last ? sqrt(last / age) : 1);
    return atAge(zone.loads, zone.touch, c.ratio, age, zone.loads[load]).map((rate) => rate * faded);
  }
  /** Share of a pressure's rate that is part of the prediction. */
  const knownPress = (c, { flat: [from, to] }) => Math.min(Math.max((to - c.ratio) / (to - from), 0), 1);
  /** Half length, reaction and impulse of a pressed zone over the product of the damped and the loaded law. */
  function pressFactors(c, age, press, limits) {
    if (c.regime !== "continuous" || !(age < 1e12) || !(knownPress(c, limits) > 0)) return [1, 1, 1];
    return loadRates(c, age, limits, "press").map((rate) => 1 + knownPress(c, limits) * rate * press);
  }

  /**
   * τ from and until which half length, force and impulse are within the tolerance, and what ends it (theory/validity.py).
   * slow: the time of the free vibration over that of the contact, 1/ε; damping: η over the time of the free vibration;
   * quartic: q₀ ℓ⁴/(V₀T*).
   */
  function validity(c, slow, limits, damping = 0, quartic = 0) {
    const { ends: table, zone, third, flattest, slope, share: part, point: slack, pulse } = limits, discrete = c.regime === "discrete";
    let begins = 0;
    if (damping > 0 && !discrete) {
      if (c.ratio < zone.kappa_over_nu[0]) return { begins: 0, until: 0, by: "damping" };
      begins = erfInverse(c.ratio) ** 2 >= zone.age[0] ? 0 : zone.age[0] * damping * slow;
    }
    const factor = exp(mixed(logsOf(table.factor), between(logsOf(table.damping), log(Math.max(damping, table.damping[0])))));
    const ratios = table.kappa_over_nu, flat = c.ratio < ratios[0] ? ratios[0] / c.ratio : 1;
    const stretch = factor * (flat > 1 ? (contact(ratios[0]).lambda0 / c.lambda0) ** 2 : 1);
    const end = table.last * stretch * slow, row = between(logsOf(ratios), log(c.ratio));
    const front = flat > 1 ? contact(ratios[0]).lambda0 : c.lambda0;
    const ofEnds = (tau) => {
      const root = 1 / sqrt(tau / (slow * stretch));
      const phases = [root * (root - front), 0.25 * Math.max(root - front, 0) ** 2];
      const [bare, fourth] = [table.ends, table.quartic].map((cause, k) => {
        if (phases[k] > cause.phase[cause.phase.length - 1]) return [0, 0, 0];
        const column = between(cause.phase, phases[k]);
        return NAMES.map((name) => (1 - row[1]) * mixed(cause[name][row[0]], column) + row[1] * mixed(cause[name][row[0] + 1], column));
      });
      return bare.map((value, i) => value + quartic * flat * fourth[i]);
    };

    const fromEnds = (tau) => [...ofEnds(tau), ...ofEnds(limits.earlier * tau)]; // as measured, and if they come earlier
    const size = Math.max(abs(c.alpha), abs(c.psi), abs(c.chi), abs(c.n));
    const exact = size === 0 || (discrete && c.n === 0), spreads = c.lambda0 > 0;
    let scale = 0, until = Infinity, secondOf = () => [0, 0, 0], thirdOf = () => 0;
    if (size > 0) {
      const p = contact(c.ratio, c.alpha / size, c.psi / size, c.chi / size, c.n / size);
      const change = Math.max(abs(p.r1) / p.r0, spreads ? abs(p.lambda1) / p.lambda0 : 0);
      const flatter = Math.min(1, c.ratio / flattest);
      const like = flatter < 1 ? contact(flattest, p.alpha, p.psi / flatter ** 2, p.chi / flatter, p.n * flatter) : p;
      const { lambda2: ofLength, r2: ofForce, opening } = secondOrder(like);
      const lambda2 = spreads ? ofLength / like.lambda0 * p.lambda0 : 0, r2 = ofForce / like.r0 * p.r0;
      if (!spreads && opening < 0) until = (p.ratio - 1 + slack) / (-opening * size);
      const fastest = Math.max(change, sqrt(Math.max(abs(r2) / p.r0, spreads ? abs(lambda2) / p.lambda0 : 0)));
      scale = fastest > 0 ? 1 / (fastest * size) : 0;
      if (!exact) {
        secondOf = (tau) => {
          const t = size * tau, push = p.r0 + p.r1 * t, spread = p.lambda0 + p.lambda1 * t, uniform = sqrt(PI / 2) * t * p.uniform;
          const force = push + uniform * spread, total = p.r0 + p.r1 * t / 3 + uniform * (p.lambda0 / 3 + p.lambda1 * t / 5);
          if (!(push > 0) || !(force > 0) || (spreads && !(spread > 0))) return [Infinity, Infinity, Infinity];
          return [spreads ? lambda2 * t * t / spread : 0, r2 * t * t / force, r2 * t * t / (5 * total)];
        };
        thirdOf = (tau) => third * (change * size * tau) ** 3;
      }
    }
    const pushed = c.raised + c.psi;
    const acting = { press: Math.max(pushed, 0), lift: Math.max(-pushed, 0), chi: c.chi, psi: c.psi, axial: c.n };
    const point = discrete ? 0 : erfInverse(c.ratio) ** 2, settled = limits.short * point;
    const waits = !discrete && damping > 0 && size > 0 ? quiet(c, limits) : 0;
    const loaded = !discrete && damping > 0 && quiet(c, limits) < 1 ? Object.keys(acting).filter((load) => acting[load]) : [];
    const unknown = { press: 1 - (1 - limits.unsure) * knownPress(c, limits), lift: 1, chi: 1, psi: 1, axial: 1 };
    const ofLoads = (tau) => {
      const found = secondOf(tau), age = tau / slow / damping;
      for (const load of loaded)
        loadRates(c, age, limits, load).forEach((rate, i) => {
          found[i] += acting[load] * unknown[load] * rate * tau;
        });
      if (waits > 0 && age > point) found[0] += waits * limits.waiting * point / (Math.max(age, settled) - point) * c.lambda1 / c.lambda0 * tau;
      return found;
    };
    const most = part * table.tolerance, largest = (list) => Math.max(...list.map(abs));
    const good = (tau) => {
      const loads = ofLoads(tau);
      return largest(fromEnds(tau).map((value, i) => value + loads[i % 3])) + thirdOf(tau) <= most;
    };
    const grid = [];
    for (let i = 0; i < 600; i++) grid.push(end * 10 ** (-4 + 4 * i / 599), scale * 10 ** (-6 + 6 * i / 599));
    const tau = grid.filter((value) => value > begins && value <= end).sort((a, b) => a - b);
    const beyond = tau.findIndex((value) => !good(value));
    let high = beyond < 0 ? end : tau[beyond], low = beyond < 1 ? begins : tau[beyond - 1];
    for (let i = 0; i < 60; i++) {
      const middle = (low + high) / 2;
      if (good(middle)) low = middle;
      else high = middle;
    }
    const ofLoad = tensionLeads(c) ? "tension" : "loads";
    let ending = "ends";
    if (until <= low || low === 0) ending = ofLoad;
    else if (largest(ofLoads(low)) + thirdOf(low) > largest(fromEnds(low))) ending = ofLoad;
    until = Math.min(low, until);
    const { kappa_over_nu: lifted, age: comes } = zone.touch;
    if (damping > 0 && c.ratio >= lifted[0] && c.ratio <= lifted[lifted.length - 1]) {
      const touch = exp(mixed(logsOf(comes), between(lifted, c.ratio))) * damping * slow;
      if (pulse[0] * touch < until && until < pulse[1] * touch) [until, ending] = [pulse[0] * touch, "touch"];
    }
    const shortest = zone.kappa_over_nu[zone.kappa_over_nu.length - 1];
    if (damping > 0 && !discrete && c.ratio > shortest && point * damping * slow < until * (1 + 1e-9))
      [until, ending] = [Math.min(point * damping * slow, until), "damping"];
    const steep = steepest(c);
    if (steep > 0 && (slope / steep) ** 2 < until) [until, ending] = [(slope / steep) ** 2, "slope"];
    return begins >= until ? { begins: 0, until: 0, by: begins > 0 ? "damping" : ending } : { begins, until, by: ending };
  }

  /** Whether the axial force changes λ and r more than the loads do. */
  function tensionLeads(c) {
    if (c.n === 0) return false;
    const alone = contact(c.ratio, c.alpha, c.psi, c.chi);
    const change = (l1, r1) => abs(r1) / c.r0 + (c.lambda0 > 0 ? abs(l1) / c.lambda0 : 0);
    return change(c.lambda1 - alone.lambda1, c.r1 - alone.r1) >= change(alone.lambda1, alone.r1);
  }

  /** Largest slope |E′| that the impact adds, between the front and the largest moment ahead of it. */
  function steepest(c) {
    const B = leadingAmplitude(c, iteratedErfc(c.lambda0)), stop = peakMoment(c).ahead;
    let most = 0;
    for (let i = 0; i <= 64; i++) {
      const x = c.lambda0 + (stop - c.lambda0) * i / 64, wave = times(B, turn((x * x - c.lambda0 ** 2) / 4));
      most = Math.max(most, abs(times(times(wave, T), iteratedErfc(x)[1])[0]));
    }
    return most;
  }

  return { phi, contact, shape, beamAt, peakMoment, secondOrder, damped, pressFactors, validity, s };
})();
if (typeof module !== "undefined") module.exports = Theory;
