"use strict";
// The inputs as a case file that `bentbeam simulate`, `predict` and `bounce` read.
const Case = (() => {
  /** A number as TOML writes floats: shortest text that reads back as the same double. */
  const float = (value) => (Number.isInteger(value) && Math.abs(value) < 1e15 ? value.toFixed(1) : String(value));

  function toml(inputs, b, predicted) {
    const lines = [
      'title = "From the predictor"',
      "",
      "[beam]",
      `bending_stiffness = ${float(b.stiffness)}  # EI, N m²`,
      `mass_per_length = ${float(b.mass)}  # kg/m`,
      `length = ${float(b.length)}  # m`,
      `curvature = ${float(b.curvature)}  # 1/m`,
      `section_height = ${float(b.height)}  # m`,
      ...(b.tension ? [`axial_force = ${float(b.tension)}  # tension, N`] : []),
      "",
      "[impact]",
      `velocity = ${float(b.velocity)}  # m/s`,
      `acceleration = ${float(b.acceleration)}  # of the free flight, m/s²`,
      "",
      "[run]",
      `end_time = ${float(predicted.validUntil)}  # s, until when the theory holds`,
    ];
    return `${lines.join("\n")}\n`;
  }

  return { toml };
})();
if (typeof module !== "undefined") module.exports = Case;
