"use strict";
// A beam as one knows it → EI, μ, κ_sGA, K, V₀ and loads (SI) → the numbers of its whole impact to simulate.
const Beam = (() => {
  const { sqrt, abs, PI } = Math;
  const GRAVITY = 9.80665; // m/s², standard

  // quantity: [unit, its size in SI], metric and oilfield; several where a result picks the one that suits its size
  const UNITS = {
    si: {
      section: ["mm", 1e-3], length: ["m", 1], modulus: ["GPa", 1e9], density: ["kg/m³", 1], line: ["kg/m", 1],
      curvature: ["1/m", 1], sagitta: ["mm", 1e-3], dogleg: ["°/30 m", PI / 180 / 30],
      velocity: ["m/s", 1], drop: ["m", 1],
      tension: ["kN", 1e3], load: ["N/m", 1], stress: ["MPa", 1e6], share: ["%", 0.01], stiffness: ["MN/m²", 1e6],
      gravity: ["m/s²", 1], area: ["cm²", 1e-4], second: ["cm⁴", 1e-8],
      time: [["µs", 1e-6], ["ms", 1e-3], ["s", 1]], force: [["N", 1], ["kN", 1e3], ["MN", 1e6]],
      push: [["N/m", 1], ["kN/m", 1e3]],
      impulse: [["mN s", 1e-3], ["N s", 1], ["kN s", 1e3]], moment: [["N m", 1], ["kN m", 1e3]],
      place: [["mm", 1e-3], ["m", 1]], gap: [["µm", 1e-6], ["mm", 1e-3], ["m", 1]],
    },
    oilfield: {
      section: ["in", 0.0254], length: ["ft", 0.3048],
      modulus: ["Mpsi", 6.894757293168e9], density: ["lb/ft³", 16.01846337396],
      line: ["lb/ft", 1.488163943570], curvature: ["1/ft", 1 / 0.3048], sagitta: ["in", 0.0254],
      dogleg: ["°/100 ft", PI / 180 / 30.48], velocity: ["ft/s", 0.3048], drop: ["ft", 0.3048],
      tension: ["klbf", 4448.2216152605], load: ["lbf/ft", 14.593902937206],
      stress: ["ksi", 6.894757293168e6], share: ["%", 0.01], stiffness: ["klbf/in²", 6.894757293168e6],
      gravity: ["ft/s²", 0.3048], area: ["in²", 0.0254 ** 2], second: ["in⁴", 0.0254 ** 4],
      time: [["µs", 1e-6], ["ms", 1e-3], ["s", 1]], force: [["lbf", 4.4482216152605], ["klbf", 4448.2216152605]],
      push: [["lbf/ft", 14.593902937206], ["klbf/ft", 14593.902937206]],
      impulse: [["lbf s", 4.4482216152605]], moment: [["ft lbf", 1.3558179483314], ["ft klbf", 1355.8179483314]],
      place: [["in", 0.0254], ["ft", 0.3048]], gap: [["mil", 2.54e-5], ["in", 0.0254], ["ft", 0.3048]],
    },
  };

  // Every input: group, name, label, quantity, value to start with (SI), which values may be, when it is asked for, and
  // what it means to leave it empty (null), where that is allowed.
  const positive = (v) => v > 0, whole = (v) => v >= 0, any = () => true; // of values; `any` of inputs too
  const on = (field, ...kinds) => (i) => kinds.includes(i[field]);
  const CHOICES = [
    { name: "units", label: "Units", group: "", options: { si: "metric", oilfield: "oilfield" } },
    { name: "section", label: "Section", group: "Beam",
      options: { pipe: "pipe", round_bar: "round bar", rectangle: "rectangle", general: "by its area and I" } },
    { name: "model", label: "Shear", group: "Beam", shown: on("section", "pipe", "round_bar", "rectangle"),
      options: { timoshenko: "counts", euler_bernoulli: "left out" } },
    { name: "bow", label: "Given as", group: "Bow",
      options: { sagitta: "sagitta", curvature: "curvature", dogleg: "dogleg" } },
    { name: "approach", label: "Given as", group: "Approach", options: { velocity: "velocity", drop: "drop height" } },
  ];
  const FIELDS = [
    ["Beam", "outer_diameter", "Outer diameter", "section", 0.05, positive, on("section", "pipe")],
    ["Beam", "inner_diameter", "Inner diameter", "section", 0.044, positive, on("section", "pipe")],
    ["Beam", "diameter", "Diameter", "section", 0.02, positive, on("section", "round_bar")],
    ["Beam", "thickness", "Thickness (towards the wall)", "section", 0.01, positive, on("section", "rectangle")],
    ["Beam", "width", "Width (along the wall)", "section", 0.03, positive, on("section", "rectangle")],
    ["Beam", "area_of_section", "Area", "area", 76.7e-4, positive, on("section", "general")],
    ["Beam", "second_moment_of_area", "Second moment of area", "second", 3038.3e-8, positive, on("section", "general")],
    ["Beam", "section_height", "Height", "section", 0.172, positive, on("section", "general")],
    ["Beam", "youngs_modulus", "Young’s modulus E", "modulus", 70e9, positive],
    ["Beam", "density", "Density", "density", 2700, positive],
    ["Beam", "fluid_density", "Density of fluid inside", "density", 0, whole, on("section", "pipe")],
    ["Beam", "added_mass", "Added mass (joints, mud)", "line", 0, whole],
    ["Beam", "yield_stress", "Yield stress", "stress", 240e6, positive, any, "unknown"],
    ["Beam", "length", "Length L", "length", 3, positive],
    ["Beam", "damping_ratio", "Damping ratio, 1st mode", "share", 0.01, whole, any, "not stated"],
    ["Bow", "curvature", "Curvature K", "curvature", 0.009, positive, on("bow", "curvature")],
    ["Bow", "sagitta", "Sagitta", "sagitta", 0.01, positive, on("bow", "sagitta")],
    ["Bow", "sagitta_length", "Length of the sagitta", "length", null, positive, on("bow", "sagitta"), "L"],
    ["Bow", "dogleg", "Dogleg", "dogleg", 0.5 * PI / 180, positive, on("bow", "dogleg")],
    ["Bow", "natural_share", "Stress-free part of the bow", "share", 1, any],
    ["Approach", "velocity", "Velocity V₀", "velocity", 1, positive, on("approach", "velocity")],
    ["Approach", "drop_height", "Drop height", "drop", 0.05, positive, on("approach", "drop")],
    ["Loads", "gravity", "Gravity towards the wall", "gravity", 9.81, whole, any, "drop: 9.81"],
    ["Loads", "load", "Other load towards the wall", "load", 0, any],
    ["Loads", "tension", "Axial force (tension +)", "tension", 0, any],
    ["Wall", "wall_stiffness", "Stiffness per length of beam", "stiffness", null, positive, any, "rigid"],
    ["Wall", "wall_damping_ratio", "Damping ratio of the wall", "share", 0, whole, (i) => i.wall_stiffness !== null],
    ["Wall", "wall_curvature", "Curvature along the beam (+ concave)", "curvature", 0, any],
  ].map(([group, name, label, quantity, start, ok, shown = any, empty = ""]) => (
    { group, name, label, quantity, start, ok, shown, empty }
  ));
  const START = { units: "si", section: "pipe", model: "timoshenko", bow: "sagitta", approach: "velocity" };
  for (const field of FIELDS) START[field.name] = field.start;

  /** What is wrong with the inputs: a list of [field name, sentence]. */
  function complaints(inputs) {
    const list = [];
    for (const field of FIELDS) {
      const value = inputs[field.name];
      if (!field.shown(inputs) || (value === null && field.empty)) continue;
      const rule = field.ok === positive ? "be positive" : "not be negative";
      if (!Number.isFinite(value))
        list.push([field.name, `${field.label} needs a number, without thousands separators.`]);
      else if (!field.ok(value)) list.push([field.name, `${field.label} must ${rule}.`]);
    }
    if (inputs.section === "pipe" && inputs.inner_diameter >= inputs.outer_diameter)
      list.push(["inner_diameter", "The inner diameter must be smaller than the outer one."]);
    if (inputs.bow === "sagitta" && inputs.sagitta >= chord(inputs) / 2)
      list.push(["sagitta", "The sagitta must be less than half the length under it."]);
    if (inputs.approach === "drop" && inputs.gravity === 0)
      list.push(["gravity", "A drop needs gravity."]);
    if (inputs.bow === "sagitta" && inputs.sagitta_length > inputs.length)
      list.push(["sagitta_length", "The length of the sagitta must not exceed that of the beam."]);
    if (!list.length && inputs.wall_curvature && inputs.wall_curvature >= bow(inputs))
      list.push(["wall_curvature", "The wall must be less curved than the beam, or no point touches first."]);
    const { stiffness, shear } = section(inputs), most = PI ** 2 * stiffness / inputs.length ** 2;
    if (!list.length && inputs.tension < -most / (1 + (shear && most / shear)))
      list.push(["tension", "The axial force must not exceed the load at which a straight beam buckles."]);
    return list;
  }

  /** Curvature K of the bow, 1/m, and the length of its sagitta. */
  const chord = (i) => i.sagitta_length ?? i.length;
  const bow = (i) => (i.bow === "dogleg" ? i.dogleg
    : i.bow === "sagitta" ? 8 * i.sagitta / (chord(i) ** 2 + 4 * i.sagitta ** 2) : i.curvature);

  /** Area, section modulus, EI, mass per length, and of a beam that shears κ_sGA and ρI, SI. */
  function section(i) {
    let area, second, height, bore = 0;
    if (i.section === "rectangle") {
      [area, second, height] = [i.width * i.thickness, i.width * i.thickness ** 3 / 12, i.thickness];
    } else if (i.section === "general") {
      [area, second, height] = [i.area_of_section, i.second_moment_of_area, i.section_height];
    } else {
      const [outer, inner] = i.section === "pipe" ? [i.outer_diameter, i.inner_diameter] : [i.diameter, 0];
      const wall = (outer - inner) * (outer + inner);
      [area, second, height] = [PI / 4 * wall, PI / 64 * wall * (outer ** 2 + inner ** 2), outer];
      bore = PI / 4 * inner ** 2;
    }
    // shear: κ_s G A with Cowper's coefficients (1966) at Poisson's ratio 0.3
    const n = 0.3, hollow = (i.inner_diameter / i.outer_diameter) ** 2, rim = (1 + hollow) ** 2;
    const coefficient = {
      pipe: 6 * (1 + n) * rim / ((7 + 6 * n) * rim + (20 + 12 * n) * hollow),
      round_bar: 6 * (1 + n) / (7 + 6 * n),
      rectangle: 10 * (1 + n) / (12 + 11 * n),
    }[i.section];
    const sheared = coefficient && i.model === "timoshenko";
    return {
      area, modulus: second / (height / 2), stiffness: i.youngs_modulus * second,
      mass: i.density * area + (i.section === "pipe" ? i.fluid_density * bore : 0) + i.added_mass,
      shear: sheared ? coefficient * i.youngs_modulus / (2 * (1 + n)) * area : 0,
      turning: sheared ? i.density * second : 0, gyration: sqrt(second / area),
      sound: sqrt(i.youngs_modulus / i.density), strain: abs(i.tension) / (i.youngs_modulus * area),
    };
  }

  /** The impact of the inputs, SI: the section, L, K, V₀, N, η (null: not stated), a₀ of the free flight, the wall. */
  function impact(i) {
    const made = section(i), curvature = bow(i), drop = i.approach === "drop";
    const gravity = i.gravity ?? (drop ? GRAVITY : 0), stiffness = i.wall_stiffness ?? 0;
    return {
      ...made, length: i.length, curvature, tension: i.tension, weightAdded: gravity * i.added_mass,
      velocity: drop ? sqrt(2 * gravity * i.drop_height) : i.velocity,
      acceleration: gravity + (i.load - i.tension * curvature) / made.mass,
      wallCurvature: i.wall_curvature, wallStiffness: stiffness, naturalCurvature: i.natural_share * curvature,
      wallDamping: 2 * i.wall_damping_ratio * sqrt(stiffness * made.mass), yieldStress: i.yield_stress,
      damping: i.damping_ratio === null ? null : dampingTime(made, i.length, i.damping_ratio),
    };
  }

  /** η (s) of a damping ratio of the first free–free mode without shear. */
  const dampingTime = ({ stiffness, mass }, length, ratio) => (
    2 * ratio * (length / RUNS.mode) ** 2 / sqrt(stiffness / mass));

  /** SI units of ℓ = EI = μ = V₀ = 1. */
  function scales(b) {
    const half = b.length / 2, c = sqrt(b.stiffness / b.mass), time = half * half / c;
    const impulse = b.mass * half * b.velocity, force = impulse / time;
    const moment = b.velocity * sqrt(b.stiffness * b.mass);
    return { length: half, time, deflection: b.velocity * time, impulse, force, line: force / half, moment };
  }

  /** The problem that solver.js simulates, of η = `damping`. */
  function problem(b, damping) {
    const { length, time } = scales(b), bend = sqrt(b.stiffness / b.mass) / b.velocity;
    const tension = b.tension * length ** 2 / b.stiffness, line = length ** 4 / b.stiffness;
    return {
      kappa: (b.curvature - b.wallCurvature) * bend, eta: damping / time,
      shear: b.shear * length ** 2 / b.stiffness, turning: b.turning / (b.mass * length ** 2),
      load: b.acceleration * time / b.velocity, tension, pull: tension * b.curvature * bend,
      before: (b.naturalCurvature - b.curvature) * bend,
      wall: b.wallStiffness ? { k: b.wallStiffness * line, c: b.wallDamping * line / time } : null,
    };
  }

  /** Stress of a bending moment together with the axial force, Pa. */
  const stress = (b, moment) => moment / b.modulus + abs(b.tension) / b.area;

  return { GRAVITY, UNITS, CHOICES, FIELDS, START, complaints, bow, impact, dampingTime, scales, problem, stress };
})();
