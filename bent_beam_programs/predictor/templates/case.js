"use strict";
// The inputs as a case file that `bentbeam predict`, `simulate` and `bounce` read: described as they were given.
const Case = (() => {
  /** A number as TOML writes floats: the shortest text that reads back as the same double. */
  const float = (value) => (Number.isInteger(value) && Math.abs(value) < 1e15 ? value.toFixed(1) : String(value));
  const line = (name, value, comment) => `${name} = ${float(value)}  # ${comment}`;

  const SHAPES = {
    pipe: ["outer_diameter", "inner_diameter"],
    round_bar: ["diameter"],
    rectangle: ["thickness", "width"],
  };

  function toml(i, impact, predicted) {
    const given = (name, unit) => (i[name] ? [line(name, i[name], unit)] : []);
    const bow = {
      curvature: () => [line("curvature", i.curvature, "1/m")],
      sagitta: () => [line("sagitta", i.sagitta, "m"), line("sagitta_length", i.sagitta_length, "m")],
      dogleg: () => [line("dogleg", i.dogleg * 30 * 180 / Math.PI, "degrees in 30 m")],
    };
    const holds = predicted.limits.until > predicted.limits.from;
    const drop = i.approach === "drop";
    const approach = drop ? line("drop_height", i.drop_height, "m") : line("velocity", i.velocity, "m/s");
    const loads = `m/s²: weight, tension and a push of ${float(i.load)} N/m`;
    return [
      'title = "From the predictor"',
      "",
      "[section]",
      `kind = "${i.section}"`,
      ...SHAPES[i.section].map((name) => line(name, i[name], "m")),
      line("youngs_modulus", i.youngs_modulus, "Pa"),
      line("density", i.density, "kg/m³"),
      ...(i.section === "pipe" ? given("fluid_density", "kg/m³, inside") : []),
      ...given("added_mass", "kg/m"),
      ...given("yield_stress", "Pa"),
      "",
      "[beam]",
      line("length", i.length, "m"),
      ...bow[i.bow](),
      ...(i.natural_share === 1 ? [] : [line("natural_curvature", impact.naturalCurvature, "1/m, free of stress")]),
      ...(i.damping_ratio ? [line("damping_ratio", i.damping_ratio, "of the lowest bending mode")] : []),
      ...(i.tension ? [line("axial_force", i.tension, "N, tension positive")] : []),
      "",
      "[impact]",
      approach,
      ...(i.load ? [line("acceleration", impact.acceleration, loads)] : []),
      "",
      "[wall]",
      ...(i.wall_curvature ? [line("curvature", i.wall_curvature, "1/m, hollow > 0")] : []),
      ...(i.wall_stiffness ? [line("stiffness", i.wall_stiffness, "N/m per m of beam")] : []),
      "",
      "[run]",
      line("end_time", predicted.shownUntil, holds ? "s, until when the first instants hold" : "s"),
      "",
    ].join("\n");
  }

  return { toml };
})();
