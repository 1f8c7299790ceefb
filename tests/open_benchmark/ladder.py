"""This project's integrators on the ladder's lower rungs: observed orders, and energy after ten impacts.

Ball, bar and string as :class:`hermite_fe.system.System`, the stopped beam as a run of the Hermite path; each against
its closed form in ``theory``. Errors are the mean of |J − J exact| over the record, over the largest J.

``python tests/open_benchmark/ladder.py`` prints the table of docs/benchmark.md.
"""

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from bent_beam import Impact
from bent_beam.measure.numbers import Number
from bent_beam.meshes import UniformMesh
from bent_beam_programs.open_benchmark.problem import LADDER, problem
from bent_beam_programs.open_benchmark.references import reference
from hermite_fe import HermiteFE
from hermite_fe.constraints import ContactLaw
from hermite_fe.contacts import NodeContact
from hermite_fe.integrators import INTEGRATORS as KINDS
from hermite_fe.integrators import Integrator
from hermite_fe.run import integrate
from hermite_fe.system import ContactRows, System

Array = NDArray[np.float64]
Scheme = Callable[[float], Integrator]  # of a time step
Found = tuple[float, float]  # error of the impulse, energy at the end over that at the start

INTEGRATORS: dict[str, Scheme] = {
    "Moreau–Jean θ = 1": partial(KINDS["moreau_jean"], growth=0.0, theta=1.0),
    "Moreau–Jean θ = ½": partial(KINDS["moreau_jean"], growth=0.0, theta=0.5),
    "Signorini, new position": partial(KINDS["signorini_position"], growth=0.0, theta=1.0),
    "nonsmooth generalised-α, ρ∞ = 0.8": partial(KINDS["nonsmooth_generalized_alpha"], growth=0.0, spectral_radius=0.8),
    "generalised-α with penalty, ρ∞ = 0.8": lambda h: KINDS["generalized_alpha_penalty"](
        h, 0.0, spectral_radius=0.8, stiffness=0.1 / h**2, damping=0.3 / h
    ),
    "massless boundary": partial(KINDS["massless_boundary"], growth=0.0),
}
COURANT = 0.437  # of their steps
# Where in its step an impact falls is chance: errors are means over step sizes that differ by a few per cent.
PHASES = (1.0, 0.93, 0.87, 0.81)


def _judged(name: str, time: Array, impulse: Array, energy: Array) -> Found:
    expected = reference(problem(name)).impulse(time)
    return float(np.mean(np.abs(impulse - expected)) / np.abs(expected).max()), float(energy[-1] / energy[0])


def _run(name: str, integrator: Integrator, system: System, start: Array, velocity: Array, instants: int) -> Found:
    """A rung with its restitution, saved at so many instants."""
    _, given, end = LADDER[name]
    law, save = ContactLaw(given.get("restitution", 0.0)), np.linspace(0.0, end, instants)
    run = integrate(system, start, velocity, integrator, end, law=law, save=save)
    if run.failure:
        raise ValueError(run.failure)
    energy = run.sums["kinetic_energy"] + run.sums["strain_energy"] - run.sums["work_of_loads"]
    held = given["mass"] * given["gravity"] * given["height"] if name == "ball" else 0.0  # at the start, beside these
    return _judged(name, run.time, run.impulse.sum(axis=1), energy + held)


def _ball(scheme: Scheme, refine: int) -> Found:
    """A unit mass dropped from ½ under unit gravity with restitution 1: ten impacts by t = 20."""
    system = System(mass=[[1.0]], stiffness=[[0.0]], load=[[-1.0]], contacts=ContactRows([[0]], [[1.0]], [0.0]))
    start, step = np.array([LADDER["ball"].given["height"]]), 0.0137 / refine  # steps that do not divide the flights
    return _run("ball", scheme(step), system, start, np.zeros(1), 1001)


