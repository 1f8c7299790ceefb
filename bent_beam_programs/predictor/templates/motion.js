"use strict";
// The motion: the beam before the wall, coloured by its bending moment, at the time of the slider or played.
const Motion = (() => {
  const { find, quantity } = Form;
  const SECONDS = 8, AFTER = 1.2; // a play; shown, over the time of the last contact
  let run = null, scales = null, stress = null, now = 0, playing = false, last = 0;

  /** The frame at the time t, T*, between two that are kept. */
  function frame(t) {
    const { frames } = run, i = Math.min(Math.max(frames.findIndex((one) => one.t > t), 1), frames.length - 1);
    const [a, b] = t >= frames[frames.length - 1].t ? [frames[frames.length - 1], frames[frames.length - 1]] : [frames[i - 1], frames[i]];
    const share = b.t > a.t ? (t - a.t) / (b.t - a.t) : 0, mix = (x, y) => x + share * (y - x);
    return { u: (j) => mix(a.u[j], b.u[j]), moment: (j) => mix(a.moment[j], b.moment[j]), force: b.force, total: b.total, worst: b.worst,
      impulse: mix(a.impulse, b.impulse) };
  }

  function paint() {
    const canvas = find("#motion"), width = canvas.clientWidth || 600, height = width < 480 ? 220 : 270, ratio = devicePixelRatio || 1;
    if (canvas.width !== Math.round(width * ratio)) { canvas.width = Math.round(width * ratio); canvas.height = Math.round(height * ratio); }
    canvas.style.height = `${height}px`;
    const pen = canvas.getContext("2d"), { u, moment, force, total, worst, impulse } = frame(now), n = run.nodes;
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    const deep = (height - 62) / (run.highest + run.lowest), wall = height - 44 - deep * run.lowest, gap = (j) => run.kappa * (j / (n - 1)) ** 2 / 2 - u(j);
    const x = (j) => width / 2 + j / (n - 1) * (width / 2 - 14), y = (value) => wall - deep * value;
    pen.fillStyle = "#d5dae0";
    pen.fillRect(0, wall, width, height - wall);
    pen.lineWidth = 3;
    for (let j = 1 - n; j < n; j++) { // pushes
      const push = force[Math.abs(j)] / run.strongest;
      if (!(push > 0)) continue;
      pen.strokeStyle = "#c1121f";
      pen.beginPath();
      pen.moveTo(x(j), wall + 4);
      pen.lineTo(x(j), wall + 8 + 30 * Math.min(1, Math.sqrt(push)));
      pen.stroke();
    }
    pen.lineWidth = 4;
    pen.lineCap = "round";
    for (let j = 1 - n; j < n - 1; j++) {
      const strong = Math.min(1, Math.abs(moment(Math.abs(j))) / run.moment);
      pen.strokeStyle = `rgb(${Math.round(20 + 190 * strong)},${Math.round(100 * (1 - strong) + 15)},${Math.round(178 * (1 - strong) + 25)})`;
      pen.beginPath();
      pen.moveTo(x(j), y(gap(Math.abs(j))));
      pen.lineTo(x(j + 1), y(gap(Math.abs(j + 1))));
      pen.stroke();
    }
    find("#instant").textContent = quantity("time", now * scales.time, 3);
    find("#now").textContent = `force ${quantity("force", total * scales.force, 3)} · impulse so far ${quantity("impulse", impulse * scales.impulse, 3)}`
      + ` · largest stress ${quantity("stress", stress(worst), 3)}`;
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

  /** Show this run; the slider stays where it is. */
  function show(one, problem, units, stressOf) {
    const end = Math.min(one.until, AFTER * (one.lastContact ?? one.until)), seen = one.frames.filter(({ t }) => t <= end);
    const nodes = one.frames[0].u.length, gaps = seen.map(({ u }) => Math.max(problem.kappa / 2 - u[nodes - 1], -u[0]));
    const pushes = one.frames.map(({ force }) => Math.max(...force));
    const inside = seen.map(({ u }) => Math.max(...u.map((value, j) => value - problem.kappa * (j / (nodes - 1)) ** 2 / 2)));
    run = { ...one, end, lowest: Math.max(0, ...inside), kappa: problem.kappa, nodes, highest: Math.max(...gaps), strongest: Math.max(...pushes) };
    [scales, stress] = [units, stressOf];
    const half = (find("#motion").clientWidth || 600) / 2 - 14, factor = 208 / ((run.highest + run.lowest) * units.deflection) / (half / units.length);
    find("#heights").textContent = factor > 1.05 ? `Heights are drawn ${Draw.text(factor, 2)} times too large.` : "";
    now = Number(find("#time").value) / 1000 * run.end;
    paint();
  }

  function start() {
    find("#play").addEventListener("click", () => play());
    find("#time").addEventListener("input", () => { play(false); now = Number(find("#time").value) / 1000 * run.end; paint(); });
  }

  return { show, start, paint };
})();
