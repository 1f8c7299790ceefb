"use strict";
// The page: inputs → runs in two workers, one for a first picture at once, one for numbers with bars → words and plots.
(() => {
  const { find, element, quantity, inputs } = Form, { text } = Draw, { number, holding, percent, warnings, COMMAND } = Words;
  const PATIENCE = 250; // ms without a change before bars are computed
  const source = new Blob([find("#simulation").textContent], { type: "text/javascript" });
  const hire = () => { const made = new Worker(URL.createObjectURL(source)); made.onmessage = ({ data }) => receive(data); return made; };
  const quick = hire();
  let full = hire(), asked = null, sketched = null, latest = 0, waiting = false, working = false, timer = 0;

  // asked: {id, b, theory, scales, problems, ratios, runs, numbers, whole, typed} of the inputs as they are; sketched: of
  // the quick picture that is being computed, which is shown even if somebody has dragged on
  function update() {
    const wrong = Form.complain();
    find("#answer").hidden = wrong;
    find("#cannot").hidden = !wrong;
    if (wrong) { find("#brief").textContent = find("#cannot").textContent; return; }
    const b = Beam.impact(inputs()), stated = b.damping !== null, ratios = stated ? [null] : Answer.RATIOS;
    const dampings = stated ? [b.damping] : ratios.map((ratio) => Beam.dampingTime(b, b.length, ratio));
    asked = { id: ++latest, b, theory: Instants.solve(b), scales: Beam.scales(b), ratios,
      problems: dampings.map((damping) => Beam.problem(b, damping)), runs: [], numbers: [], whole: [], typed: performance.now() };
    if (working) { full.terminate(); full = hire(); working = false; }
    clearTimeout(timer);
    timer = setTimeout(refine, PATIENCE);
    document.body.dataset.state = "asked";
    if (sketched) waiting = true; else sketch();
    say();
    history.replaceState(null, "", Form.toLink());
    find("#case").textContent = Case.toml(inputs(), b);
  }
  const post = (worker, of, picture) => worker.postMessage({ id: of.id, problems: of.problems, quick: picture });
  function sketch() { waiting = false; sketched = asked; post(quick, sketched, true); }
  function refine() { working = true; post(full, asked, false); }

  function receive({ id, index, run, numbers, whole, quick: picture, failed }) {
    const of = picture ? sketched : asked;
    if (picture) { sketched = null; if (waiting) sketch(); }
    if (id !== of.id) return;
    if (failed) { find("#warnings").replaceChildren(element("p", {}, `${failed}: ${COMMAND} may find a way.`)); return; }
    if (picture && of.runs.length) return; // the better run is there
    if (run) of.runs[index] = run;
    of.numbers[index] = numbers;
    of.whole[index] = Boolean(whole);
    working = !picture && of.problems.some((_, i) => !of.whole[i]);
    if (run) { show(of); plot(of); }
    tell(of);
    Object.assign(document.body.dataset, { state: picture ? "first" : working ? "working" : "done", of: of.id });
    if (picture) document.body.dataset.first = Math.round(performance.now() - of.typed); // ms
  }

  /** What the theory says, at once. */
  function say() {
    const { theory, b } = asked, { contact, limits } = theory;
    const words = {
      verdict: WORDS.regimes[contact.regime], holds: holding(limits), model: WORDS.beams[b.shear ? "timoshenko" : "euler_bernoulli"],
      theory: limits.until && !b.damping ? `Largest stress until then: ${quantity("stress", theory.stress)}.` : "",
      groups: [
        `κ/ν = ${text(contact.ratio, 5)}`, `λ₀ = ${text(contact.lambda0, 6)}`, `r₀ = ${text(contact.r0, 6)}`,
        `EI = ${text(b.stiffness, 5)} N m²`, `μ = ${text(b.mass, 5)} kg/m`, b.shear ? `κₛGA = ${text(b.shear, 5)} N` : "no shear",
        `K = ${text(b.curvature, 5)} 1/m`, `V₀ = ${text(b.velocity, 5)} m/s`,
      ].join(" · "),
    };
    for (const [id, value] of Object.entries(words)) find(`#${id}`).textContent = value;
    find("#holds").classList.toggle("alarm", !limits.until);
  }

  /** The damping whose stress is largest: the headline. */
  const worst = ({ numbers }) => numbers.reduce((best, one, i) => (one.moment.value > numbers[best].moment.value ? i : best), 0);

  /** Numbers with their bars, as far as they are there. */
  function tell(of) {
    const { b, scales, numbers, ratios, problems, runs } = of, i = worst(of), found = numbers[i], run = runs[i];
    const axial = Math.abs(b.tension) / b.area, stress = (one) => number("stress", one.moment, scales.moment / b.modulus, axial);
    const beyond = b.yieldStress && found.moment.value * scales.moment / b.modulus + axial > b.yieldStress;
    find("#stress").textContent = stress(found);
    find("#where").textContent = `at ${quantity("time", run.time * scales.time, 3)}, ${quantity("place", run.place * scales.length, 3)} from the middle;`
      + ` largest of 0 to ${quantity("time", run.until * scales.time, 3)}`;
    find("#yields").textContent = beyond ? `The material yields at ${quantity("stress", b.yieldStress)}: all numbers are those of an elastic beam.` : "";
    find("#brief").textContent = `Largest stress ${stress(found)} ↓`;
    find("#dampings").textContent = ratios[0] === null ? ""
      : `No damping is stated: ${numbers.map((one, k) => `${stress(one)} at ${percent(ratios[k])}`).join(", ")}. The numbers are those of ${percent(ratios[i])}.`;
    const rows = [
      ["Coefficient of restitution", number("", found.restitution)],
      ["Last contact", number("time", found.lastContact, scales.time)],
      ["Impulse", number("impulse", found.impulse, scales.impulse)],
      ["Largest bending moment", number("moment", found.moment, scales.moment)],
      ["Largest force on the wall", b.wallStiffness ? number("force", found.force, scales.force) : "none: a rigid wall pushes by impulses"],
    ];
    find("#values").replaceChildren(...rows.map(([name, value]) => element("div", {}, element("dt", {}, name), element("dd", {}, value))));
    const said = warnings(b, found, problems[i], of.whole[i]);
    find("#warnings").replaceChildren(...said.map((sentence) => element("p", {}, sentence)));
  }

  const kinds = ["little", "some", "much"];
  function plot({ runs, b, scales, theory, ratios }) {
    const shown = runs.map((run, i) => ({ run, kind: ratios[0] === null ? "" : kinds[i] })).filter(({ run }) => run);
    Plots.stress(shown, b, scales);
    Plots.force(shown, scales);
    Plots.places(shown[0], scales);
    Plots.first(shown, theory, scales);
    find("#legend").hidden = shown.length < 2;
  }
  function show({ b, scales, problems, runs }) {
    const i = runs.findIndex((run) => run);
    Motion.show(runs[i], problems[i], scales, (moment) => Beam.stress(b, moment * scales.moment));
  }

  function save() {
    const link = element("a", { href: URL.createObjectURL(new Blob([find("#case").textContent], { type: "application/toml" })), download: "impact.toml" });
    link.click();
    URL.revokeObjectURL(link.href);
  }
  async function open() {
    const [file] = find("#open").files, note = find("#note");
    if (!file) return;
    try {
      Form.set({ ...Case.read(await file.text()), units: inputs().units });
      note.textContent = `${file.name} is read.`;
      update();
    } catch (error) { note.textContent = `${file.name}: ${error.message}`; }
    find("#open").value = "";
  }
  async function copyLink() {
    try {
      await navigator.clipboard.writeText(location.href);
      find("#note").textContent = "Copied.";
    } catch { find("#note").textContent = "The address bar holds the link."; }
  }

  Form.start(update);
  Motion.start();
  update();
  find("#brief").addEventListener("click", () => find("#result").scrollIntoView());
  find("#save").addEventListener("click", save);
  find("#open").addEventListener("change", open);
  find("#copy").addEventListener("click", copyLink);
  find("#reset").addEventListener("click", () => { Form.set({ ...Beam.START }); update(); });
  addEventListener("hashchange", () => { Form.fromLink(); update(); });
  addEventListener("resize", () => { if (!find("#answer").hidden && asked.runs.some((run) => run)) { show(asked); plot(asked); } });
})();
