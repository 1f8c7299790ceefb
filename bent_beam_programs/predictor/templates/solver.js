"use strict";
// A whole impact of a bent beam, half of it by symmetry: Hermite's element with shear (Friedman & Kosmatka 1993, Comput.
// Struct. 47, 473), θ = ½, strict contact at the nodes. Units ℓ = L/2 = EI = μ = V₀ = 1, so T* = 1; u is the
// displacement from the bow, towards the wall; the gap is κx²/2 − u. A node has the dofs 2j (u) and 2j + 1 (angle).
//
//   (M + ½hC + ¼h²K) Δv = h[F − K(q + ½hv) − Cv] + p,   q⁺ = q + h(v + ½Δv),   C = ηK
//   Moreau–Jean:  0 ≤ p ⊥ −(v⁺ + ev) ≥ 0 where g ≤ ½hv          position (Signorini):  0 ≤ p ⊥ g⁺ ≥ 0
const Solver = (() => {
  const { abs, max, min, sqrt } = Math;
  const PERIOD = 2 * Math.PI / (4.730040744862704 / 2) ** 2; // of the lowest mode
  const LONGEST = 8, EARLY = 0.05; // T*; until when the impulse of each step is kept, T*
  const spacing = (t) => max(1 / 2000, min(1 / 200, t / 60)); // of the frames, T*
  const UNRESOLVED = 0.002; // T*: until then the first touch bends the mesh, not the beam
  const ALL_AT_ONCE = 12, ROUNDS = 2000; // of the active set, then one node at a time (Murty 1974)
  const GAUSS = [[0.06943184420297371, 0.17392742256872692], [0.33000947820757187, 0.32607257743127305]]
    .flatMap(([x, weight]) => [[x, weight], [1 - x, weight]]);
  const PAD = 3; // idle dofs before and after: no loop asks where the band ends

  /** Stiffness, mass, and ∫w′w′dx of an element of length l; shear: κ_sGA (0: none), turning: ρI. */
  function element(l, shear, turning) {
    const phi = shear ? 12 / (shear * l * l) : 0, c = 1 / (1 + phi), table = () => [0, 1, 2, 3].map(() => [0, 0, 0, 0]);
    const [K, M, G] = [table(), table(), table()];
    for (const [x, weight] of GAUSS) {
      const w = [1 + phi - phi * x - 3 * x * x + 2 * x ** 3, l * x * (1 - x) * (1 - x + phi / 2),
        phi * x + 3 * x * x - 2 * x ** 3, -l * x * (1 - x) * (x + phi / 2)].map((f) => c * f);
      const slope = [-phi - 6 * x + 6 * x * x, l * (1 + phi / 2 - (4 + phi) * x + 3 * x * x),
        phi + 6 * x - 6 * x * x, l * (-phi / 2 - (2 - phi) * x + 3 * x * x)].map((f) => c * f / l);
      const angle = [6 * x * (x - 1) / l, (1 - x) * (1 - 3 * x + phi), 6 * x * (1 - x) / l, x * (3 * x - 2 + phi)].map((f) => c * f);
      const bent = [(12 * x - 6) / l, 6 * x - 4 - phi, (6 - 12 * x) / l, 6 * x - 2 + phi].map((f) => c * f / l);
      for (let i = 0; i < 4; i++) for (let j = 0; j < 4; j++) {
        K[i][j] += weight * l * (bent[i] * bent[j] + shear * (slope[i] - angle[i]) * (slope[j] - angle[j]));
        M[i][j] += weight * l * (w[i] * w[j] + turning * angle[i] * angle[j]);
        G[i][j] += weight * l * slope[i] * slope[j];
      }
    }
    return { K, M, G };
  }

  /** Equal elements in lower bands: A[m][i] couples the dofs i and i + m. */
  function assembled(nodes, table) {
    const A = [0, 1, 2, 3].map(() => new Float64Array(2 * nodes + 2 * PAD));
    for (let e = 0; e < nodes - 1; e++) for (let i = 0; i < 4; i++) for (let j = 0; j <= i; j++)
      A[i - j][PAD + 2 * e + j] += table[i][j];
    return A;
  }
  const row = (A, x, i) => A[0][i] * x[i] + A[1][i] * x[i + 1] + A[1][i - 1] * x[i - 1] + A[2][i] * x[i + 2]
    + A[2][i - 2] * x[i - 2] + A[3][i] * x[i + 3] + A[3][i - 3] * x[i - 3];

  /** S = UDUᵀ without the fixed dofs, from the tip on, so that an exchange in the middle is cheap; x solves S x = b. */
  function factors(S, fixed) {
    const size = S[0].length, [D, U1, U2, U3] = S.map((band) => new Float64Array(band.length)), [S0, S1, S2, S3] = S;
    D.fill(1);
    return {
      from(last) {
        for (let i = last; i >= PAD; i--) {
          if (fixed[i]) { D[i] = 1; U1[i] = U2[i] = U3[i] = 0; continue; }
          const c = fixed[i + 3] ? 0 : S3[i], b = (fixed[i + 2] ? 0 : S2[i]) - U1[i + 2] * c;
          const a = (fixed[i + 1] ? 0 : S1[i]) - U1[i + 1] * b - U2[i + 1] * c;
          U1[i] = a * D[i + 1]; U2[i] = b * D[i + 2]; U3[i] = c * D[i + 3];
          D[i] = 1 / (S0[i] - U1[i] * a - U2[i] * b - U3[i] * c);
        }
      },
      solve(x) {
        for (let i = size - PAD - 1; i >= PAD; i--) x[i] -= U1[i] * x[i + 1] + U2[i] * x[i + 2] + U3[i] * x[i + 3];
        for (let i = PAD; i < size - PAD; i++)
          x[i] = x[i] * D[i] - U1[i - 1] * x[i - 1] - U2[i - 2] * x[i - 2] - U3[i - 3] * x[i - 3];
      },
    };
  }

  /** One step before a rigid wall: Δv in x and the nodes' impulses. b: the right-hand side. */
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
        for (let i = PAD; i < size - PAD; i += 2) largest = max(largest, abs(x[i]));
        stale = -1;
        for (let j = 0; j < n; j++) {
          const i = PAD + 2 * j;
          impulse[j] = closed[j] ? b[i] - row(S, x, i) : 0;
          const pulls = closed[j] && impulse[j] < -1e-12 * (abs(S[0][i] * x[i]) + abs(b[i]));
          if (!pulls && (closed[j] || !candidate[j] || x[i] - target[j] <= 1e-13 * largest)) continue;
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

  /** One step before springs k and dashpots c at the nodes, by Newton's method. The mean force over a step is that of
      Gonzalez's discrete gradient (1996, J. Nonlinear Sci. 6, 449): it keeps the springs' energy. It never pulls. */
  function elastic({ S, gap, fixed, q, v, b, x, impulse, h, wall, share }) {
    const n = gap.length, size = b.length, T = S.map((band) => band.slice()), { from, solve } = factors(T, fixed);
    const d = new Float64Array(size);
    let stale = size - PAD - 1;
    return () => { // d: Δv, at first that of the step before
      for (let round = 0; round < 60; round++) {
        x.set(b);
        let speed = 1e-9, change = 0;
        for (let j = 0; j < n; j++) {
          const i = PAD + 2 * j, deep = q[i] - gap[j], then = deep + h * (v[i] + 0.5 * d[i]);
          const before = max(deep, 0), after = max(then, 0), moved = then - deep;
          const mixed = (before > 0) !== (after > 0);
          const spring = mixed ? 0.5 * wall.k * (after * after - before * before) / moved : 0.5 * wall.k * (before + after);
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
        for (let i = PAD; i < size - PAD; i += 2) { speed = max(speed, abs(v[i])); change = max(change, abs(x[i] - d[i])); }
        const whole = round < 20 ? 1 : 0.5;
        for (let i = PAD; i < size - PAD; i++) d[i] += whole * (x[i] - d[i]);
        if (change < 1e-9 * speed) return true;
      }
      return false;
    };
  }

  /** The impact of p = {kappa, eta, shear, turning, load, tension, pull, before, wall} until the beam has left, with
      `elements` a half beam and `steps` a T*. load: μa₀; tension: N; pull: what it makes of the bow at the ends;
      before: moment of the bow; wall: {k, c} or null. Raises Error where contact does not settle. */
  function simulate(p, { elements, steps, atPosition = false, rebound = 0, longest = LONGEST }) {
    const n = elements + 1, l = 1 / elements, h = 1 / steps, size = 2 * n + 2 * PAD, vector = () => new Float64Array(size);
    const tables = element(l, p.shear, p.turning), M = assembled(n, tables.M), B = assembled(n, tables.K);
    const G = assembled(n, tables.G), kept = 0.5 * h * p.eta + 0.25 * h * h;
    const S = M.map((band, m) => band.map((value, i) => value + kept * B[m][i] + 0.25 * h * h * p.tension * G[m][i]));
    const [q, v, b, x, mid, load, ones] = Array.from({ length: 7 }, vector), fixed = new Uint8Array(size);
    for (let i = 0; i < PAD; i++) fixed[i] = fixed[size - 1 - i] = 1;
    fixed[PAD + 1] = 1; // the angle in the middle
    const gap = new Float64Array(n), share = new Float64Array(n).fill(l), impulse = new Float64Array(n);
    share[0] = share[n - 1] = l / 2;
    for (let j = 0; j < n; j++) { gap[j] = p.kappa * (j * l) ** 2 / 2; v[PAD + 2 * j] = ones[PAD + 2 * j] = 1; }
    for (let i = PAD; i < size - PAD; i++) load[i] = p.load * row(M, ones, i);
    load[PAD + 2 * n - 2] += p.pull;
    const step = (p.wall ? elastic : rigid)({ S, gap, fixed, q, v, b, x, impulse, h, atPosition, rebound, wall: p.wall, share });

    const phi = p.shear ? 12 / (p.shear * l * l) : 0, stiff = 1 / (l * (1 + phi)), moment = new Float64Array(n);
    const bend = () => { // moments at the nodes: the mean of both elements there
      let worst = 0, left = 0;
      for (let j = 0; j < n; j++) {
        let right = 0;
        const i = PAD + 2 * j;
        let there = left;
        if (j < n - 1) {
          const rise = (q[i + 2] - q[i]) / l, first = q[i + 1] - rise, second = q[i + 3] - rise;
          right = -stiff * ((4 + phi) * first + (2 - phi) * second);
          left = stiff * ((2 - phi) * first + (4 + phi) * second);
          there = j ? 0.5 * (there + right) : right;
        }
        moment[j] = p.before + there;
        if (abs(moment[j]) > abs(moment[worst])) worst = j;
      }
      return worst;
    };

    /** Whether elastic energy can never bring a beam back that flies freely (bent_beam/free_flight.py). */
    const gone = () => {
      let kinetic = 0, elastic = 0, away = 0, speed = 0;
      for (let i = PAD; i < size - PAD; i++) { kinetic += v[i] * row(M, v, i); elastic += q[i] * row(B, q, i); }
      for (let j = 0; j < n; j++) { away -= share[j] * q[PAD + 2 * j]; speed -= share[j] * v[PAD + 2 * j]; }
      const energy = max(kinetic + elastic - speed * speed, 0);
      const reach = sqrt(2 * energy * (8 / 105 + (p.shear ? 4 / (15 * p.shear) : 0)));
      return speed >= 0 && away >= reach && gap.every((g, j) => g > q[PAD + 2 * j]);
    };

    const early = [[0, 0]], frames = [], since = new Float64Array(n), pull = p.load + p.pull;
    const found = { impulse: 0, lastContact: 0, moment: 0, place: 0, time: 0, force: 0, forceTime: 0, left: false };
    const keep = (t, span, worst) => frames.push({
      t, u: Float32Array.from({ length: n }, (_, j) => q[PAD + 2 * j]), moment: Float32Array.from(moment),
      force: Float32Array.from(since, (value, j) => value / (span * share[j])), worst,
      total: 2 * since.reduce((a, c) => a + c) / span, impulse: found.impulse, speed: -v[PAD] });
    let first = null, worst = 0;
    bend();
    keep(0, h, abs(p.before));
    for (let k = 1; k <= longest * steps; k++) {
      const t = k * h;
      for (let i = PAD; i < size - PAD; i++) mid[i] = q[i] + (0.5 * h + p.eta) * v[i];
      for (let i = PAD; i < size - PAD; i++) b[i] = h * (load[i] - row(B, mid, i));
      if (p.tension) {
        for (let i = PAD; i < size - PAD; i++) mid[i] = q[i] + 0.5 * h * v[i];
        for (let i = PAD; i < size - PAD; i++) b[i] -= h * p.tension * row(G, mid, i);
      }
      b[PAD + 1] = 0;
      if (!step()) throw new Error(`contact does not settle at ${t.toPrecision(3)} T*`);
      let pushed = 0;
      for (let j = 0; j < n; j++) { pushed += 2 * impulse[j]; since[j] += impulse[j]; }
      for (let i = PAD; i < size - PAD; i++) { q[i] += h * (v[i] + 0.5 * x[i]); v[i] += x[i]; }
      if (pushed > 1e-9 * found.impulse) {
        if (t - found.lastContact > PERIOD && found.impulse) first ??= { impulse: found.impulse, lastContact: found.lastContact };
        found.lastContact = t;
      }
      found.impulse += pushed;
      if (t <= EARLY) early.push([t, found.impulse]);
      if (p.wall && pushed / h > found.force) { found.force = pushed / h; found.forceTime = t - h / 2; }
      const j = bend(), bent = abs(moment[j]);
      worst = max(worst, bent);
      if (bent > found.moment && t > UNRESOLVED) Object.assign(found, { moment: bent, place: j * l, time: t });
      const span = t - frames[frames.length - 1].t;
      if (span < spacing(t) - h / 2) continue;
      keep(t, span, worst);
      since.fill(0);
      worst = 0;
      if (t - found.lastContact < PERIOD) continue;
      found.left = p.load || p.tension ? true : gone();
      if (found.left) break;
    }
    const hit = first || found, over = found.left || first !== null;
    return { ...found, impulse: hit.impulse, lastContact: over ? hit.lastContact : null,
      restitution: over ? hit.impulse / 2 - pull * hit.lastContact - 1 : null,
      until: frames[frames.length - 1].t, frames, early };
  }

  return { simulate, PERIOD };
})();
