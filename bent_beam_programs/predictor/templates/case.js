"use strict";
// The inputs as a case file that `bentbeam predict`, `bounce` and `sweep` read, and such a file as inputs.
const Case = (() => {
  /** A number as TOML writes floats: the shortest text that reads back as the same double. */
  const float = (value) => (Number.isInteger(value) && Math.abs(value) < 1e15 ? value.toFixed(1) : String(value));
  const DEGREES = 30 * 180 / Math.PI; // dogleg: 1/m in degrees in 30 m

  const SHAPES = {
    pipe: ["outer_diameter", "inner_diameter"],
    round_bar: ["diameter"],
    rectangle: ["thickness", "width"],
    general: ["area_of_section", "second_moment_of_area", "section_height"],
  };
  const UNITS = { area_of_section: "m²", second_moment_of_area: "m⁴" };

  function toml(i, b, title = "From the page") {
    const line = (name, value, unit) => (value === null ? [] : [`${name} = ${float(value)}  # ${unit}`]);
    const given = (name, value, unit) => (value ? line(name, value, unit) : []); // nothing said where it is 0
    const bow = {
      curvature: () => line("curvature", i.curvature, "1/m"),
      sagitta: () => [...line("sagitta", i.sagitta, "m"), ...line("sagitta_length", i.sagitta_length, "m")],
      dogleg: () => line("dogleg", i.dogleg * DEGREES, "degrees in 30 m"),
    };
    const drop = i.approach === "drop" && !i.load; // a case has gravity or an acceleration, not both
    return [
      `title = ${JSON.stringify(title)}`,
      "",
      "[section]",
      `kind = "${i.section}"`,
      ...SHAPES[i.section].flatMap((name) => line(name, i[name], UNITS[name] || "m")),
      ...line("youngs_modulus", i.youngs_modulus, "Pa"),
      ...line("density", i.density, "kg/m³"),
      ...(i.section === "pipe" ? given("fluid_density", i.fluid_density, "kg/m³, inside") : []),
      ...given("added_mass", i.added_mass, "kg/m"),
      ...given("yield_stress", i.yield_stress, "Pa"),
      "",
      "[beam]",
      ...line("length", i.length, "m"),
      ...bow[i.bow](),
      ...(i.natural_share === 1 ? [] : line("natural_curvature", b.naturalCurvature, "1/m, free of stress")),
      ...line("damping_ratio", i.damping_ratio, "of the first bending mode"),
      ...given("axial_force", i.tension, "N, tension positive"),
      ...(i.model === "euler_bernoulli" && i.section !== "general" ? ['model = "euler_bernoulli"'] : []),
      "",
      "[impact]",
      ...(drop ? line("drop_height", i.drop_height, "m") : line("velocity", b.velocity, "m/s")),
      ...(i.load ? [] : line("gravity", i.gravity, "m/s², towards the wall")),
      ...(i.load ? line("acceleration", b.acceleration, `m/s²: gravity, tension and ${float(i.load)} N/m`) : []),
      "",
      "[wall]",
      ...given("curvature", i.wall_curvature, "1/m, concave > 0"),
      ...line("stiffness", i.wall_stiffness, "N/m per m of beam"),
      ...(i.wall_stiffness === null ? [] : given("damping_ratio", i.wall_damping_ratio, "of the wall")),
      "",
    ].join("\n");
  }

  /** Tables of a TOML file of plain values: table → key → text, number or true/false. Throws Error for other lines. */
  function tables(text) {
    const found = {}, KEY = /^([A-Za-z0-9_-]+)\s*=\s*(?:"([^"\\]*)"|'([^']*)'|([^\s#"'[{]+))\s*(?:#.*)?$/;
    let table = "";
    for (const [number, raw] of text.replace(/^\uFEFF/, "").split(/\r?\n/).entries()) {
      const line = raw.trim(), head = /^\[\s*([A-Za-z0-9_.-]+)\s*\]\s*(?:#.*)?$/.exec(line), pair = KEY.exec(line);
      if (!line || line.startsWith("#")) continue;
      if (head) { table = head[1]; continue; }
      if (!pair) throw new Error(`line ${number + 1} is not read here: ${line.slice(0, 60)}`);
      const [, key, double, single, bare] = pair, word = bare?.replace(/_/g, "");
      if (bare !== undefined && !/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(word))
        throw new Error(`line ${number + 1}: ${key} = ${bare} is not a number`);
      (found[table] ||= {})[key] = double ?? single ?? Number(word);
    }
    return found;
  }

  const SAME = ["fluid_density", "added_mass", "yield_stress", "youngs_modulus", "density"];
  function one(name, value, known) {
    if (!known.includes(value)) throw new Error(`${name} must be one of ${known.join(", ")} here (got ${value})`);
    return value;
  }
  /** table.key → what it sets of the inputs `i`; all other keys are refused by name. */
  const KEYS = {
    "section.kind": (i, v) => { i.section = one("section.kind", v, Object.keys(SHAPES)); },
    ...Object.fromEntries([...SAME, ...Object.values(SHAPES).flat()].map((name) => (
      [`section.${name}`, (i, v) => { i[name] = v; }]))),
    "section.wall_thickness": (i, v) => { i.inner_diameter = i.outer_diameter - 2 * v; },
    "beam.length": (i, v) => { i.length = v; },
    "beam.curvature": (i, v) => { i.bow = "curvature"; i.curvature = v; },
    "beam.sagitta": (i, v) => { i.bow = "sagitta"; i.sagitta = v; },
    "beam.sagitta_length": (i, v) => { i.sagitta_length = v; },
    "beam.dogleg": (i, v) => { i.bow = "dogleg"; i.dogleg = v / DEGREES; },
    "beam.natural_curvature": (i, v) => { i.natural_share = v / Beam.bow(i); },
    "beam.damping_ratio": (i, v) => { i.damping_ratio = v; },
    "beam.axial_force": (i, v) => { i.tension = v; },
    "beam.model": (i, v) => { i.model = one("beam.model", v, ["timoshenko", "euler_bernoulli"]); },
    "impact.velocity": (i, v) => { i.approach = "velocity"; i.velocity = v; },
    "impact.drop_height": (i, v) => { i.approach = "drop"; i.drop_height = v; },
    "impact.gravity": (i, v) => { i.gravity = v; },
    "impact.gravity_angle": (i, v) => {
      if (v && i.gravity === null && i.approach !== "drop")
        throw new Error("impact.gravity_angle has no effect without impact.gravity");
      i.gravity ??= i.approach === "drop" ? Beam.GRAVITY : 0;
      const towards = i.gravity * (Math.abs(v) === 90 ? 0 : Math.cos(v * Math.PI / 180));
      i.gravity = Math.max(towards, 0);
      if (towards < 0) i.load = towards * Beam.impact(i).mass; // away from the wall
    },
    "impact.acceleration": (i, v) => { const b = Beam.impact(i); i.load = (v - b.acceleration) * b.mass; },
    "wall.curvature": (i, v) => { i.wall_curvature = v; },
    "wall.stiffness": (i, v) => { i.wall_stiffness = v; },
    "wall.damping_ratio": (i, v) => { i.wall_damping_ratio = v; },
  };

  /** What to do with keys that this page does not have; of all others see `lacking`. */
  const INSTEAD = [
    [/^beam\.(damping$|loss_|hysteretic)/, "give beam.damping_ratio instead, or take bentbeam bounce"],
    [/^impact\.(amplitude|frequency|angular_)/, "give impact.velocity instead"],
    [/^beam\.(bending_stiffness|mass_per_length|section_height)$/, 'give a [section] of kind "general" instead'],
  ];
  const OF_SHEAR = /^beam\.(bending_stiffness|mass_per_length|section_height|shear_stiffness|rotary_inertia)$/;
  const COMMANDS = "bentbeam predict or bentbeam bounce";
  function instead(name, sheared) {
    if (sheared && OF_SHEAR.test(name)) return `this page knows shear only for a section with a shape: take ${COMMANDS}`;
    return INSTEAD.find(([which]) => which.test(name))?.[1] ?? "";
  }
  /** Sentences on these keys, of one advice together; null if there are none. */
  function lacking(names, sheared) {
    const advised = new Map();
    for (const name of names) {
      const advice = instead(name, sheared);
      advised.set(advice, [...(advised.get(advice) || []), name]);
    }
    const said = ([advice, of]) => {
      const [are, them, they] = of.length > 1 ? ["are", "them", "they are"] : ["is", "it", "it is"];
      const end = advice ? `: ${advice}` : ` (bentbeam simulate takes ${them} if ${they} spelled right)`;
      return `${of.join(", ")} ${are} not on this page${end}`;
    };
    return [...advised].map(said).join("; ") || null;
  }

  const NEEDED = ["section.youngs_modulus", "section.density", "beam.length"];
  const ONE_OF = [["beam.sagitta", "beam.curvature", "beam.dogleg"], ["impact.velocity", "impact.drop_height"]];
  const NOT_BOTH = [["impact.gravity", "impact.acceleration"]];
  const ONLY_WITH = [["beam.sagitta_length", "beam.sagitta"], ["wall.damping_ratio", "wall.stiffness"],
    ["section.fluid_density", "section.outer_diameter"]];
  const BORE = ["section.inner_diameter", "section.wall_thickness"];

  /** Why values by table.key are no case, as `bentbeam` would say; null if they are one. The page makes nothing up. */
  function incomplete(values) {
    const given = (name) => name in values, kind = values["section.kind"], of = (name) => `section.${name}`;
    if (!given("section.kind")) return "section.kind is missing";
    const shape = SHAPES[one("section.kind", kind, Object.keys(SHAPES))].map(of).filter((name) => !BORE.includes(name));
    const missing = [...shape, ...NEEDED].find((name) => !given(name));
    const foreign = [...Object.values(SHAPES).flat().map(of), ...BORE].find((name) => (
      given(name) && !shape.includes(name) && !(kind === "pipe" && BORE.includes(name))));
    const ways = kind === "pipe" ? [...ONE_OF, BORE] : ONE_OF;
    const open = ways.find((way) => way.filter(given).length !== 1);
    const twice = NOT_BOTH.find((way) => way.every(given));
    const alone = ONLY_WITH.find(([name, other]) => given(name) && !given(other));
    if (kind === "general" && values["beam.model"] === "timoshenko")
      return `beam.model = timoshenko needs a section with a shape, or beam.shear_stiffness for ${COMMANDS}`;
    if (missing) return `${missing} is missing`;
    if (foreign) return `${foreign} is none of a ${kind}`;
    if (open) return `give one of ${open.join(", ")}`;
    if (twice) return `${twice.join(" and ")} say the same: give one of them`;
    return alone ? `${alone[0]} has no effect without ${alone[1]}` : null;
  }

  /** Inputs of a case file. Throws Error that names the key which this page does not have. */
  function read(text) {
    const given = tables(text), found = { ...Beam.START, gravity: null, yield_stress: null, damping_ratio: null };
    const values = Object.fromEntries(Object.entries(given).flatMap(([table, keys]) => (
      Object.entries(keys).map(([key, value]) => [`${table}.${key}`, value]))));
    const known = (name) => KEYS[name] || name === ".title" || name.startsWith("run.");
    const others = Object.keys(values).filter((name) => !known(name));
    const reason = lacking(others, "beam.shear_stiffness" in values) ?? incomplete(values);
    if (reason) throw new Error(reason);
    for (const name of Object.keys(KEYS)) if (name in values) KEYS[name](found, values[name]); // in this order
    return found;
  }

  return { toml, read };
})();
