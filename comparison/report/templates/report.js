"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const config = { responsive: true, displaylogo: false, displayModeBar: false, scrollZoom: false };
  const $ = (id) => document.getElementById(id);
  const narrow = () => window.innerWidth < 760;

  // --- matching plots -----------------------------------------------------------------------------------------
  const drawn = [];
  for (const place of document.querySelectorAll("[data-plot]")) {
    const plot = data.plots[place.dataset.plot];
    if (!plot) { place.remove(); continue; }
    if (narrow()) { plot.layout.margin.l = 48; plot.layout.font.size = 11.5; }
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
  const grid = "#e4e7eb", black = "#000", red = "#D55E00", grey = "#52606d", floor = 1e-2;
  const slider = $("time"), instant = $("instant"), readout = $("readout"), play = $("play");
  let impact = impacts[0];

  const axis = (title, more) => Object.assign({ title: { text: title }, gridcolor: grid, zerolinecolor: "#cbd2d9", automargin: true }, more);
  const layout = (x, y, more) => Object.assign({
    font: { family: "system-ui, sans-serif", size: narrow() ? 11.5 : 13, color: "#1f2933" },
    margin: { l: narrow() ? 48 : 60, r: 10, t: 8, b: 44 }, paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "#fff", xaxis: x, yaxis: y,
    showlegend: false, hovermode: "closest", uirevision: "keep",
  }, more);
  const legend = { showlegend: true, legend: { orientation: "h", y: 1.02, yanchor: "bottom", x: 0, font: { size: 11 } } };
  const mirror = (values, sign) => values.slice().reverse().map((v) => v === null ? null : sign * v).concat(values);
  const power = (v) => { const [digits, exponent] = v.toExponential(1).split("e"); return digits + "·10" + exponent.replace("+", "").replace(/[-0-9]/g, (c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]); };
  const text = (v) => v === null || v === undefined ? "–" : Math.abs(v) >= 1e-3 || v === 0 ? Number(v.toPrecision(4)).toString() : power(v);
  const curve = (xs, ys, colour, name, more) => Object.assign({ x: xs, y: ys, mode: "lines", name: name, line: { color: colour, width: 1.8 } }, more);
  const scaled = (values, factor) => values.map((v) => v === null ? null : v * factor);
  const nearest = (values, wanted) => values.reduce((best, v, i) => Math.abs(v - wanted) < Math.abs(values[best] - wanted) ? i : best, 0);

  function show(k) {
    const d = impact, theory = d.theory, last = theory.time.length - 1, t = theory.time[k], front = theory.front[k], width = theory.x[theory.x.length - 1];
    const x = mirror(theory.x, -1), high = theory.gap[last][theory.x.length - 1] * theory.time[last];
    const ends = { x: [-front, front], y: [0, 0], mode: "markers", name: "ends of the contact", showlegend: false, marker: { color: red, size: 8 }, hovertemplate: "end of the contact, x = %{x:.4g}<extra></extra>" };
    const lifted = theory.pressure === 0 && d.methods.some((m) => m.lift[k] > 1e-3);  // only the ends touch: a dotted line
    const zone = (wide) => ({ x: [-front, front], y: [0, 0], mode: "lines", showlegend: false, hoverinfo: "skip", line: { color: red, width: lifted ? 1.5 : wide, dash: lifted ? "dot" : "solid" } });
    const push = Math.min(theory.reaction[k] / theory.reaction[last], 3);  // arrows in proportion to the reaction
    const arrow = (place) => ({ x: place, y: 0, ax: 0, ay: 14 + 16 * push, showarrow: true, arrowhead: 2, arrowwidth: 2.2, arrowcolor: red, text: "" });
    const wall = (depth) => ({ type: "rect", xref: "paper", x0: 0, x1: 1, y0: -depth, y1: 0, fillcolor: "#dfe4ea", line: { width: 0 }, layer: "below" });
    const shapes = (factor) => [
      zone(5), ends, curve(x, mirror(scaled(theory.gap[k], factor), 1), black, "Theory", { line: { color: black, width: 3 } }),
      ...d.methods.map((m, i) => curve(x, mirror(scaled(m.gap[k], factor), 1), m.colour, m.label, { line: { color: m.colour, width: 1.8, dash: ["solid", "dash", "dot", "dashdot"][i % 4] } })),
    ];
    Plotly.react("beam", shapes(t), layout(axis("x / l<sub>*</sub>", { range: [-width, width] }), axis("gap / (V<sub>0</sub>t<sub>*</sub>)", { range: [-0.3 * high, 1.05 * high] }),
      Object.assign({ shapes: [wall(high)], annotations: [arrow(-front), arrow(front)] }, legend)), config);
    Plotly.react("zoom", shapes(1000), layout(axis("x / l<sub>*</sub>", { range: [-1.35 * front, 1.35 * front] }), axis("gap (‰ of V<sub>0</sub>t)", { range: [-2, 9] }),
      Object.assign({ shapes: [wall(9)] }, legend)), config);

    const uniform = theory.pressure > 0 ? [curve([-front, front], [theory.pressure, theory.pressure], black, "Theory, uniform", { line: { color: black, width: 2, dash: "dot" } })] : [];
    Plotly.react("force", [...uniform, ...d.methods.map((m) => {
      const force = m.map.force[nearest(m.map.root_time, Math.sqrt(t))];
      return curve(mirror(m.map.x, -1), mirror(force.map((v) => Math.max(v, floor)), 1), m.colour, m.label, { line: { color: m.colour, width: 1.5, shape: "hvh" } });
    })], layout(axis("x / l<sub>*</sub>", { range: [-1.35 * front, 1.35 * front] }), axis("reaction per length / (μV<sub>0</sub>/t<sub>*</sub>)", { type: "log", range: [-2.1, 3.6], dtick: 1, exponentformat: "power" }), legend), config);

    const ratio = (m, what, dash) => curve(theory.time, m[what].map((v, i) => v / theory[what][i]), m.colour, m.label + (what === "front" ? ", λ<sub>c</sub>" : ", R/2"), { line: { color: m.colour, width: 1.6, dash: dash } });
    const now = (where) => ({ type: "line", x0: where, x1: where, yref: "paper", y0: 0, y1: 1, line: { color: grey, width: 1.2 } });
    Plotly.react("fronts-now", d.methods.flatMap((m) => [ratio(m, "front", "solid"), ratio(m, "reaction", "dot")]),
      layout(axis("τ = t/t<sub>*</sub>"), axis("over theory", { range: [0.85, 1.15] }), Object.assign({ shapes: [now(t)] }, legend)), config);

    for (const place of document.querySelectorAll("[data-map], [data-energy]")) {
      if (!place.data) continue;
      const of = place.dataset.map ? { "shapes[0].y0": Math.sqrt(t), "shapes[0].y1": Math.sqrt(t) } : { "shapes[0].x0": t, "shapes[0].x1": t };
      Plotly.relayout(place, of);
    }
    instant.textContent = "τ = " + t.toFixed(4);
    const rows = [
      ["", "half contact length / l*", "reaction of one end / (μV₀l*/t*)", "uniform reaction / (μV₀/t*)", "gap inside, % of V₀t"],
      ["Theory", text(front), text(theory.reaction[k]), text(theory.pressure), ""],
      ...d.methods.map((m) => [m.label, text(m.front[k]), text(m.reaction[k]), text(m.pressure[k]), text(100 * m.lift[k])]),
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

  // maps and energies: a column a method; a method without this impact has an empty one
  function drawColumns() {
    const of = (label) => impact.methods.find((m) => m.label === label);
    for (const place of document.querySelectorAll("[data-map]")) {
      const m = of(place.dataset.map);
      if (!m) { Plotly.purge(place); place.textContent = "could not be computed: see below"; continue; }
      if (!place.data) place.textContent = "";
      const real = m.map.force.map((row) => mirror(row, 1));
      Plotly.react(place, [{
        x: mirror(m.map.x, -1), y: m.map.root_time, z: real.map((row) => row.map((v) => Math.log10(Math.max(v, floor)))), customdata: real, type: "heatmap", colorscale: "Viridis", zmin: -2, zmax: 3, zsmooth: false,
        colorbar: { tickvals: [-2, -1, 0, 1, 2, 3], ticktext: ["≤ .01", "0.1", "1", "10", "100", "1000"], thickness: 10, len: 1, outlinewidth: 0 },
        hovertemplate: "x = %{x:.3g}, √τ = %{y:.3g}<br>%{customdata:.4g} μV<sub>0</sub>/t<sub>*</sub><extra></extra>",
      }], layout(axis("x / l<sub>*</sub>"), axis("√τ"), { shapes: [{ type: "line", xref: "paper", x0: 0, x1: 1, y0: 0, y1: 0, line: { color: "#fff", width: 1.5 } }] }), config);
    }
    for (const place of document.querySelectorAll("[data-energy]")) {
      const m = of(place.dataset.energy), time = impact.theory.time;
      if (!m) { Plotly.purge(place); continue; }
      const drawn = Object.keys(data.energies).filter((name) => m.energy[name] && m.energy[name].some((v) => v !== 0));
      Plotly.react(place, [
        curve([time[0], time[time.length - 1]], [0, 0], black, "work of the wall", { line: { color: black, width: 1.2, dash: "dot" } }),
        ...drawn.map((name) => ({ name, ...data.energies[name] })).map((e) => curve(time, m.energy[e.name], e.colour, e.title, { hovertemplate: e.title + " %{y:.4g}<extra></extra>", line: { color: e.colour, width: 1.8, dash: e.dash ? "dash" : "solid" } })),
      ], layout(axis("τ = t/t<sub>*</sub>"), axis("energy / (μV<sub>0</sub>²l<sub>*</sub>)"), { shapes: [{ type: "line", x0: 0, x1: 0, yref: "paper", y0: 0, y1: 1, line: { color: grey, width: 1.2 } }] }), config);
    }
  }

  function choose(index) {
    impact = impacts[index];
    slider.max = impact.theory.time.length - 1;
    drawColumns();
    show(Math.min(Number(slider.value), impact.theory.time.length - 1));
  }

  for (const radio of document.querySelectorAll("input[name=impact]")) radio.addEventListener("change", () => choose(Number(radio.value)));
  slider.addEventListener("input", () => show(Number(slider.value)));
  let timer = null;
  const stop = () => { clearInterval(timer); timer = null; play.textContent = "▶"; play.setAttribute("aria-label", "Play"); };
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

  // --- the impacts together -----------------------------------------------------------------------------------
  const colours = [black, red, "#0072B2", "#009E73", "#56B4E9"], markers = ["circle-open", "square-open", "diamond-open", "triangle-up-open", "cross-open"];
  const together = (id, what, weight, title) => {
    if (!$(id)) return;
    const traces = impacts.flatMap((d, i) => {
      const time = d.theory.time, weighed = (values) => values.map((v, k) => v * weight(time[k]));
      const some = (j) => (_, k) => k % 5 === j % 5;
      return [
        curve(time, weighed(d.theory[what]), colours[i], d.title, { legendgroup: d.name, hovertemplate: "theory %{y:.4g}<extra></extra>" }),
        ...d.methods.map((m, j) => ({ x: time.filter(some(j)), y: weighed(m[what]).filter(some(j)), mode: "markers", name: m.label, showlegend: false, legendgroup: d.name, marker: { color: colours[i], size: 6, symbol: markers[j % markers.length] }, hovertemplate: m.label + " %{y:.4g}<extra></extra>" })),
      ];
    });
    Plotly.newPlot(id, traces, layout(axis("τ = t/t<sub>*</sub>"), axis(title), legend), config);
  };
  together("fronts", "front", (t) => 1 / Math.sqrt(t), "λ<sub>c</sub>/√τ");
  together("reactions", "reaction", (t) => Math.sqrt(t), "R/2 · √τ");
})();
