"""Integrators and small systems that tests of the Hermite path share."""

import ast
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from fences import blocks
from here import ROOT

from hermite_fe.integrators import INTEGRATORS, Integrator
from hermite_fe.integrators.nonsmooth_generalized_alpha import LEVELS
from hermite_fe.system import ContactRows, System

GRAVITY, DROP = 9.81, 0.5  # thesis Fig. 3.6
Make = Callable[..., Integrator]
WITH_IMPACT_LAW: dict[str, Make] = {"moreau_jean": partial(INTEGRATORS["moreau_jean"], theta=0.5)}
WITH_IMPACT_LAW |= {level: partial(INTEGRATORS["nonsmooth_generalized_alpha"], levels=level) for level in LEVELS}
ALL: dict[str, Make] = WITH_IMPACT_LAW | {
    "moreau_jean_implicit": INTEGRATORS["moreau_jean"],
    "signorini_position": INTEGRATORS["signorini_position"],
    "penalty": partial(INTEGRATORS["generalized_alpha_penalty"], stiffness=1e5, damping=1e3),
}
FIRST_ORDER = ("moreau_jean_implicit", "signorini_position")


def ball() -> System:
    return System(mass=[[1.0]], stiffness=[[0.0]], load=[[-GRAVITY]], contacts=ContactRows([[0]], [[1.0]], [0.0]))


def chain(gap: float, load: list[list[float]]) -> System:
    """Two damped, forced masses and a stop."""
    stiffness, damped, stop = [[3.0, 2.0], [-1.0, 0.0]], [[0.1, 0.2]], ContactRows([[0]], [[1.0]], [gap])
    return System([[1.0, 2.0]], stiffness, dampings=(("viscous", damped),), load=load, contacts=stop)


def defined_in(page: str) -> dict[str, Any]:
    """What a page of the docs imports and defines, without what it runs."""
    space: dict[str, Any] = {"__name__": "docs"}
    for block in blocks(ROOT / "docs" / page):
        tree = ast.parse(block.body if block.language == "python" else "")
        tree.body = [part for part in tree.body if isinstance(part, ast.Import | ast.ImportFrom | ast.ClassDef)]
        exec(compile(tree, page, "exec", dont_inherit=True), space)
    return space


def account(sums: dict[str, Any]) -> Any:
    """What is held and lost less the work of the loads: the energy at the start, in every step."""
    losses = sum(value for name, value in sums.items() if name.startswith("loss_"))
    held = sums["kinetic_energy"] + sums["strain_energy"] + sums.get("contact_energy", 0.0)
    return held - sums["work_of_loads"] + losses


def dense(bands: np.ndarray) -> np.ndarray:
    """The symmetric matrix of lower bands."""
    n = bands.shape[1]
    lower = sum(np.diag(bands[m, : n - m], -m) for m in range(min(4, n)))
    return np.asarray(lower + np.tril(lower, -1).T)
