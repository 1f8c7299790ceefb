"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const config = { responsive: true, displaylogo: false, displayModeBar: false, scrollZoom: false };
  const $ = (id) => document.getElementById(id);
  const narrow = () => window.innerWidth < 760;

  // --- matching plots -----------------------------------------------------------------------------------------
  const { base } = data, drawn = [];
  if (narrow()) for (const { layout } of [{ layout: base }, ...Object.values(data.plots)]) {
    layout.margin.l = 48;
    layout.font.size = 11.5;
  }
  for (const place of document.querySelectorAll("[data-plot]")) {
    const plot = data.plots[place.dataset.plot];
    if (!plot) { place.remove(); continue; }
    drawn.push(place);
    Plotly.newPlot(place, plot.data, plot.layout, config);
  }
  for (const box of document.querySelectorAll("input[data-label]")) {
    box.addEventListener("change", () => {
      for (const place of drawn) {
        const chosen = place.data.flatMap((trace, i) => trace.meta.label === box.dataset.label ? [i] : []);
        if (chosen.length) Plotly.restyle(place, { visible: box.checked }, chosen);
      }
    });
  }

  // --- one impact through time, every method beside theory ---------------------------------------------------
  const impacts = data.impacts;
  if (!impacts.length) return;
  const black = "#000", red = "#D55E00", grey = "#52606d", floor = 1e-2;
  const slider = $("time"), instant = $("instant"), readout = $("readout"), play = $("play");
  let impact = impacts[0];

  const axis = (title, more) => ({ ...base.xaxis, title: { text: title }, ...more });
  const layout = (x, y, more) => ({ ...base, xaxis: x, yaxis: y, showlegend: false, uirevision: "keep", ...more });
  const legend = { showlegend: true };
  const curve = (x, y, name, line, more) => ({ x, y, name, line, mode: "lines", ...more });
  const vertical = (x) => ({
    type: "line", x0: x, x1: x, yref: "paper", y0: 0, y1: 1, line: { color: grey, width: 1.2 },
  });
  const along = (reach) => axis("x / l<sub>*</sub>", reach ? { range: [-reach, reach] } : {});
  const tau = () => axis("τ = t/t<sub>*</sub>");

  const mirror = (values, sign) => values.slice().reverse().map((v) => v === null ? null : sign * v).concat(values);
  const scaled = (values, factor) => values.map((v) => v === null ? null : v * factor);
  const nearest = (values, wanted) => values.reduce(
    (best, v, i) => Math.abs(v - wanted) < Math.abs(values[best] - wanted) ? i : best, 0);
  const raised = (digits) => [...digits].map((digit) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[digit]).join("");
  const text = (v) => v === null || v === undefined ? "–"
    : String(Number(v.toPrecision(4))).replace(/e-(\d+)/, (_, digits) => "·10⁻" + raised(digits));

  /** The beam on the wall: as it is, and its gap in parts per thousand of V₀t. */
  function drawBeam(k) {
    const { theory, methods } = impact, last = theory.time.length - 1, t = theory.time[k], front = theory.front[k];
    const width = theory.x[theory.x.length - 1], high = theory.gap[last][theory.x.length - 1] * theory.time[last];
    const x = mirror(theory.x, -1);
    const lifted = theory.pressure === 0 && methods.some((m) => m.lift[k] > 1e-3); // only the ends touch: a dotted line
    const mark = { color: red, width: lifted ? 1.5 : 5, dash: lifted ? "dot" : "solid" };
    const zone = curve([-front, front], [0, 0], "zone", mark, { showlegend: false, hoverinfo: "skip" });
    const ends = {
      x: [-front, front], y: [0, 0], mode: "markers", name: "ends of the contact", showlegend: false,
      marker: { color: red, size: 8 }, hovertemplate: "end of the contact, x = %{x:.4g}<extra></extra>",
    };
    const shapes = (factor) => [
      zone, ends, curve(x, mirror(scaled(theory.gap[k], factor), 1), "Theory", { color: black, width: 3 }),
      ...methods.map((m, i) => curve(x, mirror(scaled(m.gap[k], factor), 1), m.label,
        { color: m.colour, width: 1.8, dash: ["solid", "dash", "dot", "dashdot"][i % 4] })),
    ];
    const wall = (depth) => ({
      type: "rect", xref: "paper", x0: 0, x1: 1, y0: -depth, y1: 0, fillcolor: "#dfe4ea", line: { width: 0 },
      layer: "below",
    });
    const push = 14 + 16 * Math.min(theory.reaction[k] / theory.reaction[last], 3); // in proportion to the reaction
    const arrow = (place) => ({
      x: place, y: 0, ax: 0, ay: push, showarrow: true, arrowhead: 2, arrowwidth: 2.2, arrowcolor: red, text: "",
    });
    const whole = axis("gap / (V<sub>0</sub>t<sub>*</sub>)", { range: [-0.3 * high, 1.05 * high] });
    const arrows = { shapes: [wall(high)], annotations: [arrow(-front), arrow(front)], ...legend };
    Plotly.react("beam", shapes(t), layout(along(width), whole, arrows), config);
    const close = axis("gap (‰ of V<sub>0</sub>t)", { range: [-2, 9] });
    const zoomed = layout(along(1.35 * front), close, { shapes: [wall(9)], ...legend });
    Plotly.react("zoom", shapes(1000), zoomed, config);
  }

  /** Reaction per length at the instant, and front and reaction of all instants over theory's. */
  function drawForce(k) {
    const { theory, methods } = impact, t = theory.time[k], front = theory.front[k], pressure = theory.pressure;
    const dotted = { color: black, width: 2, dash: "dot" };
    const uniform = curve([-front, front], [pressure, pressure], "Theory, uniform", dotted);
    const forces = methods.map((m) => {
      const force = m.map.force[nearest(m.map.root_time, Math.sqrt(t))].map((v) => Math.max(v, floor));
      return curve(mirror(m.map.x, -1), mirror(force, 1), m.label, { color: m.colour, width: 1.5, shape: "hvh" });
    });
    const decades = { type: "log", range: [-2.1, 3.6], dtick: 1, exponentformat: "power" };
    const y = axis("reaction per length / (μV<sub>0</sub>/t<sub>*</sub>)", decades);
    const drawn = pressure > 0 ? [uniform, ...forces] : forces;
    Plotly.react("force", drawn, layout(along(1.35 * front), y, legend), config);

    const ratio = (m, what, symbol, dash) => curve(
      theory.time, m[what].map((v, i) => v / theory[what][i]), `${m.label}, ${symbol}`,
      { color: m.colour, width: 1.6, dash });
    const ratios = methods.flatMap(
      (m) => [ratio(m, "front", "λ<sub>c</sub>", "solid"), ratio(m, "reaction", "R/2", "dot")]);
    const now = { shapes: [vertical(t)], ...legend };
    Plotly.react("fronts-now", ratios, layout(tau(), axis("over theory", { range: [0.85, 1.15] }), now), config);
  }

  function show(k) {
    const { theory, methods } = impact, t = theory.time[k];
    drawBeam(k);
    drawForce(k);
    for (const place of document.querySelectorAll("[data-map], [data-energy]")) {
      const [name, value] = place.dataset.map ? ["y", Math.sqrt(t)] : ["x", t];
      if (place.data) Plotly.relayout(place, { [`shapes[0].${name}0`]: value, [`shapes[0].${name}1`]: value });
    }
    instant.textContent = "τ = " + t.toFixed(4);
    const names = ["half contact length / l*", "reaction of one end / (μV₀l*/t*)", "uniform reaction / (μV₀/t*)"];
    const rows = [
      ["", ...names, "gap inside, % of V₀t"],
      ["Theory", text(theory.front[k]), text(theory.reaction[k]), text(theory.pressure), ""],
      ...methods.map((m) => [m.label, ...[m.front[k], m.reaction[k], m.pressure[k], 100 * m.lift[k]].map(text)]),
    ];
    readout.replaceChildren(...rows.map((cells, i) => {
      const row = document.createElement("tr");
      row.append(...cells.map((cell, j) => {
        const box = document.createElement(i === 0 || j === 0 ? "th" : "td");
        box.textContent = cell;
        return box;
      }));
      return row;
    }));
  }

  function drawMap(place, m) {
    const real = m.map.force.map((row) => mirror(row, 1));
    const ticks = { tickvals: [-2, -1, 0, 1, 2, 3], ticktext: ["≤ .01", "0.1", "1", "10", "100", "1000"] };
    const white = { color: "#fff", width: 1.5 };
    const instantLine = { type: "line", xref: "paper", x0: 0, x1: 1, y0: 0, y1: 0, line: white };
    Plotly.react(place, [{
      x: mirror(m.map.x, -1), y: m.map.root_time, z: real.map((row) => row.map((v) => Math.log10(Math.max(v, floor)))),
      customdata: real, type: "heatmap", colorscale: "Viridis", zmin: -2, zmax: 3, zsmooth: false,
      colorbar: { ...ticks, thickness: 10, len: 1, outlinewidth: 0 },
      hovertemplate: "x = %{x:.3g}, √τ = %{y:.3g}<br>%{customdata:.4g} μV<sub>0</sub>/t<sub>*</sub><extra></extra>",
    }], layout(along(), axis("√τ"), { shapes: [instantLine] }), config);
  }

  /** One scale for the energies of all methods. */
  function energyRange() {
    const all = impact.methods.flatMap((m) => Object.values(m.energy).flat()).concat(0);
    const low = Math.min(...all), high = Math.max(...all), room = 0.05 * (high - low || 1);
    return [low - room, high + room];
  }

  function drawEnergy(place, m) {
    const { time } = impact.theory;
    const drawn = Object.entries(data.energies).filter(([name]) => (m.energy[name] || []).some((v) => v !== 0));
    const curves = drawn.map(([name, { title, colour, dash }]) => curve(
      time, m.energy[name], title, { color: colour, width: 1.8, dash: dash ? "dash" : "solid" },
      { hovertemplate: title + " %{y:.4g}<extra></extra>" }));
    const y = axis("energy / (μV<sub>0</sub>²l<sub>*</sub>)", { range: energyRange() });
    Plotly.react(place, curves, layout(tau(), y, { shapes: [vertical(0)] }), config);
  }

  /** Maps and energies: a column a method; a method without this impact has an empty one. */
  function drawColumns() {
    for (const place of document.querySelectorAll("[data-map], [data-energy]")) {
      const m = impact.methods.find(({ label }) => label === (place.dataset.map || place.dataset.energy));
      if (!m) {
        Plotly.purge(place);
        place.textContent = place.dataset.map ? "could not be computed: see below" : "";
        continue;
      }
      if (!place.data) place.textContent = "";
      (place.dataset.map ? drawMap : drawEnergy)(place, m);
    }
  }

  function choose(index) {
    impact = impacts[index];
    slider.max = impact.theory.time.length - 1;
    drawColumns();
    show(Math.min(Number(slider.value), impact.theory.time.length - 1));
  }

  for (const radio of document.querySelectorAll("input[name=impact]"))
    radio.addEventListener("change", () => choose(Number(radio.value)));
  slider.addEventListener("input", () => show(Number(slider.value)));
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
      show(Number(slider.value));
      if (Number(slider.value) >= Number(slider.max)) stop();
    }, 80);
  });
  slider.max = impact.theory.time.length - 1;
  slider.value = Math.round(0.7 * slider.max);
  choose(0);
})();
