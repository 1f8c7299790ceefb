"use strict";
// A whole impact as numbers with bars: which runs, and what they say together (bent_beam/measure/numbers.py).
const Answer = (() => {
  const { abs, floor, max, min, round, sqrt } = Math;
  const { factor: FACTOR, ratios: RATIOS } = BARS; // of bentbeam bounce
  const DRAWN = [140, 92, 124, 80, 108, 132]; // elements of an ensemble; nodes rebound by 0, ½ and 1 of their velocity
  const NAMES = ["restitution", "impulse", "lastContact", "moment", "force"];
  const quick = ({ wall }) => ({ elements: 32, steps: wall ? 1000 : 1600, longest: 3 }); // for a first picture

  /** Whether finer elements come to numbers: of a damped beam, or on a soft wall (bent_beam/hysteresis.py). */
  const converges = ({ eta, wall }) => eta > 0 || (wall !== null && wall.k ** -0.25 >= BARS.soft);

  /** Sum of the loads, towards the wall: none where an axial force and what holds the bow against it cancel but for
      round-off (Scales.net_load). */
  const net = ({ load, pull }) => (abs(load + pull) > 1e-12 * abs(pull) ? load + pull : 0);

  /** Elements a half beam, steps a T*, law: finer where a front is thin or damping small (hermite_fe/whole_beam.py). */
  function resolution(p) {
    const { elements, step, hard, thick, damped, point, pressed, largest } = RUNS;
    const finer = p.kappa < thick || p.eta < damped ? hard : 1, atPosition = p.kappa >= point && net(p) <= pressed;
    if (!p.wall) return { elements: finer * elements, steps: round(finer * elements / step), atPosition };
    const length = p.wall.k ** -0.25;
    return { elements: round(min(max(elements, 1 / (largest * length)), 300)),
      steps: round(min(max(elements / step, 100 / length ** 2), 30000)) };
  }

  /** The runs behind the numbers of p, by name: `base` and its companions, or, where they do not converge, an ensemble. */
  function runs(p) {
    const base = resolution(p), part = (s) => ({ ...base, elements: round(s * base.elements), steps: s * base.steps });
    const half = part(0.5), between = part(0.7); // springs err by where the rim stands between nodes: half may agree by chance
    if (p.wall && converges(p)) return { base, half, between, ...(p.eta ? {} : { finer: part(2) }) };
    const other = (run) => ({ ...run, atPosition: !base.atPosition });
    if (p.eta) return { base, half, law: other(base), ...(p.kappa < RUNS.point ? { lawOfHalf: other(half) } : {}) };
    return Object.fromEntries(DRAWN.map((elements, i) => {
      const drawn = { elements, steps: round((0.5 + 0.2 * i) * elements ** 2), rebound: (i % 3) / 2 };
      return [i ? `drawn ${i}` : "base", drawn];
    }));
  }

  /** What another run changes of the moment about the time of the largest, root of the mean square, beyond what it
      changes of the largest (comparison/bouncing.py): maxima of curves that differ may agree by chance. */
  function aboutItsTime({ course, steps, time, moment }, other) {
    const changes = [], middle = round(time * steps), span = round(BARS.about * steps), its = other.course;
    const first = floor(RUNS.unresolved * steps) + 1, last = floor((its.length - 1) / other.steps * steps);
    for (let k = max(middle - span, first); k <= min(middle + span, last, course.length - 1); k++) {
      const t = k / steps, i = min(floor(t * other.steps), its.length - 2), between = t * other.steps - i;
      if (abs(t - other.time) > BARS.window) continue; // another moment is its largest
      changes.push((1 - between) * its[i] + between * its[i + 1] - course[k]);
    }
    const apart = changes.length ? Math.hypot(...changes) / sqrt(changes.length) : 0;
    return max(apart - abs(other.moment - moment), 0);
  }

  /** What a push that spreads over less than an element may take from the largest moment of a beam that shears
      (bent_beam/measure/reduction.py). */
  function spread({ shear, kappa, before, wall }, { frames, place, time, moment }) {
    if (!shear || wall) return 0;
    const { force } = frames.find(({ t }) => t >= time) ?? frames[frames.length - 1], elements = force.length - 1;
    const j = round(place * elements), push = force[j] * (j === elements ? 0.5 : 1) / elements; // both halves of the middle
    const left = 2 * shear * max(before + kappa - moment, 0), widest = 0.5 / elements;
    return push / 4 * (push < left * widest ? push / left : widest);
  }

  /** Numbers of finished runs: value and bar (null while companions are missing), or mean ± std of an ensemble. */
  function numbers(p, found) {
    const whole = Object.keys(runs(p)).every((name) => found[name]), { base, lawOfHalf, ...others } = found;
    const stays = whole && Object.values(found).some((run) => run.restitution === null); // what grows late is not the largest
    let slow = 0;
    return Object.fromEntries(NAMES.map((name) => {
      const values = [base, ...Object.values(others)].map((run) => run[name]);
      const there = Object.values(found).every((run) => run[name] !== null) && !(stays && base.late[name]);
      if (!there || !whole) return [name, { value: there ? base[name] : null, bar: null }];
      if (!converges(p)) {
        const mean = values.reduce((a, b) => a + b) / values.length;
        const std = sqrt(values.reduce((sum, value) => sum + (value - mean) ** 2, 0) / (values.length - 1));
        return [name, { value: mean, bar: std, runs: values.length }];
      }
      const bar = FACTOR * values.reduce((sum, value) => sum + abs(value - base[name]), 0);
      const { elements, steps } = resolution(p), landing = p.wall ? p.wall.c / elements : 0; // all dashpots of a node
      const shift = ({ begin, apart }) => min(abs(begin - base.begin), apart, base.apart); // they end it together by chance
      const shifts = FACTOR * Object.values(others).reduce((sum, run) => sum + shift(run), 0);
      const about = FACTOR * Object.values(others).reduce((sum, run) => sum + aboutItsTime(base, run), 0);
      const light = p.eta < BARS.light, chatter = light && p.kappa < 1 && !p.wall ? BARS.chatter * base.moment : 0;
      // A multiple of the bar of its velocity, which is found first, may bring the beam to the wall again.
      const again = base.returns.filter(([, speed]) => speed <= BARS.returns * slow).map(([t]) => t - base.lastContact);
      // The last part of the contact may be none, where the velocity that it gives is within as much.
      const graze = (base.impulse - base.earlier) / 2 <= BARS.returns * slow ? base.lastContact - base.begin + base.apart : 0;
      const known = { lastContact: 0.5 / steps + shifts + max(0, ...again) + graze, force: landing,
        moment: chatter + about + spread(p, base) };
      const sum = bar + (known[name] || 0), share = light ? BARS.leastLight : BARS.least;
      const flat = p.wall || !p.kappa ? 0 : BARS.least / min(max(p.kappa, BARS.flattest), 1) ** 2; // comparison/runs.py
      const least = { restitution: max(share, flat) * abs(1 + base[name]), impulse: max(share, flat) * base[name] }[name];
      // On half of the elements laws may differ more; of a rebound the larger change counts.
      const laws = least && lawOfHalf ? abs(lawOfHalf[name] - others.half[name]) - abs(others.law[name] - base[name]) : 0;
      const wider = sum + FACTOR * max(laws, 0);
      const number = { value: base[name], bar: wider && max(wider, least ?? share * abs(base[name])) };
      if (name === "restitution") slow = number.bar;
      return [name, number];
    }));
  }

  return { RATIOS, quick, runs, numbers, converges, net };
})();