def _line(refine: int) -> tuple[Array, Array, Array]:
    """Places, lumped mass and stiffness of linear elements of unit stiffness and mass in a row of length 1, banded."""
    cells = 50 * refine
    mass, stiffness = np.full((1, cells + 1), 1.0 / cells), np.full((2, cells + 1), -float(cells))
    stiffness[0] *= -2.0
    stiffness[1, -1] = 0.0
    mass[0, [0, -1]] /= 2.0
    stiffness[0, [0, -1]] /= 2.0
    return np.linspace(0.0, 1.0, cells + 1), mass, stiffness


def _bar(scheme: Scheme, refine: int) -> Found:
    """A bar that flies at the wall, in contact for 2L/c, off again as it came."""
    given, (x, mass, stiffness) = LADDER["bar"].given, _line(refine)
    system = System(mass=mass, stiffness=stiffness, contacts=ContactRows([[0]], [[1.0]], [given["gap"]]))
    return _run("bar", scheme(COURANT * x[1]), system, 0.0 * x, 0.0 * x - given["velocity"], 601)


def _string(scheme: Scheme, refine: int) -> Found:
    """A string that lands all at once, elastically, four times."""
    x, mass, stiffness = _line(refine)
    inner = np.arange(1, x.size - 1)[:, None]
    contacts = ContactRows(inner, np.ones(inner.shape), np.zeros(inner.size))
    system = System(mass=mass, stiffness=stiffness, contacts=contacts, supports=(0, x.size - 1))
    start = 4.0 * LADDER["string"].given["height"] * x * (1.0 - x)
    return _run("string", scheme(COURANT * x[1]), system, start, 0.0 * x, 801)


def _stopped_beam(scheme: Scheme, refine: int) -> Found:
    """The free beam of κ/ν = 2 with its own damping, until before the wall first lets go."""
    asked = problem("stopped-beam")
    impact = Impact.dimensionless(asked.kappa_over_nu, damping=asked.damping, length=2.0)
    mesh, contact = UniformMesh(element_length=1.0 / (25 * refine)), NodeContact(hold=0, hold_until=0.0)
    method = HermiteFE(mesh=mesh, integrator=scheme(0.25 / 25.0**2 / refine), contact=contact)
    history = method.simulate(impact, end_time=asked.end_time, save=np.linspace(0.0, asked.end_time, 101))
    energy = history.array("kinetic_energy") + history.array("strain_energy")
    return _judged(asked.id, history.time, history.array("total_impulse"), energy)


RUNGS = {"ball": _ball, "bar": _bar, "string": _string, "stopped-beam": _stopped_beam}


def cell(scheme: Scheme, rung: str, refinements: Sequence[int] = (1, 2, 4, 8)) -> str:
    """One integrator on one rung: error at the coarsest and the finest mesh, observed order, energy left at the finest,
    each ± half of what the step sizes change (of the order: what one of them changes); or why the integrator cannot
    take it."""
    try:
        found = [[RUNGS[rung](lambda h, p=phase: scheme(p * h), n) for phase in PHASES] for n in refinements]
    except ValueError as error:
        return " ".join(str(error).split())
    errors, energies = np.moveaxis(np.array(found), 2, 0)  # (refinements, phases) each
    means = np.array([np.delete(errors, k, axis=1).mean(axis=1) for k in range(len(PHASES))])  # one phase left out each
    exact = len(errors) < 2 or means.min() < 1e-13
    order = "round-off" if exact else _mean(-np.polyfit(np.log(refinements), np.log(means.T), 1)[0])
    return f"{_mean(errors[0])} … {_mean(errors[-1])}; {order}; {_mean(energies[-1])}"


def _mean(values: Array) -> str:
    return str(Number(float(values.mean()), float(np.ptp(values)) / 2.0))


if __name__ == "__main__":
    print(f"| integrator | {' | '.join(RUNGS)} |", "| --- " * (1 + len(RUNGS)) + "|", sep="\n")
    for name, scheme in INTEGRATORS.items():
        print(f"| {name} | {' | '.join(cell(scheme, rung) for rung in RUNGS)} |", flush=True)
