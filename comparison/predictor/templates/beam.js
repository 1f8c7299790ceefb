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
      curvature: ["1/m", 1], sagitta: ["mm", 1e-3], dogleg: ["°/30 m", PI / 180 / 30], velocity: ["m/s", 1], drop: ["m", 1],
      tension: ["kN", 1e3], load: ["N/m", 1], stress: ["MPa", 1e6], share: ["%", 0.01],
      time: [["µs", 1e-6], ["ms", 1e-3], ["s", 1]], force: [["N", 1], ["kN", 1e3], ["MN", 1e6]],
      impulse: [["mN s", 1e-3], ["N s", 1], ["kN s", 1e3]], moment: [["N m", 1], ["kN m", 1e3]],
      place: [["mm", 1e-3], ["m", 1]], gap: [["µm", 1e-6], ["mm", 1e-3], ["m", 1]],
    },
    oilfield: {
      section: ["in", 0.0254], length: ["ft", 0.3048], modulus: ["Mpsi", 6.894757293168e9], density: ["lb/ft³", 16.01846337396],
      line: ["lb/ft", 1.488163943570], curvature: ["1/ft", 1 / 0.3048], sagitta: ["in", 0.0254],
      dogleg: ["°/100 ft", PI / 180 / 30.48], velocity: ["ft/s", 0.3048], drop: ["ft", 0.3048],
      tension: ["klbf", 4448.2216152605], load: ["lbf/ft", 14.593902937206], stress: ["ksi", 6.894757293168e6], share: ["%", 0.01],
      time: [["µs", 1e-6], ["ms", 1e-3], ["s", 1]], force: [["lbf", 4.4482216152605], ["klbf", 4448.2216152605]],
      impulse: [["lbf s", 4.4482216152605]], moment: [["ft lbf", 1.3558179483314], ["ft klbf", 1355.8179483314]],
      place: [["in", 0.0254], ["ft", 0.3048]], gap: [["mil", 2.54e-5], ["in", 0.0254], ["ft", 0.3048]],
    },
  };

  // Every input: name, label, quantity, value to start with (SI), least value, when it is asked for.
  const positive = (v) => v > 0, whole = (v) => v >= 0, any = () => true;
  const on = (field, ...kinds) => (i) => kinds.includes(i[field]);
  const CHOICES = [
    { name: "units", label: "Units", group: "", options: { si: "metric", oilfield: "oilfield" } },
    { name: "section", label: "Section", group: "Beam", options: { pipe: "pipe", round_bar: "round bar", rectangle: "rectangle" } },
    { name: "bow", label: "Given as", group: "Bow", options: { curvature: "curvature", sagitta: "sagitta over a length", dogleg: "dogleg" } },
    { name: "approach", label: "Given as", group: "Approach", options: { velocity: "velocity", drop: "drop height" } },
  ];
  const FIELDS = [
    { name: "outer_diameter", label: "Outer diameter", quantity: "section", start: 0.127, ok: positive, shown: on("section", "pipe") },
    { name: "inner_diameter", label: "Inner diameter", quantity: "section", start: 0.1086, ok: positive, shown: on("section", "pipe") },
    { name: "diameter", label: "Diameter", quantity: "section", start: 0.02, ok: positive, shown: on("section", "round_bar") },
    { name: "thickness", label: "Thickness (towards the wall)", quantity: "section", start: 0.01, ok: positive, shown: on("section", "rectangle") },
    { name: "width", label: "Width (along the wall)", quantity: "section", start: 0.03, ok: positive, shown: on("section", "rectangle") },
    { name: "youngs_modulus", label: "Young’s modulus E", quantity: "modulus", start: 206e9, ok: positive },
    { name: "density", label: "Density", quantity: "density", start: 7850, ok: positive },
    { name: "fluid_density", label: "Density of fluid inside", quantity: "density", start: 0, ok: whole, shown: on("section", "pipe") },
    { name: "added_mass", label: "Added mass (joints, mud)", quantity: "line", start: 2.29, ok: whole },
    { name: "yield_stress", label: "Yield stress (0: unknown)", quantity: "stress", start: 931e6, ok: whole },
    { name: "length", label: "Length L", quantity: "length", start: 90, ok: positive },
    { name: "curvature", label: "Curvature K", quantity: "curvature", start: 0.002, ok: positive, shown: on("bow", "curvature"), group: "Bow" },
    { name: "sagitta", label: "Sagitta", quantity: "sagitta", start: 0.025, ok: positive, shown: on("bow", "sagitta"), group: "Bow" },
    { name: "sagitta_length", label: "Length of the sagitta", quantity: "length", start: 10, ok: positive, shown: on("bow", "sagitta"), group: "Bow" },
    { name: "dogleg", label: "Dogleg", quantity: "dogleg", start: 3.437747 * PI / 180 / 30, ok: positive, shown: on("bow", "dogleg"), group: "Bow" },
    { name: "natural_share", label: "Share of it free of stress", quantity: "share", start: 1, ok: any, group: "Bow" },
    { name: "velocity", label: "Velocity V₀", quantity: "velocity", start: 2, ok: positive, shown: on("approach", "velocity"), group: "Approach" },
    { name: "drop_height", label: "Drop height", quantity: "drop", start: 0.2, ok: positive, shown: on("approach", "drop"), group: "Approach" },
    { name: "tension", label: "Axial force (tension +)", quantity: "tension", start: 0, ok: any, group: "Loads" },
    { name: "load", label: "Load towards the wall", quantity: "load", start: 0, ok: any, group: "Loads" },
    { name: "damping_ratio", label: "Damping ratio, 1st mode", quantity: "share", start: 0, ok: whole, group: "Beam" },
    { name: "wall_curvature", label: "Curvature (hollow +)", quantity: "curvature", start: 0, ok: any, group: "Wall" },
  ];
  for (const field of FIELDS) {
    field.shown = field.shown || (() => true);
    field.group = field.group || "Beam";
  }
  const START = { units: "si", section: "pipe", bow: "dogleg", approach: "velocity" };
  for (const field of FIELDS) START[field.name] = field.start;

  /** What is wrong with the inputs: a list of [field name, sentence]. */
  function complaints(inputs) {
    const list = [];
    for (const field of FIELDS) {
      const value = inputs[field.name];
      if (!field.shown(inputs)) continue;
      if (!Number.isFinite(value)) list.push([field.name, `${field.label} needs a number.`]);
      else if (!field.ok(value)) list.push([field.name, `${field.label} must ${field.ok === positive ? "be positive" : "not be negative"}.`]);
    }
    if (inputs.section === "pipe" && inputs.inner_diameter >= inputs.outer_diameter)
      list.push(["inner_diameter", "The inner diameter must be smaller than the outer one."]);
    if (inputs.bow === "sagitta" && inputs.sagitta >= inputs.sagitta_length / 2)
      list.push(["sagitta", "The sagitta must be less than half the length under it."]);
    if (inputs.bow === "sagitta" && inputs.sagitta_length > inputs.length)
      list.push(["sagitta_length", "The length of the sagitta must not exceed that of the beam."]);
    if (!list.length && inputs.wall_curvature && inputs.wall_curvature >= bow(inputs))
      list.push(["wall_curvature", "The wall must be less curved than the beam, or no point touches first."]);
    return list;
  }

  /** Curvature K of the bow, 1/m. */
  const bow = (i) => (i.bow === "dogleg" ? i.dogleg
    : i.bow === "sagitta" ? 8 * i.sagitta / (i.sagitta_length ** 2 + 4 * i.sagitta ** 2) : i.curvature);

  /** Area, second moment of area, height in the plane of bending and mass per length of the section, SI. */
  function section(i) {
    let area, second, height, bore = 0;
    if (i.section === "rectangle") [area, second, height] = [i.width * i.thickness, i.width * i.thickness ** 3 / 12, i.thickness];
    else {
      const outer = i.section === "pipe" ? i.outer_diameter : i.diameter, inner = i.section === "pipe" ? i.inner_diameter : 0;
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
    return { area, second, height, shear, stiffness: i.youngs_modulus * second, mass: i.density * area + i.fluid_density * bore + i.added_mass };
  }

  /** The impact of the inputs: EI, μ, L, K, V₀, N, and a₀ of the free flight under weight, push and tension (SI). */
  function impact(i) {
    const { area, second, height, shear, stiffness, mass } = section(i);
    const curvature = bow(i);
    const velocity = i.approach === "drop" ? sqrt(2 * GRAVITY * i.drop_height) : i.velocity;
    const weight = i.approach === "drop" ? GRAVITY : 0;
    return {
      stiffness, mass, length: i.length, curvature, velocity, tension: i.tension, area, height, shear, modulus: second / (height / 2),
      acceleration: weight + (i.load - i.tension * curvature) / mass, curvatureRate: 0, fourthDerivative: 0,
      wallCurvature: i.wall_curvature, naturalCurvature: i.natural_share * curvature,
      damping: 2 * i.damping_ratio * (i.length / FIRST_MODE) ** 2 / sqrt(stiffness / mass),
    };
  }

  /** Largest bending moment, N m, and where, x/√(ct); `factor` multiplies what the wall adds at the contact. */
  function largest({ b, moments }, factor = 1) {
    const unit = b.velocity * sqrt(b.stiffness * b.mass), before = b.stiffness * (b.naturalCurvature - b.curvature);
    const contact = abs(before + unit * moments.contact * factor), ahead = abs(before - unit * moments.crest);
    if (contact >= Math.max(ahead, abs(before))) return { moment: contact, place: 0 };
    return ahead >= abs(before) ? { moment: ahead, place: moments.ahead } : { moment: abs(before), place: Infinity };
  }

  /** Groups, contact parameters, scales and the limit in time of one impact. */
  function solve(b) {
    const c = sqrt(b.stiffness / b.mass), half = b.length / 2, lengthScale = c / b.velocity;
    const timeScale = c / b.velocity / b.velocity, slow = half * half / c;
    const contact = Theory.contact(
      (b.curvature - b.wallCurvature) * lengthScale,
      b.acceleration * (timeScale / b.velocity),
      b.fourthDerivative * lengthScale ** 3,
      b.curvatureRate * lengthScale * (lengthScale / b.velocity),
      b.tension / (b.mass * b.velocity ** 2),
    );
    const form = Theory.shape(contact), moments = Theory.peakMoment(contact);
    const solved = { b, c, half, lengthScale, timeScale, slow, contact, form, moments, epsilon: timeScale / slow };
    return Object.assign(solved, limit(solved));
  }

  /** What ends the theory's validity, in words. */
  const ENDINGS = {
    ends: "waves come back from the beam’s ends",
    loads: "the loads have changed the contact too much for a first-order correction",
    tension: "the axial force has changed the contact too much for a first-order correction",
    damping: "the beam’s own damping rules, and was not measured for so flat or so short a contact, or so early",
    touch: "the middle of the contact, which the first instants have lifted, comes back to the wall with a pulse",
    slope: "the beam’s slopes are no longer small",
  };

  /** What spoils it before it holds. */
  const STARTS = {
    damping: "before, the beam’s own damping rules, and was not measured so early",
    shear: "before, the beam shears as much as it bends, which the theory leaves out",
  };

  const SHOWN = 0.03; // T*: about when the ends are felt

  /** From and until when the theory holds to 2 %, s, what spoils it before and what ends it. `shear` of a problem is κ_s G A, N. */
  function limit(p) {
    const { b, contact, timeScale } = p, quartic = b.fourthDerivative * p.half ** 4 / (b.velocity * p.slow);
    const { begins, until, by } = Theory.validity(contact, p.slow / timeScale, LIMITS, b.damping / p.slow, quartic);
    const shears = b.shear ? sqrt(b.stiffness * b.mass) / b.shear : 0;
    const sheared = LIMITS.shear[contact.regime === "discrete" ? "point" : "zone"] * shears, validUntil = until * timeScale;
    const validFrom = Math.max(begins * timeScale, sheared);
    // where nothing holds the numbers are shown as far as they would without what spoils them
    const validAfter = sheared > begins * timeScale ? STARTS.shear : STARTS.damping;
    if (!(until > 0)) return { validFrom: 0, validUntil: 0, shownUntil: SHOWN * p.slow, limitedBy: ENDINGS[by], ends: by };
    return validFrom < validUntil ? { validFrom, validAfter, validUntil, shownUntil: validUntil, limitedBy: ENDINGS[by], ends: by }
      : { validFrom: validUntil, validUntil, shownUntil: validUntil, limitedBy: "", ends: "shear" };
  }

  /** Contact, force, impulse, moment and stress at the time t > 0, SI. */
  function at(p, t) {
    const { b, c, contact } = p, tau = t / p.timeScale, root = sqrt(c), momentum = b.mass * b.velocity;
    const uniform = contact.uniform * momentum / p.timeScale, front = 2 * Theory.s * momentum * root;
    const damped = Theory.damped(contact, t / b.damping, LIMITS.zone), point = contact.regime === "discrete";
    const spread = root * sqrt(t) * (contact.lambda0 + contact.lambda1 * tau), half = spread * damped.length;
    // one point: the loads' part is that without damping; a zone: its whole law has the measured factor
    const force = damped.reaction * contact.r0 + (point ? 1 : damped.reaction) * contact.r1 * tau;
    const sum = damped.impulse * contact.r0 + (point ? 1 : damped.impulse) * contact.r1 * tau / 3;
    const pressed = Theory.pressFactors(contact, t / b.damping, contact.uniform * tau, LIMITS);
    const { moment, place } = largest(p, damped.moment);
    return {
      halfLength: pressed[0] * half,
      reaction: pressed[1] * (front * force / sqrt(t) + 2 * half * uniform),
      uniform,
      impulse: pressed[2] * (2 * front * sqrt(t) * sum
        + 4 * uniform * root * t ** 1.5 * (contact.lambda0 / 3 + contact.lambda1 * tau / 5)),
      moment,
      place: min(place * root * sqrt(t), p.half),
      stress: moment / b.modulus + abs(b.tension) / b.area,
    };
  }

  /** Gap between beam and wall at the distance x from the first touch and the time t ≥ 0, m. */
  function gap(p, x, t) {
    const { b } = p;
    if (!(t > 0)) return (b.curvature - b.wallCurvature) * x * x / 2 - b.fourthDerivative * x ** 4 / 24;
    const tau = t / p.timeScale, place = abs(x) / sqrt(p.c * t);
    return -Theory.beamAt(p.form, place, tau)[0] * b.velocity * t;
  }

  /** The beam where it would be without the wall. */
  const freeGap = ({ b }, x, t) => (b.curvature - b.wallCurvature) * x * x / 2 - b.velocity * t - b.acceleration * t * t / 2
    - b.curvatureRate * x * x * t / 2 - b.fourthDerivative * x ** 4 / 24;

  return { UNITS, CHOICES, FIELDS, START, complaints, section, impact, solve, at, gap, freeGap };
})();
if (typeof module !== "undefined") module.exports = Beam;
