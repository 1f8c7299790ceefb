"""The two files that are shipped: ``problems.json`` and ``references.json``.

    python -m bent_beam_programs.open_benchmark.release

writes both. A change of their keys needs a new version of the schema (docs/guide/submit.md).
"""

import json

from bent_beam.files import write_atomically
from bent_beam.stored import write
from bent_beam_programs.open_benchmark.exact import computed
from bent_beam_programs.open_benchmark.problem import LADDER, PROBLEMS, document, problem
from bent_beam_programs.open_benchmark.problem import SCHEMA as PROBLEM_SCHEMA
from bent_beam_programs.open_benchmark.references import REFERENCES, SCHEMA

SHIPPED = (
    *(f"leading-{kappa:g}" for kappa in (0.1, 0.25, 0.5, 0.8)),
    *(f"first-0.5-{loads}" for loads in ("-0.5-0-0-1", "-1--1-0", "1-1-1", "4-0-0")),
    *("point-2", *LADDER, "stopped-beam", "bounce-0.5-1e-3", "bounce-2-1e-3"),
    *("elastic-wall-0.5-0", "elastic-wall-0.1-0.5", "elastic-stop-18000", "elastic-stop-45000"),
)

PACKAGES = ("theory", "bent_beam_programs.open_benchmark.exact")


def _main() -> None:
    shipped = {name: document(problem(name)) for name in SHIPPED}
    lines = ",\n".join(f"  {json.dumps(name)}: {json.dumps(one)}" for name, one in shipped.items())
    write_atomically(PROBLEMS, f'{{"schema": {json.dumps(PROBLEM_SCHEMA)}, "problems": {{\n{lines}\n}}}}\n')
    known = {name: computed(problem(name)) for name in SHIPPED if problem(name).kind != "bounce"}
    what = "exact values, and J(t) as polynomials of (variable - break), the highest power first"
    made_by, schema = "python -m bent_beam_programs.open_benchmark.release", {"schema": SCHEMA}
    write(REFERENCES, what, made_by, PACKAGES, schema, schema | {"problems": known})


if __name__ == "__main__":
    _main()
