"""What a perfect code hands in to the open benchmark, the theory's own J and Jm; and scores of such fields."""

import numpy as np

from bent_beam_programs.open_benchmark.result import result_from_fields
from bent_beam_programs.open_benchmark.score import score
from theory import contact_parameters

SIDE = np.sqrt(2.0 / np.pi)
TAU = np.linspace(0.0, 0.1, 400)


def exact_fields(kappa=0.5):
    found = contact_parameters(kappa)
    name = f"{'leading' if kappa < 1.0 else 'point'}-{kappa:g}"
    fields = {"outcome": "completed", "problem": name, "metadata": '{"tool": "exact"}', "tau": TAU}
    return fields | {"J": 4.0 * SIDE * found.r0 * np.sqrt(TAU), "Jm": SIDE * found.r0 * found.lambda0 * TAU}


def written(folder, kappa=0.5, file="result.npz", **changes):
    """As a file, with other fields, or without those that are ``None``."""
    fields = exact_fields(kappa) | changes
    np.savez(folder / file, **{name: value for name, value in fields.items() if value is not None})
    return folder / file


def scored(problem, **fields):
    return score(result_from_fields({"outcome": "completed", "problem": problem, "metadata": "{}", **fields}))
