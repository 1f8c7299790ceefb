"use strict";
// The page: inputs ↔ link, numbers, plots. No number of mechanics is made here.
(() => {
  const { UNITS, CHOICES, FIELDS, START } = Beam, { text, bar, draw, axes, path } = Draw;
  const { REGIMES, CAUSES, YIELDS, GIVES_WAY, SIMULATE, SHEARED } = Words;
  const find = (selector) => document.querySelector(selector);
  let inputs = { ...START }, predicted = null;

  /** [unit, its size] of a quantity; where there are several, the largest that is not larger than the value. */
  function unit(quantity, value = 1) {
    const units = UNITS[inputs.units][quantity];
    if (typeof units[0] === "string") return units;
    return units.findLast(([, size]) => Math.abs(value) >= size) || units[0];
  }
  const shown = (quantity, value) => value / unit(quantity)[1]; // of an input
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
    const id = `in-${field.name}`, input = element("input", {
      id, name: field.name, type: "text", inputmode: "decimal", autocomplete: "off", spellcheck: "false",
      "aria-describedby": `unit-${field.name} wrong-${field.name}`,
    });
    input.addEventListener("input", () => {
      const text = input.value.trim(), typed = text.replace(",", ".").replace("−", "-");
      // 1,000 is a thousand to some and one to others
      const plain = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(typed) && !/[1-9]\d{0,2},\d{3}(e|$)/i.test(text);
      inputs[field.name] = plain ? Number(typed) * unit(field.quantity)[1] : NaN;
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
    const asked = FIELDS.filter((field) => field.shown(inputs) && Number.isFinite(inputs[field.name]));
    for (const { name } of asked) parts.set(name, inputs[name]);
    return `#${parts}`;
  }

  function fromLink() {
    const given = new URLSearchParams(location.hash.slice(1));
    inputs = { ...START };
    for (const { name, options } of CHOICES) if (Object.hasOwn(options, given.get(name))) inputs[name] = given.get(name);
    for (const { name } of FIELDS) {
      const value = Number(given.get(name) || NaN);
      if (Number.isFinite(value)) inputs[name] = value;
    }
  }

  // --- drawing -------------------------------------------------------------------------------------------------
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
    // read once: each reading after a change costs a layout
    const width = Math.max(260, find("#plot-force").clientWidth || 320);
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
    const front = lambda0 * Math.sqrt(p.c * now);
    if (front > 0) draw(svg, "line", { x1: x(-front), x2: x(front), y1: wall, y2: wall, class: "contact" });
    const ends = new Set([x(-front), x(front)]);
    for (const end of ends) draw(svg, "path", { d: `M${end},${wall + 3}l-5,10h10z`, class: "push" });
  }

  /** What there is beside the page: no simulation where shear is the obstacle. */
  const otherwise = ({ sheared }) => (sheared ? SHEARED : SIMULATE);

  /** The largest stress of the first instants, and until when. */
  function stresses({ first, shownUntil, limits }) {
    return `first instants, until ${quantity("time", shownUntil, 3)}: ${quantity("stress", first.stress)}; `
      + `whole impact: ${otherwise(limits)}`;
  }

  /** When the first instants hold. */
  function holding({ limits: { from, after, until, by } }) {
    const first = quantity("time", from, 2), last = quantity("time", until, 3);
    if (from === Infinity)
      return `Without damping the first instants would hold to 2 % until ${last}; then ${CAUSES[by]}.`;
    if (from >= until)
      return `The first instants hold at no time: until ${first} ${CAUSES[after]}; from ${last} on ${CAUSES[by]}.`;
    const start = from > 0.01 * until ? `from ${first} (before, ${CAUSES[after]}) ` : "";
    return `The first instants hold to 2 % ${start}until ${last} after first touch; then ${CAUSES[by]}.`;
  }

  /** Whether the stress of the first instants is beyond the yield stress. */
  function yields({ first }) {
    return inputs.yield_stress > 0 && first.stress > inputs.yield_stress;
  }

  function rows(now) {
    const r = Beam.at(predicted, now);
    const where = r.place > 0 ? `${quantity("place", r.place, 3)} from the middle` : "in the contact";
    return [
      ["Half contact length", predicted.contact.regime === "discrete" ? "one point" : quantity("place", r.halfLength)],
      ["Force on the wall", quantity("force", r.reaction)],
      ["Uniform reaction in the zone", r.uniform > 0 ? quantity("load", r.uniform) : "none"],
      ["Impulse so far", quantity("impulse", r.impulse)],
      ["Largest bending moment so far", `${quantity("moment", r.moment)}, ${where}`],
      ["Largest stress so far", quantity("stress", r.stress)],
    ];
  }

  const time = () => predicted.shownUntil * (Number(find("#predict-time").value) / 1000) ** 2;

  function show() {
    const now = time(), listed = now > 0 ? rows(now) : [["At first touch", "no impulse yet"]];
    find("#predict-instant").textContent = quantity("time", now);
    const item = ([name, value]) => element("div", {}, element("dt", {}, name), element("dd", {}, value));
    find("#values").replaceChildren(...listed.map(item));
    drawShape(predicted.shownUntil, now);
    drawCurves(predicted.shownUntil, now);
  }

  /** Mistakes beside their fields; true where there is any. */
  function complain() {
    const wrong = new Map(Beam.complaints(inputs));
    for (const field of FIELDS) {
      const row = find(`[data-field=${field.name}]`), message = wrong.get(field.name) || "";
      row.querySelector(".wrong").textContent = message;
      row.querySelector("input").setAttribute("aria-invalid", String(message !== ""));
    }
    find("#answer").hidden = wrong.size > 0;
    find("#cannot").hidden = wrong.size === 0;
    find("#brief").textContent = find("#cannot").textContent;
    return wrong.size > 0;
  }

  function update() {
    if (complain()) return;
    const b = Beam.impact(inputs);
    predicted = Beam.solve(b);
    const { contact, limits, peakForce } = predicted, [verdict, why] = REGIMES[contact.regime];
    const words = {
      verdict, why, brief: `Largest stress: ${stresses(predicted)} ↓`,
      peak: `Largest stress: ${stresses(predicted)}.`,
      force: peakForce ? `Largest force on the wall: ${quantity("force", peakForce, 4)} ± ${GIVES_WAY}` : "",
      yields: yields(predicted) ? YIELDS : "",
      holds: holding(predicted),
      damped: b.damping > 0 ? `The first instants are those of an undamped beam. For this one: ${otherwise(limits)}.` : "",
      whole: `How the beam leaves the wall, and its largest stress until then: ${otherwise(limits)}.`,
      groups: [
        `κ/ν = ${b.wallCurvature ? "(K − K of the wall)" : "K"}√(EI/μ)/V₀ = ${text(contact.ratio, 5)}`,
        `λ₀ = ${text(contact.lambda0, 6)}`, `r₀ = ${text(contact.r0, 6)}`, `EI = ${text(b.stiffness, 5)} N m²`,
        `μ = ${text(b.mass, 5)} kg/m`, `K = ${text(b.curvature, 5)} 1/m`, `V₀ = ${text(b.velocity, 5)} m/s`,
      ].join(" · "),
      case: Case.toml(inputs, b, predicted),
    };
    for (const [id, value] of Object.entries(words)) find(`#${id}`).textContent = value;
    find("#holds").classList.toggle("alarm", limits.from >= limits.until);
    history.replaceState(null, "", toLink());
    show();
  }

  function save() {
    const file = new Blob([find("#case").textContent], { type: "application/toml" });
    const link = element("a", { href: URL.createObjectURL(file), download: "impact.toml" });
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
  fromLink();
  fill();
  update();
  find("#predict-time").addEventListener("input", show);
  find("#brief").addEventListener("click", () => find("#result").scrollIntoView());
  find("#save").addEventListener("click", save);
  find("#copy").addEventListener("click", copyLink);
  find("#reset").addEventListener("click", () => { inputs = { ...START }; fill(); update(); });
  addEventListener("hashchange", () => { fromLink(); fill(); update(); });
  addEventListener("resize", () => { if (!find("#answer").hidden) show(); });
})();
