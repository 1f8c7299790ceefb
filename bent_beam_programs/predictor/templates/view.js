"use strict";
// The page: inputs → runs in two workers, one for a first picture at once, one for numbers with bars → words and plots.
(() => {
  const { find, element, quantity, inputs } = Form, { text } = Draw;
  const { COMMAND, number, verdict, holding, atEnd, percent, warnings } = Words;
  const PATIENCE = 250; // ms without a change before bars are computed
  const source = URL.createObjectURL(new Blob([find("#simulation").textContent], { type: "text/javascript" }));
  function hire() {
    const worker = new Worker(source);
    worker.onmessage = ({ data }) => receive(data);
    return worker;
  }
  const quick = hire();
  let full = hire(), asked = null, sketched = null, latest = 0, waiting = false, working = false, timer = 0;

  // asked: {id, typed, b, theory, scales, ratios, problems, runs, numbers, whole} of the inputs as they are; sketched:
  // of the quick picture that is being computed, which is shown even if somebody has dragged on
  function update() {
    refuse("");
    const wrong = Form.complain();
    find("#answer").hidden = wrong;
    find("#cannot").hidden = !wrong;
    if (wrong) {
      find("#brief").textContent = find("#cannot").textContent;
      return;
    }
    const b = Beam.impact(inputs()), ratios = b.damping === null ? Answer.RATIOS : [null];
    const damping = (ratio) => (ratio === null ? b.damping : Beam.dampingTime(b, b.length, ratio));
    asked = {
      id: ++latest, typed: performance.now(), b, theory: Instants.solve(b), scales: Beam.scales(b), ratios,
      problems: ratios.map((ratio) => Beam.problem(b, damping(ratio))), runs: [], numbers: [], whole: [],
    };
    if (working) {
      full.terminate();
      full = hire();
      working = false;
    }
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
    const of = picture ? sketched : asked, state = document.body.dataset;
    if (picture) {
      sketched = null;
      if (waiting) sketch();
    }
    if (id !== of.id || (picture && of.runs.length)) return; // of other inputs; or the better run is there
    if (failed) {
      find("#warnings").replaceChildren(element("p", {}, `${failed}: ${COMMAND} may find a way.`));
      return;
    }
    if (run) of.runs[index] = run;
    of.numbers[index] = numbers;
    of.whole[index] = Boolean(whole);
    if (!picture) working = of.problems.some((_, i) => !of.whole[i]);
    if (run) show(of);
    plot(of);
    tell(of);
    Object.assign(state, { of: of.id, state: picture ? "first" : working ? "working" : "done" });
    if (picture) state.first = Math.round(performance.now() - of.typed); // ms
  }

  /** What the theory says, at once. */
  function say() {
    const { theory, b } = asked, { contact, limits } = theory;
    const groups = {
      "κ/ν": text(contact.ratio, 5), "λ₀": text(contact.lambda0, 6), "r₀": text(contact.r0, 6),
      EI: `${text(b.stiffness, 5)} N m²`, "μ": `${text(b.mass, 5)} kg/m`,
      ...(b.shear ? { "κₛGA": `${text(b.shear, 5)} N` } : {}),
      K: `${text(b.curvature, 5)} 1/m`, "V₀": `${text(b.velocity, 5)} m/s`,
    };
    const words = {
      verdict: verdict(b, contact),
      holds: holding(limits, b, contact),
      theory: limits.until ? atEnd(theory) : "",
      groups: Object.entries(groups).map(([name, value]) => `${name} = ${value}`).join(" · "),
      model: WORDS.beams[b.shear ? "timoshenko" : "euler_bernoulli"],
    };
    for (const [id, value] of Object.entries(words)) find(`#${id}`).textContent = value;
  }

  /** The damping whose stress is largest: the headline. */
  const worst = ({ numbers }) => numbers.reduce(
    (best, { moment }, i) => (best < 0 || moment.value > numbers[best].moment.value ? i : best), -1);

  /** Numbers with their bars, as far as they are there. */
  function tell(of) {
    const { b, scales, numbers, ratios } = of, i = worst(of), found = numbers[i], run = of.runs[i];
    const stress = (one) => number("stress", one.moment, scales.moment / b.modulus, Beam.stress(b, 0));
    const at = `at ${quantity("time", run.time * scales.time, 3)}, `
      + `${run.place ? quantity("place", run.place * scales.length, 3) + " from" : "in"} the middle; `
      + `largest of 0 to ${quantity("time", run.until * scales.time, 3)}`;
    const over = numbers.map((one, k) => `${stress(one)} at ${percent(ratios[k])}`).filter(Boolean).join(", ");
    const beyond = b.yieldStress && Beam.stress(b, found.moment.value * scales.moment) > b.yieldStress;
    const words = {
      stress: stress(found),
      where: found.moment.value === null ? "" : at,
      brief: `Largest stress ${stress(found)} ↓`,
      dampings: ratios[0] === null ? ""
        : `No damping is stated: ${over}. The numbers are those of ${percent(ratios[i])}.`,
      yields: beyond
        ? `The material yields at ${quantity("stress", b.yieldStress)}: all numbers are those of an elastic beam.` : "",
    };
    for (const [id, value] of Object.entries(words)) find(`#${id}`).textContent = value;
    const force = b.wallStiffness ? number("force", found.force, scales.force)
      : "none: a rigid wall pushes by impulses";
    const rows = {
      "Coefficient of restitution": number("", found.restitution),
      "Last contact": number("time", found.lastContact, scales.time),
      Impulse: number("impulse", found.impulse, scales.impulse),
      "Largest bending moment": number("moment", found.moment, scales.moment),
      "Largest force on the wall": force,
    };
    const item = ([name, value]) => element("div", {}, element("dt", {}, name), element("dd", {}, value));
    find("#values").replaceChildren(...Object.entries(rows).map(item));
    const said = warnings(b, found, of.problems[i], of.whole[i]);
    find("#warnings").replaceChildren(...said.map((sentence) => element("p", {}, sentence)));
  }

  function plot({ runs, numbers, b, scales, theory, ratios }) {
    const kinds = ratios[0] === null ? [""] : ["little", "some", "much"];
    const shown = runs.map((run, i) => ({ run, kind: kinds[i], bar: numbers[i].moment.bar })).filter(({ run }) => run);
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
    if (!asked) { // the page was opened by a link with a mistake
      find("#note").textContent = "There is no case yet.";
      return;
    }
    const file = new Blob([find("#case").textContent], { type: "application/toml" });
    const link = element("a", { href: URL.createObjectURL(file), download: "impact.toml" });
    link.click();
    URL.revokeObjectURL(link.href);
  }
  /** Says at the top why a file was refused: the numbers beside it are not its own. */
  function refuse(reason) {
    find("#refused").textContent = reason;
    find("#refused").hidden = !reason;
    if (reason) find("#refused").scrollIntoView({ block: "center" }); // the button is at the bottom
  }
  async function open() {
    const [file] = find("#open").files, note = find("#note");
    if (!file) return;
    let read = null;
    try { // reading only: a mistake after Form.set would leave a changed form
      read = Case.read(await file.text());
    } catch (error) {
      note.textContent = "";
      refuse(`${file.name} is not read: the form and its numbers are unchanged. ${error.message}.`);
    }
    find("#open").value = "";
    if (!read) return;
    Form.set({ ...read, units: inputs().units });
    note.textContent = `${file.name} is read.`;
    update();
  }
  async function copyLink() {
    try {
      await navigator.clipboard.writeText(location.href);
      find("#note").textContent = "Copied.";
    } catch {
      find("#note").textContent = "The address bar holds the link.";
    }
  }
  const restart = (inputs) => { Form.set(inputs); update(); };

  Form.start(update);
  Motion.start();
  update();
  find("#brief").addEventListener("click", () => find("#stress").scrollIntoView());
  find("#save").addEventListener("click", save);
  find("#open").addEventListener("change", open);
  find("#copy").addEventListener("click", copyLink);
  find("#reset").addEventListener("click", () => restart({ ...Beam.START }));
  addEventListener("hashchange", () => restart(Form.fromLink()));
  addEventListener("resize", () => {
    if (find("#answer").hidden || !asked.runs.some((run) => run)) return;
    show(asked);
    plot(asked);
  });
})();
