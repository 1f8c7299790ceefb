"use strict";
// The motion: the beam before the wall, coloured by its bending moment, at the time of the slider or played.
const Motion = (() => {
  const { find, quantity } = Form;
  const SECONDS = 8, AFTER = 1.2; // a play; how much is shown, over the time of the last contact
  const MARGIN = 14, TOP = 18, BELOW = 44, PUSH = 30; // px: beside the beam, above it, of the wall, the longest push
  let run = null, scales = null, stress = null, now = 0, playing = false, last = 0;

  /** The motion at the time t, T*, between two frames that are kept. */
  function frame(t) {
    const { frames } = run, next = frames.findIndex((one) => one.t > t), i = next < 1 ? frames.length - 1 : next;
    const a = frames[i - 1], b = frames[i], share = Math.min(1, (t - a.t) / (b.t - a.t));
    const between = (name) => (j) => a[name][j] + share * (b[name][j] - a[name][j]);
    const impulse = a.impulse + share * (b.impulse - a.impulse);
    return { ...(share > 0 ? b : a), u: between("u"), moment: between("moment"), impulse };
  }

  /** The canvas as large as the screen shows it: its pen, width and height. */
  function paper() {
    const canvas = find("#motion"), width = canvas.clientWidth || 600, height = width < 480 ? 220 : 270;
    const ratio = devicePixelRatio || 1, [wide, high] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (canvas.width !== wide) [canvas.width, canvas.height] = [wide, high];
    canvas.style.height = `${height}px`;
    const pen = canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    return { pen, width, height };
  }

  /** px for the whole range of gaps. */
  const room = (height) => height - TOP - BELOW;

  function paint() {
    const { pen, width, height } = paper(), { u, moment, force, total, worst, impulse } = frame(now), n = run.nodes;
    const deep = room(height) / (run.highest + run.lowest), wall = height - BELOW - deep * run.lowest;
    const x = (j) => width / 2 + j / (n - 1) * (width / 2 - MARGIN);
    const y = (j) => wall - deep * (run.kappa * (j / (n - 1)) ** 2 / 2 - u(Math.abs(j)));
    const line = (colour, ...points) => {
      pen.strokeStyle = colour;
      pen.beginPath();
      for (const point of points) pen.lineTo(...point);
      pen.stroke();
    };
    pen.fillStyle = "#d5dae0";
    pen.fillRect(0, wall, width, height - wall);
    pen.lineWidth = 3;
    for (let j = 1 - n; j < n; j++) {
      const push = force[Math.abs(j)] / run.strongest;
      if (push > 0) line("#c1121f", [x(j), wall + 4], [x(j), wall + 8 + PUSH * Math.sqrt(push)]);
    }
    pen.lineWidth = 4;
    pen.lineCap = "round";
    for (let j = 1 - n; j < n - 1; j++) {
      const red = Math.min(1, Math.abs(moment(Math.abs(j))) / run.moment), blue = 1 - red;
      line(`rgb(${20 + 190 * red},${15 + 100 * blue},${25 + 178 * blue})`, [x(j), y(j)], [x(j + 1), y(j + 1)]);
    }
    find("#instant").textContent = quantity("time", now * scales.time, 3);
    find("#now").textContent = [
      `force ${quantity("force", total * scales.force, 3)}`,
      `impulse so far ${quantity("impulse", impulse * scales.impulse, 3)}`,
      `largest stress ${quantity("stress", stress(worst), 3)}`,
    ].join(" · ");
  }

  function tick(time) {
    if (!playing) return;
    now += Math.min(time - last, 100) / 1000 / SECONDS * run.end;
    last = time;
    if (now >= run.end) { now = run.end; play(false); }
    find("#time").value = Math.round(1000 * now / run.end);
    paint();
    requestAnimationFrame(tick);
  }

  function play(on = !playing) {
    if (on && now >= run.end) now = 0;
    playing = on;
    find("#play").textContent = on ? "Pause" : "Play";
    if (on) { last = performance.now(); requestAnimationFrame(tick); }
  }

  const scrub = () => { now = Number(find("#time").value) / 1000 * run.end; paint(); };

  /** Show this run of a problem; the slider stays where it is. stressOf: of a moment in the units of the run. */
  function show(one, { kappa }, units, stressOf) {
    const end = Math.min(one.until, AFTER * (one.lastContact ?? one.until)), nodes = one.frames[0].u.length;
    const seen = one.frames.filter(({ t }) => t <= end), most = (of) => seen.reduce((a, c) => Math.max(a, of(c)), 0);
    run = {
      ...one, end, kappa, nodes,
      highest: most(({ u }) => Math.max(kappa / 2 - u[nodes - 1], -u[0])),
      lowest: most(({ u }) => u.reduce((a, value, j) => Math.max(a, value - kappa * (j / (nodes - 1)) ** 2 / 2), 0)),
      strongest: most(({ force }) => force.reduce((a, c) => Math.max(a, c), 0)),
    };
    [scales, stress] = [units, stressOf];
    const { width, height } = paper(), along = (width / 2 - MARGIN) / units.length;
    const factor = room(height) / ((run.highest + run.lowest) * units.deflection) / along;
    find("#heights").textContent = factor > 1.05 ? `Heights are drawn ${Draw.text(factor, 2)} times too large.` : "";
    scrub();
  }

  function start() {
    find("#play").addEventListener("click", () => play());
    find("#time").addEventListener("input", () => { play(false); scrub(); });
  }

  return { show, start };
})();
