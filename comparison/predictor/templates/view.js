"use strict";
// The page: inputs ↔ link, numbers, plots. No number of mechanics is made here.
(() => {
  const { UNITS, CHOICES, FIELDS, START } = Beam;
  const root = document.getElementById("predictor");
  const find = (selector) => root.querySelector(selector);
  let inputs = { ...START }, predicted = null;
  const alone = !root.hasAttribute("data-embedded"); // the address of another page is not ours to change

  /** [unit, its size] of a quantity; where there are several, the largest that is not larger than the value. */
  function unit(quantity, value = 1) {
    const units = UNITS[inputs.units][quantity];
    if (typeof units[0] === "string") return units;
    return units.findLast(([, size]) => Math.abs(value) >= size) || units[0];
  }
  const shown = (quantity, value) => value / unit(quantity)[1]; // of an input
  /** A number to read: `digits` significant ones, no exponent for everyday sizes. */
  function text(value, digits = 4) {
    if (!Number.isFinite(value)) return "–";
    if (value !== 0 && (Math.abs(value) >= 1e6 || Math.abs(value) < 1e-4)) {
      const [mantissa, power] = value.toExponential(digits - 1).split("e");
      const raised = [...String(Number(power))].map((d) => (d === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[d])).join("");
      return `${Number(mantissa)}·10${raised}`.replace("-", "−");
    }
    return String(Number(value.toPrecision(digits))).replace("-", "−");
  }
  function quantity(name, value, digits) {
    const [symbol, size] = unit(name, value);
    return `${text(value / size, digits)} ${symbol}`;
  }

  // --- inputs --------------------------------------------------------------------------------------------------
  const groups = [...new Set(FIELDS.map((field) => field.group))];
  const element = (name, attributes = {}, ...children) => {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.append(...children);
    return made;
  };

  function choice({ name, label, options }) {
    const select = element("select", { id: `in-${name}`, name });
    for (const [value, title] of Object.entries(options)) select.append(element("option", { value }, title));
    select.addEventListener("change", () => { inputs[name] = select.value; fill(); update(); });
    return element("div", { class: "field" }, element("label", { for: select.id }, label), select);
  }

  function number(field) {
    const id = `in-${field.name}`, input = element("input", { id, name: field.name, type: "text", inputmode: "decimal", autocomplete: "off", spellcheck: "false", "aria-describedby": `unit-${field.name} wrong-${field.name}` });
    input.addEventListener("input", () => {
      const typed = input.value.trim().replace(",", ".").replace("−", "-");
      inputs[field.name] = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(typed) ? Number(typed) * unit(field.quantity)[1] : NaN;
      update();
    });
    return element("div", { class: "field", "data-field": field.name },
      element("label", { for: id }, field.label),
      element("span", { class: "entry" }, input, element("span", { class: "unit", id: `unit-${field.name}` })),
      element("span", { class: "wrong", id: `wrong-${field.name}`, role: "status" }));
  }

  function build() {
    const form = find("form");
    form.append(choice(CHOICES[0]));
    for (const group of groups) {
      const box = element("fieldset", {}, element("legend", {}, group));
      for (const item of CHOICES) if (item.group === group) box.append(choice(item));
      for (const field of FIELDS) if (field.group === group) box.append(number(field));
      form.append(box);
    }
  }

  /** Inputs → form, in the units chosen. */
  function fill() {
    for (const { name } of CHOICES) find(`#in-${name}`).value = inputs[name];
    for (const field of FIELDS) {
      const row = find(`[data-field=${field.name}]`), value = shown(field.quantity, inputs[field.name]);
      row.hidden = !field.shown(inputs);
      row.querySelector("input").value = Number.isFinite(value) ? String(Number(value.toPrecision(6))) : "";
      row.querySelector(".unit").textContent = unit(field.quantity)[0];
    }
  }

  // --- link ----------------------------------------------------------------------------------------------------
  function toLink() {
    const parts = new URLSearchParams();
    for (const { name } of CHOICES) parts.set(name, inputs[name]);
    for (const field of FIELDS) if (field.shown(inputs) && Number.isFinite(inputs[field.name])) parts.set(field.name, inputs[field.name]);
    return `#${parts}`;
  }

  function fromLink() {
    const given = new URLSearchParams(location.hash.slice(1));
    inputs = { ...START };
    for (const { name, options } of CHOICES) if (given.get(name) in options) inputs[name] = given.get(name);
    for (const { name } of FIELDS) if (given.has(name) && given.get(name) !== "" && Number.isFinite(Number(given.get(name)))) inputs[name] = Number(given.get(name));
  }

  // --- drawing -------------------------------------------------------------------------------------------------
  const SVG = "http://www.w3.org/2000/svg";
  const draw = (parent, name, attributes, content) => {
    const made = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    if (content !== undefined) made.textContent = content;
    parent.append(made);
    return made;
  };

  /** Round numbers in [low, high]. */
  function ticks(low, high, count) {
    const raw = (high - low) / count, power = 10 ** Math.floor(Math.log10(raw));
    const step = power * [1, 2, 5, 10].find((m) => m * power >= raw * 0.7), list = [];
    for (let v = Math.ceil(low / step - 1e-9) * step; v <= high + 1e-9 * step; v += step) list.push(Math.abs(v) < 1e-9 * step ? 0 : v);
    return list;
  }

  /** Axes with round numbers; returns the maps to the paper. */
  function axes(svg, { width, height, left, x, y, xLabel, yLabel, zero }) {
    svg.replaceChildren();
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const top = 26, right = 12, bottom = 34, inner = [width - left - right, height - top - bottom];
    const X = (v) => left + (v - x[0]) / (x[1] - x[0]) * inner[0], Y = (v) => top + (y[1] - v) / (y[1] - y[0]) * inner[1];
    for (const v of ticks(...x, Math.max(2, Math.floor(inner[0] / 75)))) {
      draw(svg, "line", { x1: X(v), x2: X(v), y1: top, y2: top + inner[1], class: "grid" });
      draw(svg, "text", { x: X(v), y: top + inner[1] + 15, "text-anchor": "middle" }, text(v));
    }
    for (const v of ticks(...y, 4)) {
      draw(svg, "line", { x1: left, x2: left + inner[0], y1: Y(v), y2: Y(v), class: v === 0 && zero ? "zero" : "grid" });
      draw(svg, "text", { x: left - 6, y: Y(v) + 4, "text-anchor": "end" }, text(v));
    }
    draw(svg, "text", { x: left + inner[0] / 2, y: height - 3, "text-anchor": "middle" }, xLabel);
    draw(svg, "text", { x: 4, y: 14, class: "name" }, yLabel);
    return [X, Y];
  }
  const path = (points) => points.map(([x, y], i) => `${i ? "L" : "M"}${x.toFixed(2)},${y.toFixed(2)}`).join("");

  const CURVES = [ // `spreads`: nothing to draw where the contact stays a point
    { id: "plot-length", label: "Half contact length", name: "place", of: (r) => r.halfLength, spreads: true },
    { id: "plot-force", label: "Force on the wall", name: "force", of: (r) => r.reaction, steep: true },
    { id: "plot-impulse", label: "Impulse", name: "impulse", of: (r) => r.impulse },
    { id: "plot-moment", label: "Largest bending moment", name: "moment", of: (r) => r.moment },
    { id: "plot-place", label: "Place of that moment", name: "place", of: (r) => r.place, spreads: true },
    { id: "plot-stress", label: "Largest stress", name: "stress", of: (r) => r.stress },
  ];

  function drawCurves(end, now) {
    const count = 80, [second, perSecond] = unit("time", end), point = predicted.contact.regime === "discrete";
    for (const { id, spreads } of CURVES) find(`#${id}`).style.display = spreads && point ? "none" : "";
    const width = Math.max(260, find("#plot-force").clientWidth || 320); // read once: each reading after a change costs a layout
    const instants = Array.from({ length: count }, (_, i) => end * ((i + 1) / count) ** 2);
    const answers = instants.map((t) => [t, Beam.at(predicted, t)]), present = now > 0 ? Beam.at(predicted, now) : null;
    for (const { id, label, name, of, steep, spreads } of CURVES) {
      if (spreads && point) continue;
      const svg = find(`#${id}`), points = answers.map(([t, r]) => [t, of(r)]);
      // the force starts as 1/√t: its axis ends where the curve leaves it
      const top = steep ? 4 * points[count - 1][1] : Math.max(...points.map((p) => p[1]));
      const high = top > 0 ? 1.08 * top : 1, [symbol, size] = unit(name, top);
      const [X, Y] = axes(svg, {
        width, height: 170, left: 58, x: [0, end / perSecond], y: [0, high / size],
        xLabel: `time, ${second}`, yLabel: `${label}, ${symbol}`, zero: true,
      });
      const place = ([t, value]) => [X(t / perSecond), Y(value / size)];
      draw(svg, "path", { d: path(points.filter((p) => p[1] <= high).map(place)), class: "curve" });
      const value = present ? of(present) : Infinity;
      if (value <= high) {
        const [cx, cy] = place([now, value]);
        draw(svg, "circle", { cx, cy, r: 4.5, class: "now" });
      }
    }
  }

  function drawShape(end, now) {
    const svg = find("#shape"), width = Math.max(300, svg.clientWidth || 640), height = width < 480 ? 230 : 280;
    const p = predicted, { lambda0 } = p.contact, reach = Math.sqrt(p.c * end);
    const window = Math.min(p.half, Math.max(1.6 * lambda0, lambda0 + 3) * reach);
    const high = 1.05 * Math.max(Beam.gap(p, window, 0), Beam.gap(p, window, end));
    const low = Math.min(-0.12 * high, Math.max(Beam.freeGap(p, 0, end), -0.45 * high));
    const [along, metre] = unit("place", window), [across, deep] = unit("gap", high);
    const [X, Y] = axes(svg, {
      width, height, left: 58, x: [-window / metre, window / metre], y: [low / deep, high / deep],
      xLabel: `along the beam, ${along}`, yLabel: `Gap, ${across}`, zero: false,
    });
    const x = (place) => X(place / metre), y = (gap) => Y(gap / deep), wall = y(0);
    draw(svg, "rect", { x: x(-window), width: x(window) - x(-window), y: wall, height: y(low) - wall, class: "wall" });
    const beam = [], free = [], count = 120;
    for (let i = -count; i <= count; i++) {
      const place = window * i / count, below = Beam.freeGap(p, place, now);
      beam.push([x(place), y(Math.max(0, Beam.gap(p, Math.abs(place), now)))]);
      if (below >= low && below <= high) free.push([x(place), y(below)]);
    }
    draw(svg, "path", { d: path(free), class: "free" });
    draw(svg, "path", { d: path(beam), class: "beam" });
    if (!(now > 0)) return;
    const front = Beam.at(p, now).halfLength;
    if (p.contact.regime === "continuous") draw(svg, "line", { x1: x(-front), x2: x(front), y1: wall, y2: wall, class: "contact" });
    for (const at of new Set([x(-front), x(front)])) draw(svg, "path", { d: `M${at},${wall + 3}l-5,10h10z`, class: "push" });
  }

  // --- words and numbers -----------------------------------------------------------------------------------------
  const REGIMES = {
    discrete: ["Contact stays one point.", "The beam is too curved, or too slow, for the contact to spread (κ/ν ≥ 1)."],
    continuous: ["Contact spreads.", "It grows with √t, and a concentrated force travels with each of its ends."],
    detached: ["Contact spreads as two points.", "They move apart while the middle lifts off the wall between them."],
  };

  function rows(now) {
    const r = Beam.at(predicted, now), p = predicted;
    const where = r.place > 0 ? `${quantity("place", r.place, 3)} from the middle` : "in the contact";
    const list = [
      ["Half contact length", p.contact.regime === "discrete" ? "one point" : quantity("place", r.halfLength)],
      ["Force on the wall", quantity("force", r.reaction)],
      ["Uniform reaction in the zone", r.uniform > 0 ? quantity("load", r.uniform) : "none"],
      ["Impulse so far", quantity("impulse", r.impulse)],
      ["Largest bending moment", `${quantity("moment", r.moment)}, ${where}`],
      ["Largest stress", quantity("stress", r.stress)],
    ];
    if (inputs.yield_stress > 0) list.push(["Share of the yield stress", `${text(100 * r.stress / inputs.yield_stress, 3)} %`]);
    return list;
  }

  function time() {
    return predicted.shownUntil * (Number(find("#predict-time").value) / 1000) ** 2;
  }

  function show() {
    const now = time();
    find("#predict-instant").textContent = quantity("time", now);
    find("#values").replaceChildren(...(now > 0 ? rows(now) : [["At first touch", "no impulse yet"]]).map(([name, value]) => element("div", {}, element("dt", {}, name), element("dd", {}, value))));
    drawShape(predicted.shownUntil, now);
    drawCurves(predicted.shownUntil, now);
  }

  function update() {
    const wrong = new Map(Beam.complaints(inputs));
    for (const field of FIELDS) {
      const row = find(`[data-field=${field.name}]`), message = wrong.get(field.name) || "";
      row.querySelector(".wrong").textContent = message;
      row.querySelector("input").setAttribute("aria-invalid", String(message !== ""));
    }
    find("#answer").hidden = wrong.size > 0;
    find("#cannot").hidden = wrong.size === 0;
    find("#brief").textContent = find("#cannot").textContent;
    if (wrong.size) return;
    const problem = Beam.impact(inputs);
    predicted = Beam.solve(problem);
    const [verdict, why] = REGIMES[predicted.contact.regime];
    find("#verdict").textContent = verdict;
    const lifted = predicted.contact.regime === "continuous" && problem.damping > 0;
    find("#why").textContent = why + (lifted ? " The beam’s own damping lifts its middle off the wall for a time." : "");
    const { stress, moment } = Beam.at(predicted, predicted.shownUntil), yields = inputs.yield_stress > 0 && stress > inputs.yield_stress;
    const share = inputs.yield_stress > 0 ? ` (${text(100 * stress / inputs.yield_stress, 3)} % of yield)` : "";
    const peak = `Largest stress ${quantity("stress", stress)}${share}`;
    const without = problem.damping > 0 && predicted.contact.ratio < 1 ? " (without the damping, which may take most of it away)" : "";
    find("#peak").textContent = `${peak}, largest bending moment ${quantity("moment", moment)}${without}.`;
    find("#brief").textContent = `${peak} ↓`;
    const stubby = predicted.ends === "shear";
    const from = predicted.validFrom > 0.01 * predicted.validUntil ? `from ${quantity("time", predicted.validFrom, 2)} (${predicted.validAfter}) ` : "";
    find("#holds").textContent = yields
      ? "The largest stress exceeds the yield stress: a real beam would deform plastically. The numbers below are those of an elastic beam."
      : stubby
        ? "This beam is too short and thick: shear, which the theory leaves out, matters at all times. Take the numbers as an indication."
        : predicted.validUntil === 0
          ? `This does not hold to 2 % at any time: ${predicted.limitedBy}. Take the numbers as an indication.`
          : `This holds to 2 % ${from}until ${quantity("time", predicted.validUntil, 3)} after first touch; then ${predicted.limitedBy}.`;
    find("#holds").classList.toggle("alarm", yields || stubby || predicted.validUntil === 0);
    find("#groups").textContent = `κ/ν = ${problem.wallCurvature ? "(K − K of the wall)" : "K"}√(EI/μ)/V₀ = ${text(predicted.contact.ratio, 5)} · λ₀ = ${text(predicted.contact.lambda0, 6)} · r₀ = ${text(predicted.contact.r0, 6)} · EI = ${text(problem.stiffness, 5)} N m² · μ = ${text(problem.mass, 5)} kg/m · K = ${text(problem.curvature, 5)} 1/m · V₀ = ${text(problem.velocity, 5)} m/s`;
    find("#case").textContent = Case.toml(inputs, problem, predicted);
    if (alone) history.replaceState(null, "", toLink());
    show();
  }

  function save() {
    const link = element("a", { href: URL.createObjectURL(new Blob([find("#case").textContent], { type: "application/toml" })), download: "impact.toml" });
    link.click();
    URL.revokeObjectURL(link.href);
  }

  async function copyLink() {
    const note = find("#copied");
    try {
      await navigator.clipboard.writeText(location.href);
      note.textContent = "Copied.";
    } catch {
      note.textContent = "The address bar holds the link.";
    }
  }

  build();
  if (alone) fromLink();
  find("#copy").hidden = !alone;
  fill();
  update();
  find("#predict-time").addEventListener("input", show);
  find("#brief").addEventListener("click", () => find("#result").scrollIntoView());
  find("#save").addEventListener("click", save);
  find("#copy").addEventListener("click", copyLink);
  find("#reset").addEventListener("click", () => { inputs = { ...START }; fill(); update(); });
  if (alone) addEventListener("hashchange", () => { fromLink(); fill(); update(); });
  addEventListener("resize", () => { if (!find("#answer").hidden) show(); });
})();
