"use strict";
// Sentences of the page. What `bentbeam predict` says of the contact and the theory, it says by the same words: WORDS.
const Words = (() => {
  const { quantity } = Form, { text, bar } = Draw;
  const COMMAND = "bentbeam bounce impact.toml";
  const WIDE = 0.1; // a bar over its number from which it is wide

  /** A number with its bar, in the unit that suits. `shift` is added: the stress of an axial force. */
  function number(name, { value, bar: error, runs }, size = 1, shift = 0) {
    if (value === null) return "–";
    const [symbol, unit] = name ? Form.unit(name, value * size + shift) : ["", 1], here = (value * size + shift) / unit;
    const written = error === null ? `${text(here, 3)} …` : bar(here, error * size / unit);
    const many = written.includes("±") && symbol ? `${written} ${symbol}` : `${written} ${symbol}`.trim();
    return runs ? `${many} (band of ${runs} runs)` : many;
  }

  /** When the first instants hold. */
  function holding({ from, until, by, after }) {
    if (!until) return `The theory covers no time: ${WORDS.limits[by]}.`;
    const start = after ? `from ${quantity("time", from, 3)} (before, ${WORDS.before[after]}) ` : "";
    return `The theory holds to 2 % ${start}until ${quantity("time", until, 3)}: then ${WORDS.limits[by]}.`;
  }

  const percent = (ratio) => `${text(100 * ratio, 2)} %`;

  /** What a reader must know of the numbers. */
  function warnings(b, { restitution, moment }, problem, whole) {
    const wide = [[restitution, 0.3], [moment, 0]].some(([{ value, bar: error }, least]) => error > WIDE * Math.max(Math.abs(value), least));
    return [
      problem.eta ? "" : `Without damping the outcome is irregular and does not converge: a band is given. ${COMMAND} has a larger one.`,
      whole && problem.eta && wide ? `The bars are wide: elements, steps and contact law decide here. ${COMMAND} --set hermite.refine=2 takes finer ones.` : "",
      b.shear ? "" : "Short waves run faster without shear; this page takes few elements for it, and its bars count what that changes.",
      whole && restitution.value === null ? "The loads keep the beam on the wall: it has not left for good, so no restitution is given." : "",
      restitution.value !== null && problem.load + problem.pull > 0 ? "The loads bring the beam back to the wall; these numbers are those of the first hit." : "",
      (b.curvature - b.wallCurvature) * b.length / 2 >= 0.3 ? "The bow is steep: theory and simulation are for small slopes." : "",
    ].filter(Boolean);
  }

  return { COMMAND, number, holding, percent, warnings };
})();
