"use strict";
// The inputs: fields in the units chosen, the link that holds them, one slider for the field last touched.
const Form = (() => {
  const { UNITS, CHOICES, FIELDS, START } = Beam, { text } = Draw;
  const find = (selector) => document.querySelector(selector);
  let inputs = { ...START }, changed = () => {}, dragged = null;

  const element = (name, attributes = {}, ...children) => {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.append(...children);
    return made;
  };

  /** [unit, its size] of a quantity; where there are several, the largest that is not larger than the value. */
  function unit(quantity, value = 1) {
    const units = UNITS[inputs.units][quantity];
    if (typeof units[0] === "string") return units;
    return units.findLast(([, size]) => Math.abs(value) >= size) || units[0];
  }
  function quantity(name, value, digits) {
    const [symbol, size] = unit(name, value);
    return `${text(value / size, digits)} ${symbol}`;
  }

  function choice({ name, label, options }) {
    const select = element("select", { id: `in-${name}`, name });
    for (const [value, title] of Object.entries(options)) select.append(element("option", { value }, title));
    select.addEventListener("change", () => { inputs[name] = select.value; fill(); changed(); });
    return element("div", { class: "field", "data-field": name }, element("label", { for: select.id }, label), select);
  }

  /** What is typed, in SI; null: left empty. 1,000 is a thousand to some and one to others: no number. */
  function typed(field, value) {
    const trimmed = value.trim(), plain = trimmed.replace(",", ".").replace("−", "-");
    if (!trimmed && field.empty) return null;
    const number = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(plain) && !/[1-9]\d{0,2},\d{3}(e|$)/i.test(trimmed);
    return number ? Number(plain) * unit(field.quantity)[1] : NaN;
  }

  function number(field) {
    const id = `in-${field.name}`, input = element("input", {
      id, name: field.name, type: "text", inputmode: "decimal", autocomplete: "off", spellcheck: "false",
      placeholder: field.empty, "aria-describedby": `unit-${field.name} wrong-${field.name}`,
    });
    input.addEventListener("input", () => {
      inputs[field.name] = typed(field, input.value);
      if (field.empty) fill(input); // whether there is a value decides which other fields there are
      grip(field);
      changed();
    });
    input.addEventListener("focus", () => grip(field));
    return element("div", { class: "field", "data-field": field.name },
      element("label", { for: id }, field.label),
      element("span", { class: "entry" }, input, element("span", { class: "unit", id: `unit-${field.name}` })),
      element("span", { class: "wrong", id: `wrong-${field.name}`, role: "status" }));
  }

  /** The slider takes a field with a value other than 0: from a quarter to four times of it. */
  function grip(field) {
    const value = inputs[field.name];
    if (!value || !Number.isFinite(value)) return;
    dragged = { field, value };
    find("#drag").value = 0;
    find("#drag-label").textContent = `Drag: ${field.label}`;
  }
  function drag() {
    if (!dragged) return; // no field has had such a value yet
    const { field, value } = dragged;
    inputs[field.name] = Number((value * 4 ** Number(find("#drag").value)).toPrecision(4));
    find(`#in-${field.name}`).value = shown(field);
    changed();
  }

  function shown(field) {
    const value = inputs[field.name] / unit(field.quantity)[1];
    return inputs[field.name] === null || !Number.isFinite(value) ? "" : String(Number(value.toPrecision(6)));
  }

  /** Inputs → form, in the units chosen; not into the field that is being typed in. */
  function fill(typing = null) {
    for (const { name, shown: asked } of CHOICES) {
      find(`#in-${name}`).value = inputs[name];
      find(`[data-field=${name}]`).hidden = asked ? !asked(inputs) : false;
    }
    for (const field of FIELDS) {
      const box = find(`[data-field=${field.name}]`), input = box.querySelector("input");
      box.hidden = !field.shown(inputs);
      if (input !== typing) input.value = shown(field);
      box.querySelector(".unit").textContent = unit(field.quantity)[0];
    }
  }

  /** Mistakes beside their fields; true where there is any. */
  function complain() {
    const wrong = new Map(Beam.complaints(inputs));
    for (const field of FIELDS) {
      const box = find(`[data-field=${field.name}]`), message = wrong.get(field.name) || "";
      box.querySelector(".wrong").textContent = message;
      box.querySelector("input").setAttribute("aria-invalid", String(message !== ""));
    }
    return wrong.size > 0;
  }

  function toLink() {
    const parts = new URLSearchParams();
    for (const { name } of CHOICES) parts.set(name, inputs[name]);
    const asked = FIELDS.filter((field) => field.shown(inputs) && !Number.isNaN(inputs[field.name]));
    for (const { name } of asked) parts.set(name, inputs[name] ?? "");
    return `#${parts}`;
  }

  function fromLink() {
    const given = new URLSearchParams(location.hash.slice(1)), found = { ...START };
    for (const { name, options } of CHOICES) if (Object.hasOwn(options, given.get(name))) found[name] = given.get(name);
    for (const { name, empty } of FIELDS) {
      const value = given.get(name);
      if (value === "" && empty) found[name] = null;
      else if (value && Number.isFinite(Number(value))) found[name] = Number(value);
    }
    return found;
  }

  function set(found) {
    const arrives = found.approach === "drop" ? "drop_height" : "velocity";
    inputs = found;
    fill();
    grip(FIELDS.find(({ name }) => name === arrives));
  }

  /** Build the fields; `listener` is called with each change. */
  function start(listener) {
    const form = find("form");
    form.prepend(choice(CHOICES[0]));
    for (const group of new Set(FIELDS.map((field) => field.group))) {
      const box = element("fieldset", {}, element("legend", {}, group));
      for (const item of CHOICES) if (item.group === group) box.append(choice(item));
      for (const field of FIELDS) if (field.group === group) box.append(number(field));
      form.append(box);
    }
    find("#drag").addEventListener("input", drag);
    find("#drag").addEventListener("change", () => dragged && grip(dragged.field));
    changed = listener;
    set(fromLink());
  }

  return { find, element, unit, quantity, inputs: () => inputs, set, start, complain, toLink, fromLink };
})();
