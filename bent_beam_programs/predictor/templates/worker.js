"use strict";
// In a worker of its own: {id, problems, quick} → for each run {id, index, run, numbers, whole}. A quick picture is of
// the first problem alone. First every problem's own run, then what its bars come from.
onmessage = ({ data: { id, problems, quick } }) => {
  const found = problems.map(() => ({}));
  const answer = (index, name, how) => {
    const p = problems[index];
    try {
      found[index][name] = Solver.simulate(p, how);
      const { frames, early, course, ...numbers } = found[index][name];
      if (name !== "base") found[index][name] = { ...numbers, course }; // its motion is not shown
      const whole = !quick && Object.keys(Answer.runs(p)).every((one) => found[index][one]);
      const run = name === "base" ? { frames, early, ...numbers } : null;
      postMessage({ id, index, run, numbers: Answer.numbers(p, found[index]), whole, quick });
    } catch (error) { postMessage({ id, index, quick, failed: error.message }); }
  };
  if (quick) { answer(0, "base", Answer.quick(problems[0])); return; }
  problems.forEach((p, index) => answer(index, "base", Answer.runs(p).base));
  problems.forEach((p, index) => {
    for (const [name, how] of Object.entries(Answer.runs(p)).slice(1)) answer(index, name, how);
  });
};
