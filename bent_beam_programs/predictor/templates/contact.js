"use strict";
// What a step does at the wall: Δv, and the nodes' impulses p, of  S Δv = b + p,  q⁺ = q + h(v + ½Δv).
const Contact = (() => {
  const { abs, max, min } = Math, { PAD, row, factors } = Elements;
  const ALL_AT_ONCE = 12; // rounds of the active set; then one node at a time (Murty 1974)
  const PATIENCE = 300, ROUNDS = 1500; // until signs are judged more leniently, and in all
  const NEWTON = 60, WHOLE = 20; // rounds, of them with whole steps
  const CONVERGED = 1e-9, REST = 1e-3; // change of Δv over the largest velocity; of V₀ = 1, less is rest

  /** A rigid wall: the closed nodes are guessed, and those of the wrong sign exchanged until none is.
      Moreau–Jean:  0 ≤ p ⊥ −(v⁺ + ev) ≥ 0 where g ≤ ½hv          position (Signorini):  0 ≤ p ⊥ g⁺ ≥ 0 */
  function rigid({ S, gap, fixed, q, v, b, x, impulse, h, atPosition, rebound }) {
    const n = gap.length, size = b.length, { from, solve } = factors(S, fixed), closed = new Uint8Array(n);
    const candidate = new Uint8Array(n).fill(1), target = new Float64Array(n);
    const exchange = (j) => { closed[j] ^= 1; fixed[PAD + 2 * j] = closed[j]; };
    let stale = size - PAD - 1;
    return () => {
      for (let j = 0; j < n; j++) {
        const i = PAD + 2 * j, open = gap[j] - q[i];
        target[j] = atPosition ? 2 * (open / h - v[i]) : -(1 + rebound) * v[i];
        candidate[j] = atPosition || open <= 0.5 * h * v[i] ? 1 : 0;
        if (closed[j] && !candidate[j]) { exchange(j); stale = max(stale, min(i + 3, size - PAD - 1)); }
      }
      for (let round = 0; round < ROUNDS; round++) {
        if (stale >= 0) from(stale);
        x.set(b);
        for (let j = 0; j < n; j++) if (closed[j]) for (let i = PAD + 2 * j, m = 1; m < 4; m++) {
          x[i + m] -= S[m][i] * target[j]; x[i - m] -= S[m][i - m] * target[j];
        }
        for (let i = 0; i < size; i++) if (fixed[i]) x[i] = 0;
        for (let j = 0; j < n; j++) if (closed[j]) x[PAD + 2 * j] = target[j];
        solve(x);
        let largest = 0, wrong = -1;
        const lenient = 10 ** Math.floor(round / PATIENCE); // of signs that round-off decides
        for (let i = PAD; i < size - PAD; i += 2) largest = max(largest, abs(x[i]));
        stale = -1;
        for (let j = 0; j < n; j++) {
          const i = PAD + 2 * j;
          impulse[j] = closed[j] ? b[i] - row(S, x, i) : 0;
          const pulls = closed[j] && impulse[j] < -1e-12 * lenient * (abs(S[0][i] * x[i]) + abs(b[i]));
          if (!pulls && (closed[j] || !candidate[j] || x[i] - target[j] <= 1e-13 * lenient * largest)) continue;
          wrong = j;
          if (round < ALL_AT_ONCE) { exchange(j); stale = i + 3; }
        }
        if (wrong < 0) return true;
        if (round >= ALL_AT_ONCE) { exchange(wrong); stale = PAD + 2 * wrong + 3; }
        stale = min(stale, size - PAD - 1);
      }
      return false;
    };
  }

  /** Springs k and dashpots c at the nodes, by Newton's method. The mean force over a step is that of
      Gonzalez's discrete gradient (1996, J. Nonlinear Sci. 6, 449): it keeps the springs' energy. It never pulls. */
  function elastic({ S, gap, fixed, q, v, b, x, impulse, h, wall, share }) {
    const n = gap.length, size = b.length, T = S.map((band) => band.slice()), { from, solve } = factors(T, fixed);
    const d = new Float64Array(size);
    let stale = size - PAD - 1;
    return () => { // d: Δv, at first that of the step before
      for (let round = 0; round < NEWTON; round++) {
        x.set(b);
        let speed = REST, change = 0;
        for (let j = 0; j < n; j++) {
          const i = PAD + 2 * j, deep = q[i] - gap[j], then = deep + h * (v[i] + 0.5 * d[i]);
          const before = max(deep, 0), after = max(then, 0), moved = then - deep;
          const mixed = (before > 0) !== (after > 0), mean = 0.5 * wall.k * (before + after);
          const spring = mixed ? mean * (after - before) / moved : mean;
          const force = spring + wall.c * (after - before) / h;
          let slope = mixed ? (wall.k * after - spring) / moved : after > 0 ? 0.5 * wall.k : 0;
          slope = force > 0 ? slope + (after > 0 ? wall.c / h : 0) : 0;
          impulse[j] = h * share[j] * max(force, 0);
          const tangent = 0.5 * h * h * share[j] * slope;
          if (T[0][i] !== S[0][i] + tangent) { T[0][i] = S[0][i] + tangent; stale = max(stale, i); }
          x[i] += tangent * d[i] - impulse[j];
        }
        for (let i = 0; i < size; i++) if (fixed[i]) x[i] = 0;
        if (stale >= 0) from(stale);
        stale = -1;
        solve(x);
        for (let i = PAD; i < size - PAD; i += 2) {
          speed = max(speed, abs(v[i]));
          change = max(change, abs(x[i] - d[i]));
        }
        const whole = round < WHOLE ? 1 : 0.5;
        for (let i = PAD; i < size - PAD; i++) d[i] += whole * (x[i] - d[i]);
        if (change < CONVERGED * speed) return true;
      }
      return false;
    };
  }

  return { rigid, elastic };
})();
