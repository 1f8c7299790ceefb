"use strict";
// A whole impact of a bent beam, half of it by symmetry, with the θ-scheme of θ = ½. Units ℓ = L/2 = EI = μ = V₀ = 1,
// so T* = 1; u is the displacement from the bow, towards the wall; the gap is g = κx²/2 − u.
//
//   (M + ½hC + ¼h²K) Δv = h[F − K(q + ½hv) − Cv] + p,   q⁺ = q + h(v + ½Δv),   K = B + NG,   C = ηB
const Solver = (() => {
  const { abs, max, min, sqrt } = Math, { PAD, element, assembled, row } = Elements;
  const { separation: SEPARATION, unresolved: UNRESOLVED } = RUNS; // T*: the shortest that counts; the first touch bends the mesh till then
  const PERIOD = 2 * Math.PI / (RUNS.mode / 2) ** 2; // of the lowest mode
  const EARLY = 0.05; // T*: until when the impulse of each step is kept
  const spacing = (t) => max(1 / 2000, min(1 / 200, t / 60)); // of the frames, T*

  /** Matrices, loads and the state at the first touch. */
  function model(p, elements, h) {
    const n = elements + 1, l = 1 / elements, size = 2 * n + 2 * PAD, tables = element(l, p.shear, p.turning);
    const [M, B, G] = [tables.M, tables.K, tables.G].map((table) => assembled(n, table));
    const bent = 0.5 * h * p.eta + 0.25 * h * h, pulled = 0.25 * h * h * p.tension;
    const S = M.map((band, m) => band.map((value, i) => value + bent * B[m][i] + pulled * G[m][i]));
    const [q, v, b, x, load] = Array.from({ length: 5 }, () => new Float64Array(size)), fixed = new Uint8Array(size);
    for (let i = 0; i < PAD; i++) fixed[i] = fixed[size - 1 - i] = 1;
    fixed[PAD + 1] = 1; // the angle in the middle
    const gap = Float64Array.from({ length: n }, (_, j) => p.kappa * (j * l) ** 2 / 2);
    const share = new Float64Array(n).fill(l), impulse = new Float64Array(n); // of a node: length, and of a step
    share[0] = share[n - 1] = l / 2;
    for (let j = 0; j < n; j++) v[PAD + 2 * j] = 1;
    for (let i = PAD; i < size - PAD; i++) load[i] = p.load * row(M, v, i); // M·1
    load[PAD + 2 * n - 2] += p.pull;
    return { n, l, h, size, M, B, G, S, q, v, b, x, load, fixed, gap, share, impulse };
  }

  /** b = h[F − K(q + ½hv) − Cv]. */
  function rightHandSide({ h, size, B, G, q, v, b, load, fixed }, { eta, tension }, scratch) {
    for (let i = PAD; i < size - PAD; i++) scratch[i] = q[i] + (0.5 * h + eta) * v[i];
    for (let i = PAD; i < size - PAD; i++) b[i] = h * (load[i] - row(B, scratch, i));
    if (tension) {
      for (let i = PAD; i < size - PAD; i++) scratch[i] = q[i] + 0.5 * h * v[i];
      for (let i = PAD; i < size - PAD; i++) b[i] -= h * tension * row(G, scratch, i);
    }
    b[PAD + 1] = 0; // fixed
  }

  /** Bending moments at the nodes, the mean of both elements there; returns the node of the largest. */
  function bend({ n, l, q }, { shear, before }, moment) {
    const phi = shear ? 12 / (shear * l * l) : 0, stiff = 1 / (l * (1 + phi));
    let worst = 0, left = 0;
    for (let j = 0; j < n; j++) {
      const i = PAD + 2 * j;
      let there = left;
      if (j < n - 1) {
        const rise = (q[i + 2] - q[i]) / l, first = q[i + 1] - rise, second = q[i + 3] - rise;
        const right = -stiff * ((4 + phi) * first + (2 - phi) * second);
        left = stiff * ((2 - phi) * first + (4 + phi) * second);
        there = j ? 0.5 * (there + right) : right;
      }
      moment[j] = before + there;
      if (abs(moment[j]) > abs(moment[worst])) worst = j;
    }
    return worst;
  }

  /** Whether elastic energy can never bring a beam back that flies freely (bent_beam/free_flight.py). */
  function gone({ n, size, M, B, q, v, gap, share }, { shear }) {
    let energy = 0, away = 0, speed = 0;
    for (let i = PAD; i < size - PAD; i++) energy += v[i] * row(M, v, i) + q[i] * row(B, q, i);
    for (let j = 0; j < n; j++) { away -= share[j] * q[PAD + 2 * j]; speed -= share[j] * v[PAD + 2 * j]; }
    const elastic = max(energy - speed * speed, 0), compliance = 8 / 105 + (shear ? 4 / (15 * shear) : 0);
    return speed >= 0 && away >= sqrt(2 * elastic * compliance) && gap.every((g, j) => g > q[PAD + 2 * j]);
  }

  /** When the beam is nearest to the wall again after its last contact, and the mean velocity by which it misses it. */
  function nearest(frames, gap, last) {
    const after = frames.filter(({ t }) => t > last && t < last + PERIOD)
      .map(({ t, u }) => [t, u.reduce((least, value, j) => min(least, gap[j] - value), Infinity)]);
    return after.filter(([, g], i) => i && i < after.length - 1 && g < after[i - 1][1] && g <= after[i + 1][1])
      .map(([t, g]) => [t, g / (t - last)]);
  }

  /** T* after which a beam that still touches is given up: a soft wall needs time to throw it off (bent_beam/method.py). */
  function given({ wall, kappa }) {
    if (!wall) return RUNS.longest;
    const straight = Math.PI / sqrt(wall.k), bowed = 2.94 * (15 / 8 * sqrt(kappa / 2) / wall.k) ** 0.4;
    return max(RUNS.longest, min(RUNS.onWall * max(straight, bowed), RUNS.longestOfWall));
  }

  /** The impact of p = {kappa, eta, shear, turning, load, tension, pull, before, wall} until the beam has left, with
      `elements` a half beam and `steps` a T*. load: μa₀; tension: N; pull: what it makes of the bow at the ends;
      before: moment of the bow; wall: {k, c} or null. Numbers are those of the first hit; moment and force the largest
      of the whole motion; late: whether they may still grow at its end. Throws Error where contact does not settle. */
  function simulate(p, { elements, steps, atPosition = false, rebound = 0, longest = given(p) }) {
    const m = model(p, elements, 1 / steps), { n, l, h, size, q, v, x, share, impulse } = m;
    const step = p.wall ? Contact.elastic({ ...m, wall: p.wall }) : Contact.rigid({ ...m, atPosition, rebound });
    const moment = new Float64Array(n), since = new Float64Array(n), scratch = new Float64Array(size);
    const found = { impulse: 0, lastContact: 0, begin: 0, apart: Infinity, earlier: 0, moment: 0, place: 0, time: 0,
      force: 0, pressed: 0, left: false };
    const early = [[0, 0]], frames = [], course = [abs(p.before)]; // course: largest moment at each step
    let first = null, worst = abs(p.before);
    const keep = (t, span) => {
      const force = Float32Array.from(since, (value, j) => value / (span * share[j])); // mean since the last frame
      const u = Float32Array.from({ length: n }, (_, j) => q[PAD + 2 * j]);
      const total = 2 * since.reduce((a, c) => a + c) / span;
      frames.push({ t, u, moment: Float32Array.from(moment), force, total, worst, impulse: found.impulse });
      since.fill(0);
      worst = 0;
    };
    bend(m, p, moment);
    keep(0, h);
    for (let k = 1; k <= longest * steps; k++) {
      const t = k * h;
      rightHandSide(m, p, scratch);
      if (!step()) throw new Error(`contact does not settle at ${t.toPrecision(3)} T*`);
      let pushed = 0;
      for (let j = 0; j < n; j++) { pushed += 2 * impulse[j]; since[j] += impulse[j]; }
      for (let i = PAD; i < size - PAD; i++) { q[i] += h * (v[i] + 0.5 * x[i]); v[i] += x[i]; }
      if (pushed > 1e-9 * found.impulse) {
        const apart = t - found.lastContact;
        if (apart > PERIOD && found.impulse) first ??= { ...found };
        if (apart > SEPARATION) Object.assign(found, { begin: t, apart, earlier: found.impulse });
        found.lastContact = t;
      }
      found.impulse += pushed;
      if (t <= EARLY) early.push([t, found.impulse]);
      if (p.wall && pushed / h > found.force) Object.assign(found, { force: pushed / h, pressed: t });
      const j = bend(m, p, moment), bent = abs(moment[j]), span = t - frames[frames.length - 1].t;
      worst = max(worst, bent);
      course.push(bent);
      if (bent > found.moment && t > UNRESOLVED) Object.assign(found, { moment: bent, place: j * l, time: t });
      if (span < spacing(t) - h / 2) continue;
      keep(t, span);
      if (t - found.lastContact < PERIOD) continue;
      found.left = p.load || p.tension ? true : gone(m, p);
      if (found.left) break;
    }
    const end = frames[frames.length - 1].t, quiet = found.impulse > 0 && end - found.lastContact >= PERIOD;
    const hit = first || found, over = found.left || first !== null || quiet;
    const restitution = over ? hit.impulse / 2 - (p.load + p.pull) * hit.lastContact - 1 : null;
    const until = min(found.lastContact + PERIOD, end);
    const late = { moment: found.time > end - PERIOD, force: found.pressed > end - PERIOD };
    const lastContact = over ? hit.lastContact : null;
    const { begin, apart, earlier } = hit; // of the last contact, and the impulse before it
    const ends = { begin, apart, earlier, lastContact, returns: nearest(frames, m.gap, hit.lastContact) };
    return { ...found, ...ends, impulse: over ? hit.impulse : null, restitution, late, until, frames, early, course, steps };
  }

  return { simulate };
})();
