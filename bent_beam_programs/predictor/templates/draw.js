"use strict";
// Numbers to read, and axes of SVG pictures.
const Draw = (() => {
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

  /** A number with so many digits behind the point; of fewer than none, to tens and hundreds. */
  function fixed(value, digits) {
    const unit = 10 ** Math.abs(digits), rounded = digits < 0 ? Math.round(value / unit) * unit : value;
    const written = rounded.toFixed(Math.max(0, digits)), sign = Number(written) < 0 ? "−" : ""; // none before a zero
    return sign + written.replace("-", "");
  }

  /** Value and error, and a power of ten of both: to the first digit of the error, to the second after a 1; a value
      within its error to two digits of its own, unless it is less than a twentieth of it: as Python
      (bent_beam/measure/numbers.py). */
  function pair(value, error) {
    if (!(error > 0)) return [text(value, 6), text(error, 1), ""];
    const starts1 = (size) => (size.toExponential(1).startsWith("1") ? 1 : 0);
    const first = Number(error.toExponential(starts1(error))), more = starts1(first);  // 0.096 becomes 0.10
    const power = Math.floor(Math.log10(Math.max(Math.abs(value), first)));
    const digits = more - Math.floor(Math.log10(first));
    if (power >= 6 || power < -4) {
      const [written, size] = pair(value / 10 ** power, first / 10 ** power);
      return [written, size, `·${text(10 ** power, 1).slice(2)}`];
    }
    const size = Math.abs(value), within = 0.05 * first <= size && size < first;
    const two = Number(size.toPrecision(2)); // rounded before its digits are counted: 0.996 becomes 1.0
    const own = within ? Math.max(digits, 1 - Math.floor(Math.log10(two))) : digits;
    return [fixed(value, own), fixed(first, digits), ""];
  }
  function bar(value, error) {
    const [written, size, power] = pair(value, error);
    return power ? `(${written} ± ${size})${power}` : `${written} ± ${size}`;
  }
  /** The value alone, to the digits that its bar allows; three while there is no bar. */
  function within(value, error) {
    if (error === null) return text(value, 3);
    const [written, , power] = pair(value, error);
    return written + power;
  }

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
    for (let v = Math.ceil(low / step - 1e-9) * step; v <= high + 1e-9 * step; v += step)
      list.push(Math.abs(v) < 1e-9 * step ? 0 : v);
    return list;
  }

  /** Axes with round numbers; returns the maps to the paper. */
  function axes(svg, { width, height, left, x, y, xLabel, yLabel }) {
    svg.replaceChildren();
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const top = 26, right = 12, bottom = 34, inner = [width - left - right, height - top - bottom];
    const X = (v) => left + (v - x[0]) / (x[1] - x[0]) * inner[0];
    const Y = (v) => top + (y[1] - v) / (y[1] - y[0]) * inner[1];
    for (const v of ticks(...x, Math.max(2, Math.floor(inner[0] / 75)))) {
      draw(svg, "line", { x1: X(v), x2: X(v), y1: top, y2: top + inner[1], class: "grid" });
      draw(svg, "text", { x: X(v), y: top + inner[1] + 15, "text-anchor": "middle" }, text(v));
    }
    for (const v of ticks(...y, 4)) {
      const kind = v === 0 ? "zero" : "grid";
      draw(svg, "line", { x1: left, x2: left + inner[0], y1: Y(v), y2: Y(v), class: kind });
      draw(svg, "text", { x: left - 6, y: Y(v) + 4, "text-anchor": "end" }, text(v));
    }
    draw(svg, "text", { x: left + inner[0] / 2, y: height - 3, "text-anchor": "middle" }, xLabel);
    draw(svg, "text", { x: 4, y: 14, class: "name" }, yLabel);
    return [X, Y];
  }
  const path = (points) => points.map(([x, y], i) => `${i ? "L" : "M"}${x.toFixed(2)},${y.toFixed(2)}`).join("");

  return { text, bar, within, draw, axes, path };
})();
