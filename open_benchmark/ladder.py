"""This project's integrators on the ladder's lower rungs: observed orders, and energy after ten impacts.

Ball, bar and string as :class:`hermite_fe.system.System`, the stopped beam as a run of the Hermite path; each against
its closed form in ``theory``. Errors are the mean of |J − J exact| over the record, over the largest J.

``python -m open_benchmark.ladder`` prints the table of docs/benchmark.md.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from hermite_fe import HermiteFE
from hermite_fe.contacts import NodeContact
from hermite_fe.integrators import (
    GeneralizedAlphaPenalty,
    Integrator,
    MoreauJean,
    NonsmoothGeneralizedAlpha,
    SignoriniPosition,
)
from hermite_fe.run import Trajectory, integrate
from hermite_fe.system import ContactRows, System
from open_benchmark.problem import LADDER, problem
from open_benchmark.references import reference

__all__ = ["INTEGRATORS", "RUNGS", "Rung", "ladder_table", "ladder_text", "observed_order"]

Array = NDArray[np.float64]

INTEGRATORS: dict[str, Callable[[float], Integrator]] = {
    "Moreau–Jean θ = 1": lambda h: MoreauJean(theta=1.0, time_step=h, growth=0.0),
    "Moreau–Jean θ = ½": lambda h: MoreauJean(theta=0.5, time_step=h, growth=0.0),
    "Signorini, new position": lambda h: SignoriniPosition(theta=1.0, time_step=h, growth=0.0),
    "nonsmooth generalised-α, ρ∞ = 0.8": lambda h: NonsmoothGeneralizedAlpha(
        spectral_radius=0.8, time_step=h, growth=0.0
    ),
    "generalised-α with penalty, ρ∞ = 0.8": lambda h: GeneralizedAlphaPenalty(
        spectral_radius=0.8, stiffness=0.1 / h**2, damping=0.3 / h, time_step=h, growth=0.0
    ),
}


@dataclass(frozen=True)
class Rung:
    """One integrator on one rung: error at each refinement (mean over step sizes that differ by a few per cent, since
    where in its step an impact falls is chance), observed order, energy at the end over that at the start (finest);
    ``reason`` when the integrator cannot take it."""

    errors: tuple[float, ...] = ()
    order: float | None = None
    energy: float | None = None
    reason: str = ""


def observed_order(refinements: Sequence[int], errors: Sequence[float]) -> float | None:
    """Slope of the errors over the refinement, both as logarithms; ``None`` when they are round-off."""
    if len(errors) < 2 or min(errors) < 1e-13:
        return None
    return float(-np.polyfit(np.log(refinements), np.log(errors), 1)[0])


def ball(make: Callable[[float], Integrator], refine: int) -> Trajectory:
    """A unit mass dropped from ½ with restitution 1: ten impacts by t = 20."""
    given = LADDER["ball"][1]
    one = np.ones((1, 1))
    system = System(
        mass=given["mass"] * one,
        stiffness=0.0 * one,
        load=-given["mass"] * given["gravity"] * one,
        contacts=ContactRows(np.array([[0]]), one, np.zeros(1)),
    )
    # steps that do not divide the flights: an impact falls anywhere in its step
    step = 0.0137 / refine
    return integrate(
        system, np.array([given["height"]]), np.zeros(1), make(step), LADDER["ball"][2],
        restitution=given["restitution"], save=np.linspace(0.0, LADDER["ball"][2], 1001),
    )  # fmt: skip


def _line(cells: int, tangent: float, line: float, length: float) -> tuple[Array, Array]:
    """Mass (lumped) and stiffness of linear elements in a row, banded."""
    size = length / cells
    mass = np.full((1, cells + 1), line * size)
    mass[0, [0, -1]] /= 2.0
    stiffness = np.zeros((2, cells + 1))
    stiffness[0] = 2.0 * tangent / size
    stiffness[0, [0, -1]] /= 2.0
    stiffness[1, :-1] = -tangent / size
    return mass, stiffness


def bar(make: Callable[[float], Integrator], refine: int) -> Trajectory:
    """A bar flying at the wall, in contact for 2L/c, off again at the speed it came with."""
    given, end = LADDER["bar"][1], LADDER["bar"][2]
    cells = 50 * refine
    mass, stiffness = _line(cells, given["axial_stiffness"], given["mass_per_length"], given["length"])
    system = System(
        mass=mass,
        stiffness=stiffness,
        contacts=ContactRows(np.array([[0]]), np.ones((1, 1)), np.array([given["gap"]])),
    )
    rest = np.zeros(cells + 1)
    step = 0.437 * given["length"] / cells
    return integrate(system, rest, rest - given["velocity"], make(step), end, save=np.linspace(0.0, end, 601))


def string(make: Callable[[float], Integrator], refine: int) -> Trajectory:
    """A string that lands all at once, elastically, four times."""
    given, end = LADDER["string"][1], LADDER["string"][2]
    cells = 50 * refine
    mass, stiffness = _line(cells, given["tension"], given["mass_per_length"], given["length"])
    x = np.linspace(0.0, 1.0, cells + 1)
    inner = np.arange(1, cells)
    system = System(
        mass=mass,
        stiffness=stiffness,
        contacts=ContactRows(inner[:, None], np.ones((cells - 1, 1)), np.zeros(cells - 1)),
        supports=(0, cells),
    )
    start = 4.0 * given["height"] * x * (1.0 - x)
    step = 0.437 / cells
    return integrate(
        system, start, 0.0 * x, make(step), end, restitution=1.0, save=np.linspace(0.0, end, 801)
    )  # fmt: skip


def _impulse_error(name: str, run: Trajectory) -> float:
    exact = reference(problem(name)).impulse
    assert exact is not None
    expected = exact(run.time)
    found = run.impulse.sum(axis=1)
    return float(np.mean(np.abs(found - expected)) / np.abs(expected).max())


def _on_system(name: str, build: Callable[[Callable[[float], Integrator], int], Trajectory]) -> Any:
    def measured(make: Callable[[float], Integrator], refine: int) -> tuple[float, float]:
        run = build(make, refine)
        if run.failure:
            raise ValueError(run.failure)
        energy = run.kinetic + run.strain - run.work
        if name == "ball":  # the weight's work is counted from the start: the floor is the ball's zero
            energy = energy + LADDER["ball"][1]["gravity"] * LADDER["ball"][1]["height"]
        return _impulse_error(name, run), float(energy[-1] / energy[0])

    return measured


def _stopped_beam(make: Callable[[float], Integrator], refine: int) -> tuple[float, float]:
    """The free beam of κ/ν = 2 with its own damping, until before the wall first lets go."""
    asked = problem("stopped-beam")
    impact = Impact(
        bending_stiffness=1.0, mass_per_length=1.0, length=2.0, curvature=asked.kappa_over_nu, velocity=1.0,
        damping=asked.damping,
    )  # fmt: skip
    cells = 25 * refine
    method = HermiteFE(
        mesh=UniformMesh(element_length=1.0 / cells),
        integrator=make(0.25 / 25.0**2 / refine),
        contact=NodeContact(hold=0, hold_until=0.0),
    )
    history = method.simulate(impact, end_time=asked.end_time, save=np.linspace(0.0, asked.end_time, 101))
    exact = reference(asked).impulse
    assert exact is not None
    expected = exact(history.time)
    found = history.array("total_impulse")
    energy = history.array("kinetic_energy") + history.array("strain_energy")
    return float(np.mean(np.abs(found - expected)) / expected.max()), float(energy[-1] / energy[0])


RUNGS: dict[str, Callable[[Callable[[float], Integrator], int], tuple[float, float]]] = {
    "ball": _on_system("ball", ball),
    "bar": _on_system("bar", bar),
    "string": _on_system("string", string),
    "stopped-beam": _stopped_beam,
}


PHASES = (1.0, 0.93, 0.87, 0.81)


def ladder_table(
    refinements: Sequence[int] = (1, 2, 4, 8), integrators: Sequence[str] = tuple(INTEGRATORS)
) -> dict[str, dict[str, Rung]]:
    """Integrator → rung → what was measured."""
    return {name: {rung: _rung(INTEGRATORS[name], rung, refinements) for rung in RUNGS} for name in integrators}


def _rung(make: Callable[[float], Integrator], rung: str, refinements: Sequence[int]) -> Rung:
    errors, energy = [], 0.0
    try:
        for refine in refinements:
            found = [RUNGS[rung](_shifted(make, phase), refine) for phase in PHASES]
            errors.append(float(np.mean([error for error, _ in found])))
            energy = float(np.mean([kept for _, kept in found]))
    except ValueError as error:
        return Rung(reason=" ".join(str(error).split()))
    return Rung(tuple(errors), observed_order(refinements, errors), energy)


def _shifted(make: Callable[[float], Integrator], phase: float) -> Callable[[float], Integrator]:
    return lambda step: make(phase * step)


def ladder_text(table: dict[str, dict[str, Rung]]) -> str:
    """The table in Markdown: error at the coarsest and the finest mesh, observed order, energy left."""
    lines = [f"| integrator | {' | '.join(RUNGS)} |", "| --- " * (1 + len(RUNGS)) + "|"]
    lines += [f"| {name} | {' | '.join(_cell(rungs[rung]) for rung in RUNGS)} |" for name, rungs in table.items()]
    return "\n".join(lines)


def _cell(rung: Rung) -> str:
    if rung.reason:
        return rung.reason
    order = "round-off" if rung.order is None else f"{rung.order:.2f}"
    return f"{rung.errors[0]:.1e} … {rung.errors[-1]:.1e}, {order}, {rung.energy:.4f}"


if __name__ == "__main__":
    print(ladder_text(ladder_table()))
