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

  // --- one impact through time --------------------------------------------------------------------------------
  const impacts = data.impacts;
  if (!impacts.length) return;
  const grid = "#e4e7eb", blue = "#0072B2", red = "#D55E00", grey = "#52606d", green = "#009E73", sky = "#56B4E9";
  const slider = $("time"), instant = $("instant"), readout = $("readout"), play = $("play");
  let impact = impacts[0];

  const axis = (title, more) => Object.assign({ title: { text: title }, gridcolor: grid, zerolinecolor: "#cbd2d9", automargin: true }, more);
  const layout = (x, y, more) => Object.assign({
    font: { family: "system-ui, sans-serif", size: narrow() ? 11.5 : 13, color: "#1f2933" },
    margin: { l: narrow() ? 48 : 60, r: 10, t: 8, b: 44 }, paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "#fff", xaxis: x, yaxis: y,
    showlegend: false, hovermode: "closest", uirevision: "keep",
  }, more);
  const legend = { showlegend: true, legend: { orientation: "h", y: 1.02, yanchor: "bottom", x: 0, font: { size: 11 } } };
  const mirror = (values, sign) => values.slice().reverse().map((v) => sign * v).concat(values);
  const power = (v) => { const [digits, exponent] = v.toExponential(1).split("e"); return digits + "·10" + exponent.replace("+", "").replace(/[-0-9]/g, (c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]); };
  const text = (v) => v === null ? "–" : Math.abs(v) >= 1e-3 || v === 0 ? Number(v.toPrecision(4)).toString() : power(v);

  function show(k) {
    const d = impact, t = d.time[k], front = d.front[k], width = d.x[d.x.length - 1];
    const x = mirror(d.x, -1), high = Math.max(...d.gap[d.time.length - 1]) * d.time[d.time.length - 1];
    const line = (xs, ys, colour, wide, more) => Object.assign({ x: xs, y: ys, mode: "lines", line: { color: colour, width: wide } }, more);
    const ends = { x: [-front, front], y: [0, 0], mode: "markers", marker: { color: red, size: 8 }, hovertemplate: "end of the contact, x = %{x:.4g}<extra></extra>" };
    const lifted = d.lift[k] > 1e-4;  // only the ends touch: a dotted line in place of the zone
    const zone = (wide) => ({ x: [-front, front], y: [0, 0], mode: "lines", hoverinfo: "skip", line: { color: red, width: lifted ? 1.5 : wide, dash: lifted ? "dot" : "solid" } });
    const push = Math.min(d.reaction[k] / d.reaction[d.time.length - 1], 3);  // arrows in proportion to the reaction
    const arrow = (place) => ({ x: place, y: 0, ax: 0, ay: 14 + 16 * push, showarrow: true, arrowhead: 2, arrowwidth: 2.2, arrowcolor: red, text: "" });
    const wall = (depth) => ({ type: "rect", xref: "paper", x0: 0, x1: 1, y0: -depth, y1: 0, fillcolor: "#dfe4ea", line: { width: 0 }, layer: "below" });
    Plotly.react("beam", [
      line(x, mirror(d.gap[k].map((g) => g * t), 1), blue, 2.5, { hovertemplate: "x = %{x:.3g}<br>gap = %{y:.3g} V<sub>0</sub>t<sub>*</sub><extra>beam</extra>" }),
      zone(5), ends,
    ], layout(axis("x / l<sub>*</sub>", { range: [-width, width] }), axis("gap / (V<sub>0</sub>t<sub>*</sub>)", { range: [-0.3 * high, 1.05 * high] }), {
      shapes: [wall(high)], annotations: [arrow(-front), arrow(front)],
    }), config);

    const row = Math.max(k - 1, 0), bins = d.map.x, force = d.map.force[row];
    const top = Math.max(...d.map.force[d.map.force.length - 1]);
    Plotly.react("force", [
      { x: mirror(bins, -1), y: mirror(force, 1), type: "bar", width: bins[1] - bins[0], marker: { color: red, line: { width: 0 } }, hovertemplate: "x = %{x:.3g}<br>%{y:.4g} μV<sub>0</sub>/t<sub>*</sub><extra></extra>" },
    ], layout(axis("x / l<sub>*</sub>", { range: [-width, width] }), axis("reaction per length / (μV<sub>0</sub>/t<sub>*</sub>)", { range: [0, 2.2 * top] }), { bargap: 0 }), config);

    Plotly.react("zoom", [
      line(x, mirror(d.gap[k].map((g) => 1000 * g), 1), blue, 2.5, { hovertemplate: "x = %{x:.3g}<br>gap = %{y:.4g} ‰ of V<sub>0</sub>t<extra></extra>" }),
      zone(4), ends,
    ], layout(axis("x / l<sub>*</sub>", { range: [-1.35 * front, 1.35 * front] }), axis("gap (‰ of V<sub>0</sub>t)", { range: [-2, 9] }), { shapes: [wall(9)] }), config);

    const energy = (name, label, colour, dash) => ({ x: d.time, y: d.energy[name], mode: "lines", name: label, line: { color: colour, width: 2, dash: dash }, hovertemplate: label + " %{y:.4g}<extra></extra>" });
    Plotly.react("energy", [
      energy("work_of_loads", "work of the wall", "#000"), energy("kinetic_energy", "kinetic", blue), energy("strain_energy", "strain", red),
      energy("loss_viscous", "gone with far waves", green, "dot"),
    ], layout(axis("τ = t/t<sub>*</sub>"), axis("energy / (μV<sub>0</sub>²l<sub>*</sub>)"), Object.assign({ shapes: [{ type: "line", x0: t, x1: t, yref: "paper", y0: 0, y1: 1, line: { color: grey, width: 1.2 } }] }, legend)), config);

    Plotly.relayout("map", { "shapes[0].y0": Math.sqrt(t), "shapes[0].y1": Math.sqrt(t) });
    instant.textContent = "τ = " + t.toFixed(4);
    const facts = [
      ["half contact length", text(front) + " l*"], ["reaction at each end", text(d.reaction[k]) + " μV₀l*/t*"],
      ["uniform reaction", text(d.pressure[k]) + " μV₀/t*"], ["largest gap inside", text(100 * d.lift[k]) + " % of V₀t"],
    ];
    readout.replaceChildren(...facts.map(([name, value]) => {
      const pair = document.createElement("div"), dt = document.createElement("dt"), dd = document.createElement("dd");
      dt.textContent = name; dd.textContent = value; pair.append(dt, dd);
      return pair;
    }));
  }

  function drawMap() {
    const field = impact.map, floor = 1e-2;
    const rows = field.force.map((row) => mirror(row, 1).map((v) => Math.log10(Math.max(v, floor))));
    const real = field.force.map((row) => mirror(row, 1));
    Plotly.react("map", [{
      x: mirror(field.x, -1), y: field.root_time, z: rows, customdata: real, type: "heatmap", colorscale: "Viridis", zmin: -2, zmax: 3, zsmooth: false,
      colorbar: { title: { text: "μV<sub>0</sub>/t<sub>*</sub>", side: "top" }, tickvals: [-2, -1, 0, 1, 2, 3], ticktext: ["≤ 0.01", "0.1", "1", "10", "100", "1000"], thickness: 12, len: 1, outlinewidth: 0 },
      hovertemplate: "x = %{x:.3g}, √τ = %{y:.3g}<br>%{customdata:.4g} μV<sub>0</sub>/t<sub>*</sub><extra></extra>",
    }], layout(axis("x / l<sub>*</sub>"), axis("√τ"), { shapes: [{ type: "line", xref: "paper", x0: 0, x1: 1, y0: 0, y1: 0, line: { color: "#fff", width: 1.5 } }] }), config);
  }

  function choose(index) {
    impact = impacts[index];
    slider.max = impact.time.length - 1;
    drawMap();
    show(Math.min(Number(slider.value), impact.time.length - 1));
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
  slider.max = impact.time.length - 1;
  slider.value = Math.round(0.7 * slider.max);
  choose(0);

  // --- the three together -------------------------------------------------------------------------------------
  const colours = ["#000", red, blue, green, sky];
  const together = (id, what, weight, title) => {
    if (!$(id)) return;
    const traces = impacts.flatMap((d, i) => {
      const scaled = (values) => values.map((v, k) => v * weight(d.time[k]));
      return [
        { x: d.time, y: scaled(d[what + "_theory"]), mode: "lines", name: d.title, legendgroup: d.name, line: { color: colours[i], width: 1.6 }, hovertemplate: "theory %{y:.4g}<extra></extra>" },
        { x: d.time.filter((_, k) => k % 3 === 0), y: scaled(d[what]).filter((_, k) => k % 3 === 0), mode: "markers", showlegend: false, legendgroup: d.name, marker: { color: colours[i], size: 6, symbol: "circle-open" }, hovertemplate: "simulation %{y:.4g}<extra></extra>" },
      ];
    });
    Plotly.newPlot(id, traces, layout(axis("τ = t/t<sub>*</sub>"), axis(title), legend), config);
  };
  together("fronts", "front", (t) => 1 / Math.sqrt(t), "λ<sub>c</sub>/√τ");
  together("reactions", "reaction", (t) => Math.sqrt(t), "R/2 · √τ");
})();
