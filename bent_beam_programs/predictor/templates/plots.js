"use strict";
// Pictures of a whole impact: stress over time, force over time and over place, impulse of the first instants.
// `shown`: [{run, kind, bar}], a run of solver.js in its own units, the colour of its damping, the bar of its moment.
const Plots = (() => {
  const { draw, axes, path, within } = Draw, { find, unit, quantity } = Form;
  const HEIGHT = 210, LEFT = 56; // px
  const DECADES = 3, COLUMNS = 360; // of the colours of the force over place; of its picture
  const MEANS = 36; // of the force on a rigid wall
  const RESOLVED = 10;
  const EARLY = [0.002, 0.05]; // T*: least and most of the first instants that are drawn
  const largest = (list) => list.reduce((one, other) => Math.max(one, other), 0);
  const highest = (curves) => largest(curves.flatMap(({ points }) => points.map(([, value]) => value)));

  /** Axes from 0 in the units that suit; returns the maps of s and SI to the paper, and its width. */
  function frame(svg, { end, low = 0, high, name, label }) {
    const [second, perSecond] = unit("time", end), [symbol, size] = unit(name, high);
    const width = Math.max(260, svg.clientWidth || 320);
    const [X, Y] = axes(svg, {
      width, height: HEIGHT, left: LEFT, x: [0, end / perSecond], y: [low / size, high / size],
      xLabel: `time, ${second}`, yLabel: `${label}, ${symbol}`,
    });
    return { x: (t) => X(t / perSecond), y: (value) => Y(value / size), width };
  }

  /** A frame with curves, {points: [[s, SI]…], kind}. */
  function chart(svg, how, curves) {
    const made = frame(svg, { ...how, high: 1.12 * how.high });
    for (const { points, kind } of curves) {
      const inside = points.filter(([t]) => t <= how.end * 1.001).map(([t, value]) => [made.x(t), made.y(value)]);
      draw(svg, "path", { d: path(inside), class: `curve ${kind}` });
    }
    return made;
  }

  /** Largest stress anywhere in the beam over time, of each damping; the largest of all marked, to the digits of its
      bar, as far as it is there. */
  function stress(shown, b, scales) {
    const svg = find("#plot-stress"), of = (moment) => Beam.stress(b, moment * scales.moment);
    const curves = shown.map(({ run, kind }) => (
      { kind, points: run.frames.map(({ t, worst }) => [t * scales.time, of(worst)]) }));
    const { run: top, bar } = shown.reduce((a, c) => (c.run.moment > a.run.moment ? c : a));
    const time = top.time * scales.time;
    const end = largest(shown.map(({ run }) => run.until)) * scales.time;
    const high = Math.max(highest(curves), of(top.moment));
    const { x, y, width } = chart(svg, { end, high, name: "stress", label: "Largest stress" }, curves);
    if (top.restitution === null && top.late.moment) return; // it still grows
    const [cx, cy] = [x(time), y(of(top.moment))], right = cx < 0.6 * width;
    const [symbol, size] = unit("stress"), error = bar === null ? null : bar * scales.moment / b.modulus / size;
    draw(svg, "circle", { cx, cy, r: 4.5, class: "mark" });
    draw(svg, "text", { x: cx + (right ? 8 : -8), y: cy - 5, "text-anchor": right ? "start" : "end", class: "name" },
      `${within(of(top.moment) / size, error)} ${symbol} at ${quantity("time", time, 3)}`);
  }

  const contactEnd = ({ run }) => (run.lastContact ? Math.min(1.04 * run.lastContact, run.until) : run.until);

  /** The impulse at the time t, T*. */
  function impulse({ frames }, t) {
    const i = frames.findIndex((one) => one.t >= t), b = frames[i], a = frames[i - 1];
    if (i <= 0) return i ? frames[frames.length - 1].impulse : 0;
    return a.impulse + (b.impulse - a.impulse) * (t - a.t) / (b.t - a.t);
  }

  /** Force on the wall; of a rigid one its means over equal times: single pushes have no size. */
  function force(shown, scales) {
    const end = largest(shown.map(contactEnd)), wide = end / MEANS, elastic = shown[0].run.force > 0;
    const means = (run) => Array.from({ length: MEANS }, (_, i) => {
      const value = (impulse(run, (i + 1) * wide) - impulse(run, i * wide)) / wide;
      return [[i * wide, value], [(i + 1) * wide, value]];
    }).flat();
    const points = (run) => (elastic ? run.frames.map(({ t, total }) => [t, total]) : means(run));
    const curves = shown.map(({ run, kind }) => (
      { kind, points: points(run).map(([t, value]) => [t * scales.time, value * scales.force]) }));
    const how = { end: end * scales.time, high: highest(curves), name: "force", label: "Force on the wall" };
    chart(find("#plot-force"), how, curves);
    find("#force-mean").textContent = elastic ? "" : `Means over ${quantity("time", wide * scales.time, 2)}.`;
  }

  /** Force per length over time and place, mirrored: the darker, the larger by a factor. */
  function places({ run }, scales) {
    const { frames } = run, end = contactEnd({ run }), nodes = frames[0].u.length, svg = find("#plot-places");
    const high = largest(frames.map((one) => largest(one.force))), canvas = document.createElement("canvas");
    canvas.width = COLUMNS;
    canvas.height = 2 * nodes - 1;
    const pen = canvas.getContext("2d"), picture = pen.createImageData(canvas.width, canvas.height);
    for (let i = 0, k = 0; i < COLUMNS; i++) {
      while (k < frames.length - 1 && frames[k].t < (i + 0.5) / COLUMNS * end) k++;
      frames[k].force.forEach((value, j) => {
        if (!(value > 0)) return;
        const pale = Math.min(1, -Math.log10(value / high) / DECADES);
        for (const row of [nodes - 1 - j, nodes - 1 + j])
          picture.data.set([145 + 60 * pale, 150 * pale, 120 * pale, 255], 4 * (row * COLUMNS + i));
      });
    }
    pen.putImageData(picture, 0, 0);
    const half = scales.length, label = "Where the wall pushes, from the middle";
    const { x, y } = frame(svg, { end: end * scales.time, low: -half, high: half, name: "place", label });
    draw(svg, "image", {
      x: x(0), y: y(half), width: x(end * scales.time) - x(0), height: y(-half) - y(half),
      preserveAspectRatio: "none", href: canvas.toDataURL(), style: "image-rendering: pixelated",
    });
    find("#darkest").textContent = quantity("push", high * scales.line, 2);
  }

  /** Impulse of the first instants beside the theory's, whose range is shaded. Pale: before a bending wave has passed
      RESOLVED elements, √(EI/μ)t = x², a number is one of the mesh (bent_beam/measure/reduction.py). */
  function first(shown, theory, scales) {
    const { from, until, by } = theory.limits, svg = find("#plot-first");
    const [least, most] = EARLY.map((t) => t * scales.time);
    const end = Math.min(Math.max(until ? 2 * until : 4 * theory.reflected, least), most);
    const curves = shown.flatMap(({ run, kind }) => {
      const resolved = (RESOLVED / (run.frames[0].u.length - 1)) ** 2;
      const inside = run.early.filter(([t]) => t * scales.time <= end);
      const points = (list) => list.map(([t, J]) => [t * scales.time, J * scales.impulse]);
      return [{ kind: `${kind} pale`, points: points(inside.filter(([t]) => t <= resolved)) },
        { kind, points: points(inside.filter(([t]) => t >= resolved)) }];
    });
    const exact = { kind: "theory", points: [[0, 0]] }, last = Math.min(until || end, end);
    for (let i = 1; i <= 60 && (until || by !== "wall"); i++) {
      const t = last * (i / 60) ** 2, at = Instants.at(theory, t);
      if (at.exists) exact.points.push([t, at.impulse]);
    }
    const all = [...curves, exact].filter(({ points }) => points.length > 1), high = highest(all);
    const { x, y } = chart(svg, { end, high, name: "impulse", label: "Impulse of the first instants" }, all);
    const never = by === "wall" ? "not drawn: the wall gives way" : "nowhere in its range";
    find("#range").textContent = until ? "where it holds, shaded" : never;
    if (!until) return;
    const left = x(Math.min(from, end)), top = y(1.12 * high);
    const range = { x: left, y: top, width: x(last) - left, height: y(0) - top, class: "range" };
    svg.prepend(draw(svg, "rect", range));
  }

  return { stress, force, places, first };
})();
