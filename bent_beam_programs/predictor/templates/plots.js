"use strict";
// Pictures of a whole impact: stress over time, force over time and over place, impulse of the first instants.
const Plots = (() => {
  const { draw, axes, path } = Draw, { find, unit, quantity } = Form;
  const HEIGHT = 210, LEFT = 56, STRENGTH = 3, COLUMNS = 360, MEANS = 36; // px, px, decades of a colour

  /** Axes in the units that suit, then the curves: {points: [[s, SI]…], kind}. Returns the maps to the paper. */
  function chart(svg, { end, high, low = 0, name, label, curves }) {
    const [second, perSecond] = unit("time", end), [symbol, size] = unit(name, high), width = Math.max(260, svg.clientWidth || 320);
    const [X, Y] = axes(svg, { width, height: HEIGHT, left: LEFT, x: [0, end / perSecond], y: [low / size, 1.12 * high / size],
      xLabel: `time, ${second}`, yLabel: `${label}, ${symbol}`, zero: true });
    const x = (t) => X(t / perSecond), y = (value) => Y(value / size);
    for (const { points, kind } of curves)
      draw(svg, "path", { d: path(points.filter(([t]) => t <= end * 1.001).map(([t, value]) => [x(t), y(value)])), class: `curve ${kind}` });
    return { x, y, width };
  }
  const largest = (list) => list.reduce((one, other) => Math.max(one, other), 0);

  /** Largest stress anywhere in the beam over time, of each damping; the largest of all marked. */
  function stress(shown, b, scales) {
    const svg = find("#plot-stress"), of = (moment) => Beam.stress(b, moment * scales.moment);
    const curves = shown.map(({ run, kind }) => ({ kind, points: run.frames.map(({ t, worst }) => [t * scales.time, of(worst)]) }));
    const end = largest(shown.map(({ run }) => run.until)) * scales.time, top = shown.reduce((a, c) => (c.run.moment > a.run.moment ? c : a)).run;
    const high = largest(curves.flatMap(({ points }) => points.map(([, value]) => value)));
    const { x, y, width } = chart(svg, { end, high, name: "stress", label: "Largest stress", curves });
    const at = [x(top.time * scales.time), y(of(top.moment))], right = at[0] < 0.6 * width;
    draw(svg, "circle", { cx: at[0], cy: at[1], r: 4.5, class: "mark" });
    draw(svg, "text", { x: at[0] + (right ? 8 : -8), y: at[1] - 5, "text-anchor": right ? "start" : "end", class: "name" },
      `${quantity("stress", of(top.moment))} at ${quantity("time", top.time * scales.time, 3)}`);
  }

  const contactEnd = ({ run }) => 1.04 * (run.lastContact ?? run.until);

  /** The impulse at the time t, T*. */
  function impulse({ frames }, t) {
    const i = frames.findIndex((one) => one.t >= t), b = frames[i], a = frames[i - 1];
    return i < 0 ? frames[frames.length - 1].impulse : i ? a.impulse + (b.impulse - a.impulse) * (t - a.t) / (b.t - a.t) : 0;
  }

  /** Force on the wall; of a rigid one its means over equal times: single pushes have no size. */
  function force(shown, scales) {
    const end = largest(shown.map(contactEnd)), wide = end / MEANS;
    const means = (run) => Array.from({ length: MEANS }, (_, i) => {
      const value = (impulse(run, (i + 1) * wide) - impulse(run, i * wide)) / wide;
      return [[i * wide, value], [(i + 1) * wide, value]];
    }).flat();
    const curves = shown.map(({ run, kind }) => ({ kind, points: (run.force ? run.frames.map(({ t, total }) => [t, total]) : means(run))
      .map(([t, value]) => [t * scales.time, value * scales.force]) }));
    const high = largest(curves.flatMap(({ points }) => points.map(([, value]) => value)));
    chart(find("#plot-force"), { end: end * scales.time, high, name: "force", label: "Force on the wall", curves });
    find("#force-mean").textContent = shown[0].run.force ? "" : `Means over ${quantity("time", wide * scales.time, 2)}.`;
  }

  /** Force per length over time and place: a picture of frames × nodes, mirrored; darker is a factor. */
  function places(one, scales) {
    const svg = find("#plot-places"), { frames } = one.run, end = contactEnd(one);
    const nodes = frames[0].u.length, canvas = document.createElement("canvas"), high = largest(frames.map(({ force: f }) => largest(f)));
    canvas.width = COLUMNS;
    canvas.height = 2 * nodes - 1;
    const paint = canvas.getContext("2d"), picture = paint.createImageData(canvas.width, canvas.height);
    for (let i = 0, k = 0; i < COLUMNS; i++) {
      while (k < frames.length - 1 && frames[k].t < (i + 0.5) / COLUMNS * end) k++;
      frames[k].force.forEach((value, j) => {
        if (!(value > 0)) return;
        const strong = Math.max(0, 1 + Math.log10(value / high) / STRENGTH);
        for (const row of [nodes - 1 - j, nodes - 1 + j])
          picture.data.set([205 - 60 * strong, 150 * (1 - strong), 120 * (1 - strong), 255], 4 * (row * COLUMNS + i));
      });
    }
    paint.putImageData(picture, 0, 0);
    const [second, perSecond] = unit("time", end * scales.time), [metre, size] = unit("place", scales.length), half = scales.length / size;
    const [X, Y] = axes(svg, { width: Math.max(260, svg.clientWidth || 320), height: HEIGHT, left: LEFT, x: [0, end * scales.time / perSecond],
      y: [-half, half], xLabel: `time, ${second}`, yLabel: `Where the wall pushes, ${metre} from the middle`, zero: true });
    draw(svg, "image", { x: X(0), y: Y(half), width: X(end * scales.time / perSecond) - X(0), height: Y(-half) - Y(half), preserveAspectRatio: "none",
      href: canvas.toDataURL(), style: "image-rendering: pixelated" });
    find("#darkest").textContent = quantity("push", high * scales.line, 2);
  }

  /** Impulse of the first instants beside the theory's, whose range is shaded. */
  function first(shown, theory, scales) {
    const { limits } = theory, { from, until } = limits, end = Math.min(Math.max(until ? 3 * until : 4 * theory.reflected, 0.002 * scales.time), 0.05 * scales.time), svg = find("#plot-first");
    const curves = shown.map(({ run, kind }) => ({ kind, points: run.early.map(([t, J]) => [t * scales.time, J * scales.impulse]) }));
    const instants = Array.from({ length: 60 }, (_, i) => end * ((i + 1) / 60) ** 2).map((t) => [t, Instants.at(theory, t)]);
    const exact = limits.by === "wall" && !until ? [] : [[0, 0], ...instants.filter(([, at]) => at.exists).map(([t, at]) => [t, at.impulse])];
    const high = largest([...curves, { points: exact }].flatMap(({ points }) => points.filter(([t]) => t <= end).map(([, J]) => J)));
    const { x, y } = chart(svg, { end, high, name: "impulse", label: "Impulse", curves: [...curves, { points: exact, kind: "theory" }] });
    if (until) {
      const [left, right] = [x(Math.min(from, end)), x(Math.min(until, end))];
      svg.prepend(draw(svg, "rect", { x: left, width: right - left, y: y(1.12 * high), height: y(0) - y(1.12 * high), class: "range" }));
    }
  }

  return { stress, force, places, first };
})();
