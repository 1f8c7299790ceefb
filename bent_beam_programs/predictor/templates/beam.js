"use strict";
// A beam as one knows it → EI, μ, K, V₀ and loads (SI) → what the theory says of it, and until when.
const Beam = (() => {
  const { sqrt, abs, min, PI } = Math;
  const GRAVITY = 9.80665; // m/s², standard
  const FIRST_MODE = 4.730040744862704; // first root of cos z cosh z = 1, the free–free beam

  // quantity: [unit, its size in SI], metric and oilfield; several where a result picks the one that suits its size
  const UNITS = {
    si: {
      section: ["mm", 1e-3], length: ["m", 1], modulus: ["GPa", 1e9], density: ["kg/m³", 1], line: ["kg/m", 1],
      curvature: ["1/m", 1], sagitta: ["mm", 1e-3], dogleg: ["°/30 m", PI / 180 / 30],
      velocity: ["m/s", 1], drop: ["m", 1],
      tension: ["kN", 1e3], load: ["N/m", 1], stress: ["MPa", 1e6], share: ["%", 0.01], stiffness: ["MN/m²", 1e6],
      time: [["µs", 1e-6], ["ms", 1e-3], ["s", 1]], force: [["N", 1], ["kN", 1e3], ["MN", 1e6]],
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
      time: [["µs", 1e-6], ["ms", 1e-3], ["s", 1]], force: [["lbf", 4.4482216152605], ["klbf", 4448.2216152605]],
      impulse: [["lbf s", 4.4482216152605]], moment: [["ft lbf", 1.3558179483314], ["ft klbf", 1355.8179483314]],
      place: [["in", 0.0254], ["ft", 0.3048]], gap: [["mil", 2.54e-5], ["in", 0.0254], ["ft", 0.3048]],
    },
  };

  // Every input: group, name, label, quantity, value to start with (SI), which values may be, when it is asked for.
  const positive = (v) => v > 0, whole = (v) => v >= 0, any = () => true; // of values; `any` of inputs too
  const on = (field, ...kinds) => (i) => kinds.includes(i[field]);
  const CHOICES = [
    { name: "units", label: "Units", group: "", options: { si: "metric", oilfield: "oilfield" } },
    { name: "section", label: "Section", group: "Beam",
      options: { pipe: "pipe", round_bar: "round bar", rectangle: "rectangle" } },
    { name: "bow", label: "Given as", group: "Bow",
      options: { curvature: "curvature", sagitta: "sagitta over a length", dogleg: "dogleg" } },
    { name: "approach", label: "Given as", group: "Approach", options: { velocity: "velocity", drop: "drop height" } },
  ];
  const FIELDS = [
    ["Beam", "outer_diameter", "Outer diameter", "section", 0.127, positive, on("section", "pipe")],
    ["Beam", "inner_diameter", "Inner diameter", "section", 0.1086, positive, on("section", "pipe")],
    ["Beam", "diameter", "Diameter", "section", 0.02, positive, on("section", "round_bar")],
    ["Beam", "thickness", "Thickness (towards the wall)", "section", 0.01, positive, on("section", "rectangle")],
    ["Beam", "width", "Width (along the wall)", "section", 0.03, positive, on("section", "rectangle")],
    ["Beam", "youngs_modulus", "Young’s modulus E", "modulus", 206e9, positive],
    ["Beam", "density", "Density", "density", 7850, positive],
    ["Beam", "fluid_density", "Density of fluid inside", "density", 0, whole, on("section", "pipe")],
    ["Beam", "added_mass", "Added mass (joints, mud)", "line", 2.29, whole],
    ["Beam", "yield_stress", "Yield stress (0: unknown)", "stress", 931e6, whole],
    ["Beam", "length", "Length L", "length", 90, positive],
    ["Bow", "curvature", "Curvature K", "curvature", 0.002, positive, on("bow", "curvature")],
    ["Bow", "sagitta", "Sagitta", "sagitta", 0.025, positive, on("bow", "sagitta")],
    ["Bow", "sagitta_length", "Length of the sagitta", "length", 10, positive, on("bow", "sagitta")],
    ["Bow", "dogleg", "Dogleg", "dogleg", 3.437747 * PI / 180 / 30, positive, on("bow", "dogleg")],
    ["Bow", "natural_share", "Stress-free part of the bow", "share", 1, any],
    ["Approach", "velocity", "Velocity V₀", "velocity", 2, positive, on("approach", "velocity")],
    ["Approach", "drop_height", "Drop height", "drop", 0.2, positive, on("approach", "drop")],
    ["Loads", "tension", "Axial force (tension +)", "tension", 0, any],
    ["Loads", "load", "Load towards the wall", "load", 0, any],
    ["Beam", "damping_ratio", "Damping ratio, 1st mode", "share", 0, whole],
    ["Wall", "wall_curvature", "Wall curvature along the beam (+ concave)", "curvature", 0, any],
    ["Wall", "wall_stiffness", "Stiffness per length of beam (0: rigid)", "stiffness", 0, whole],
  ].map(([group, name, label, quantity, start, ok, shown = any]) => (
    { group, name, label, quantity, start, ok, shown }
  ));
  const START = { units: "si", section: "pipe", bow: "dogleg", approach: "velocity" };
  for (const field of FIELDS) START[field.name] = field.start;

  /** What is wrong with the inputs: a list of [field name, sentence]. */
  function complaints(inputs) {
    const list = [];
    for (const field of FIELDS) {
      const value = inputs[field.name];
      if (!field.shown(inputs)) continue;
      const rule = field.ok === positive ? "be positive" : "not be negative";
      if (!Number.isFinite(value)) list.push([field.name, `${field.label} needs a number, without thousands separators.`]);
      else if (!field.ok(value)) list.push([field.name, `${field.label} must ${rule}.`]);
    }
    if (inputs.section === "pipe" && inputs.inner_diameter >= inputs.outer_diameter)
      list.push(["inner_diameter", "The inner diameter must be smaller than the outer one."]);
    if (inputs.bow === "sagitta" && inputs.sagitta >= inputs.sagitta_length / 2)
      list.push(["sagitta", "The sagitta must be less than half the length under it."]);
    if (inputs.bow === "sagitta" && inputs.sagitta_length > inputs.length)
      list.push(["sagitta_length", "The length of the sagitta must not exceed that of the beam."]);
    if (!list.length && inputs.wall_curvature && inputs.wall_curvature >= bow(inputs))
      list.push(["wall_curvature", "The wall must be less curved than the beam, or no point touches first."]);
    if (!list.length && inputs.tension < -(PI ** 2) * section(inputs).stiffness / inputs.length ** 2)
      list.push(["tension", "The axial force must not exceed the load at which a straight beam buckles."]);
    return list;
  }

  /** Curvature K of the bow, 1/m. */
  const bow = (i) => (i.bow === "dogleg" ? i.dogleg
    : i.bow === "sagitta" ? 8 * i.sagitta / (i.sagitta_length ** 2 + 4 * i.sagitta ** 2) : i.curvature);

  /** Area, second moment of area, height in the plane of bending and mass per length of the section, SI. */
  function section(i) {
    let area, second, height, bore = 0;
    if (i.section === "rectangle") {
      [area, second, height] = [i.width * i.thickness, i.width * i.thickness ** 3 / 12, i.thickness];
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
    const shear = coefficient * i.youngs_modulus / (2 * (1 + n)) * area;
    const mass = i.density * area + i.fluid_density * bore + i.added_mass;
    return { area, second, height, shear, stiffness: i.youngs_modulus * second, mass };
  }

  /** The impact of the inputs: EI, μ, L, K, V₀, N, and a₀ of the free flight under weight, push and tension (SI). */
  function impact(i) {
    const { area, second, height, shear, stiffness, mass } = section(i);
    const curvature = bow(i), weight = i.approach === "drop" ? GRAVITY : 0;
    return {
      stiffness, mass, length: i.length, curvature, tension: i.tension, area, shear, modulus: second / (height / 2),
      velocity: i.approach === "drop" ? sqrt(2 * GRAVITY * i.drop_height) : i.velocity,
      acceleration: weight + (i.load - i.tension * curvature) / mass,
      wallCurvature: i.wall_curvature, wallStiffness: i.wall_stiffness, naturalCurvature: i.natural_share * curvature,
      damping: 2 * i.damping_ratio * (i.length / FIRST_MODE) ** 2 / sqrt(stiffness / mass),
    };
  }

  /** Groups, contact parameters, scales and limits of one impact. */
  function solve(b) {
    const c = sqrt(b.stiffness / b.mass), half = b.length / 2, lengthScale = c / b.velocity;
    const timeScale = lengthScale / b.velocity, slow = half * half / c;
    const ratio = (b.curvature - b.wallCurvature) * lengthScale;
    const alpha = b.acceleration * timeScale / b.velocity, n = b.tension / (b.mass * b.velocity ** 2);
    const contact = Theory.contact(ratio, alpha, n);
    const solved = { b, c, half, timeScale, slow, contact }, limits = Limits.limits(solved);
    // where nothing holds the numbers are shown as far as they would without what spoils them
    const unit = b.velocity * sqrt(b.mass) * (b.stiffness * b.wallStiffness) ** 0.25;
    const peakForce = b.wallStiffness ? unit * Theory.peakForce(ratio) : null; // of a wall that gives way
    return { ...solved, limits, peakForce, shownUntil: limits.until, first: bending(solved) };
  }

  /** Stress of a bending moment together with the axial force, Pa. */
  const stressOf = (b, moment) => moment / b.modulus + abs(b.tension) / b.area;

  /** Largest bending moment (N m) of the first instants, its stress, and its place, x/√(ct); constant in time. */
  function bending({ b, contact: { moment } }) {
    const unit = b.velocity * sqrt(b.stiffness * b.mass), before = b.stiffness * (b.naturalCurvature - b.curvature);
    const candidates = [
      { moment: abs(before + unit * moment.contact), place: 0 },
      { moment: abs(before - unit * moment.ahead), place: moment.place },
      { moment: abs(before), place: Infinity },
    ];
    const largest = candidates.reduce((a, b) => (b.moment > a.moment ? b : a));
    return { ...largest, stress: stressOf(b, largest.moment) };
  }

  /** Contact, force, impulse, moment and stress at the time t > 0, SI. */
  function at(p, t) {
    const { b, c, contact: { lambda0, lambda1, r0, r1, uniform }, first } = p, tau = t / p.timeScale;
    const momentum = b.mass * b.velocity, root = sqrt(c * t), front = 2 * Theory.s * momentum * root;
    const halfLength = root * (lambda0 + lambda1 * tau), pressure = uniform * momentum / p.timeScale;
    return {
      halfLength,
      uniform: pressure,
      reaction: front * (r0 + r1 * tau) / t + 2 * halfLength * pressure,
      impulse: 2 * front * (r0 + r1 * tau / 3) + 4 * pressure * root * t * (lambda0 / 3 + lambda1 * tau / 5),
      moment: first.moment,
      place: min(first.place * root, p.half),
      stress: first.stress,
    };
  }

  /** Gap between beam and wall at the distance x from the first touch and the time t ≥ 0 at leading order, m. */
  function gap(p, x, t) {
    return t > 0 ? Theory.gap(p.contact, abs(x) / sqrt(p.c * t)) * p.b.velocity * t : freeGap(p, x, 0);
  }

  /** The beam where it would be without the wall, at leading order. */
  const freeGap = ({ b }, x, t) => (b.curvature - b.wallCurvature) * x * x / 2 - b.velocity * t;

  return { UNITS, CHOICES, FIELDS, START, complaints, impact, solve, at, gap, freeGap };
})();
