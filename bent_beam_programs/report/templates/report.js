"use strict";
(() => {
  const $ = (id) => document.getElementById(id);

  // --- on a phone every row of a table becomes a card: each cell is told its column's heading -----------------
  for (const table of document.querySelectorAll("main table")) {
    const heads = [...(table.tHead?.rows[0]?.cells ?? [])].map((cell) => cell.textContent.trim());
    if (!heads.length) continue;
    table.classList.add("cards");
    for (const row of [...table.tBodies].flatMap((body) => [...body.rows]))
      if (row.cells.length === heads.length) [...row.cells].forEach((cell, i) => { cell.dataset.head = heads[i]; });
  }

  // --- curves as SVG ------------------------------------------------------------------------------------------
  const data = JSON.parse($("data").textContent), SVG = "http://www.w3.org/2000/svg";
  const add = (parent, name, attributes, text) => {
    const made = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    if (text !== undefined) made.textContent = text;
    parent.append(made);
    return made;
  };

  const text = (v, digits = 4) => {
    if (v === null || v === undefined) return "–";
    const [mantissa, power] = v.toExponential(digits - 1).split("e");
    if (v === 0 || (Math.abs(power) < 4)) return String(Number(v.toPrecision(digits))).replace("-", "−");
    const raised = [...String(Number(power))].map((d) => (d === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[d])).join("");
    return `${Number(mantissa)}·10${raised}`.replace("-", "−");
  };

  function ticks([low, high], count) {
    const raw = (high - low) / count, power = 10 ** Math.floor(Math.log10(raw));
    const step = power * [1, 2, 5, 10].find((m) => m * power >= raw * 0.7), list = [];
    for (let v = Math.ceil(low / step - 1e-9) * step; v <= high + 1e-9 * step; v += step)
      list.push(Math.abs(v) < 1e-9 * step ? 0 : v);
    return list;
  }

  /** Axes, curves and a legend in `place`. curves : {x, y, name, colour, width, dash}; extra(inner, X, Y) draws more. */
  function chart(place, { x, y, xLabel, yLabel, curves, extra }) {
    const width = place.clientWidth, height = 280, left = 58, bottom = 40, top = 8, right = 8;
    const w = width - left - right, h = height - top - bottom;
    const X = (v) => (v - x[0]) / (x[1] - x[0]) * w, Y = (v) => (y[1] - v) / (y[1] - y[0]) * h;
    const svg = add(new DocumentFragment(), "svg", { viewBox: `0 0 ${width} ${height}`, width, height, role: "img",
      "aria-label": `${yLabel} over ${xLabel}` });
    for (const v of ticks(x, Math.max(2, Math.floor(w / 80)))) {
      add(svg, "line", { x1: left + X(v), x2: left + X(v), y1: top, y2: top + h, class: "grid" });
      add(svg, "text", { x: left + X(v), y: top + h + 16, "text-anchor": "middle" }, text(v));
    }
    for (const v of ticks(y, 5)) {
      add(svg, "line", { x1: left, x2: left + w, y1: top + Y(v), y2: top + Y(v), class: "grid" });
      add(svg, "text", { x: left - 6, y: top + Y(v) + 4, "text-anchor": "end" }, text(v));
    }
    add(svg, "text", { x: left + w / 2, y: height - 5, "text-anchor": "middle" }, xLabel);
    add(svg, "text", { x: -top - h / 2, y: 12, "text-anchor": "middle", transform: "rotate(-90)" }, yLabel);
    const inner = add(svg, "svg", { x: left, y: top, width: w, height: h });
    if (extra) extra(inner, X, Y, w, h);
    for (const c of curves) {
      const points = c.x.map((v, i) => (c.y[i] === null ? null : `${X(v).toFixed(1)},${Y(c.y[i]).toFixed(1)}`));
      add(inner, "polyline", { points: points.filter(Boolean).join(" "), fill: "none", stroke: c.colour,
        "stroke-width": c.width, "stroke-dasharray": c.dash ?? "" });
    }
    const key = document.createElement("p");
    key.className = "key lines";
    for (const c of curves.filter((curve) => curve.name)) {
      const entry = document.createElement("span"), sample = add(entry, "svg", { viewBox: "0 0 24 8" });
      add(sample, "line", { x1: 0, x2: 24, y1: 4, y2: 4, stroke: c.colour, "stroke-width": c.width,
        "stroke-dasharray": c.dash ?? "" });
      entry.append(c.name);
      key.append(entry);
    }
    place.replaceChildren(svg, key);
  }

  // --- one impact through time, every method beside theory ----------------------------------------------------
  const { impacts, energies } = data;
  if (!impacts.length) return;
  const black = "#000", red = "#D55E00", dashes = ["", "7 3", "2 3", "7 3 2 3"];
  const slider = $("time"), play = $("play");
  let impact = impacts[0];
  const mirror = (values, sign, factor = 1) =>
    [...values.slice().reverse().map((v) => (v === null ? null : sign * v)), ...values]
      .map((v) => (v === null ? null : v * factor));

  /** The beam on the wall (factor τ), and the same gap in parts per thousand of V₀t (factor 1000). */
  function drawBeam(place, k, factor, reach, range, yLabel) {
    const { theory, methods } = impact, front = theory.front[k], x = mirror(theory.x, -1);
    const lifted = theory.pressure === 0 && methods.some((m) => m.lift[k] > 1e-3); // only the ends touch
    chart(place, {
      x: [-reach, reach], y: range, xLabel: "x / l*", yLabel,
      curves: [
        { x, y: mirror(theory.gap[k], 1, factor), name: "theory", colour: black, width: 2.6 },
        ...methods.map((m, i) => ({ x, y: mirror(m.gap[k], 1, factor), name: m.label, colour: m.colour, width: 1.8,
          dash: dashes[i % 4] })),
        { x: [-front, front], y: [0, 0], name: lifted ? "ends of the contact, theory" : "contact zone, theory",
          colour: red, width: lifted ? 1.5 : 5, dash: lifted ? "2 4" : "" },
      ],
      extra: (inner, X, Y, w) => {
        add(inner, "rect", { x: 0, width: w, y: Y(0), height: Math.max(0, Y(range[0]) - Y(0)), class: "wall" });
        for (const end of [-front, front]) {
          const [at, tip] = [X(end), Y(0)], push = 12 + 10 * Math.min(theory.reaction[k] / theory.reaction.at(-1), 3);
          add(inner, "line", { x1: at, x2: at, y1: tip + push, y2: tip + 3, stroke: red, "stroke-width": 2 });
          add(inner, "path", { d: `M${at - 4},${tip + 9}L${at},${tip + 1}L${at + 4},${tip + 9}Z`, fill: red });
        }
      },
    });
  }

  const now = (t) => (inner, X, Y, w, h) =>
    add(inner, "line", { x1: X(t), x2: X(t), y1: 0, y2: h, stroke: "#52606d", "stroke-width": 1.2 });

  function drawEnergies(t) {
    const all = impact.methods.flatMap((m) => Object.values(m.energy).flat()).concat(0);
    const low = Math.min(...all), high = Math.max(...all), room = 0.05 * (high - low || 1);
    for (const place of document.querySelectorAll("[data-energy]")) {
      const m = impact.methods.find(({ label }) => label === place.dataset.energy);
      if (!m) { place.textContent = "could not be computed: see below"; continue; }
      const drawn = Object.entries(energies).filter(([name]) => (m.energy[name] || []).some((v) => v !== 0));
      chart(place, {
        x: [0, impact.theory.time.at(-1)], y: [low - room, high + room], xLabel: "τ = t/t*",
        yLabel: "energy / (μV₀²l*)", extra: now(t),
        curves: drawn.map(([name, e]) => ({ x: impact.theory.time, y: m.energy[name], name: e.title,
          colour: e.colour, width: 1.8, dash: e.dash ? "7 3" : "" })),
      });
    }
  }

  function show(k) {
    const { theory, methods } = impact, t = theory.time[k], end = theory.time.at(-1);
    const high = theory.gap.at(-1).at(-1) * end;
    drawBeam($("beam"), k, t, theory.x.at(-1), [-0.3 * high, 1.05 * high], "gap / (V₀t*)");
    drawBeam($("zoom"), k, 1000, 1.35 * theory.front[k], [-3, 9], "gap, ‰ of V₀t");
    const ratio = (m, what, name, dash) => ({ x: theory.time, y: m[what].map((v, i) => v / theory[what][i]),
      name: `${m.label}, ${name}`, colour: m.colour, width: 1.7, dash });
    chart($("fronts-now"), {
      x: [0, end], y: [0.85, 1.15], xLabel: "τ = t/t*", yLabel: "over theory", extra: now(t),
      curves: methods.flatMap((m) => [ratio(m, "front", "λ_c", ""), ratio(m, "reaction", "R/2", "2 3")]),
    });
    drawEnergies(t);
    $("instant").textContent = "τ = " + t.toFixed(4);
    const rows = [
      ["", "half contact length / l*", "reaction of one end / (μV₀l*/t*)", "uniform reaction / (μV₀/t*)",
        "gap inside, % of V₀t"],
      ["theory", text(theory.front[k]), text(theory.reaction[k]), text(theory.pressure), "0 or lifted"],
      ...methods.map((m) => [m.label, ...[m.front[k], m.reaction[k], m.pressure[k], 100 * m.lift[k]].map((v) => text(v))]),
    ];
    $("readout").replaceChildren(...rows.map((cells, i) => {
      const row = document.createElement("tr");
      row.append(...cells.map((cell, j) => {
        const box = document.createElement(i === 0 || j === 0 ? "th" : "td");
        box.textContent = cell;
        if (i) box.dataset.head = rows[0][j];
        return box;
      }));
      return row;
    }));
  }

  const redraw = () => show(Number(slider.value));
  for (const radio of document.querySelectorAll("input[name=impact]"))
    radio.addEventListener("change", () => { impact = impacts[Number(radio.value)]; redraw(); });
  slider.addEventListener("input", redraw);
  window.addEventListener("resize", redraw);
  let timer = null;
  const stop = () => {
    clearInterval(timer);
    timer = null;
    play.textContent = "▶";
    play.setAttribute("aria-label", "Play");
  };
  play.addEventListener("click", () => {
    if (timer) { stop(); return; }
    if (Number(slider.value) >= Number(slider.max)) slider.value = 0;
    play.textContent = "❚❚"; play.setAttribute("aria-label", "Pause");
    timer = setInterval(() => {
      slider.value = Number(slider.value) + 1;
      redraw();
      if (Number(slider.value) >= Number(slider.max)) stop();
    }, 80);
  });
  slider.max = impact.theory.time.length - 1;
  slider.value = Math.round(0.7 * slider.max);
  redraw();
})();
