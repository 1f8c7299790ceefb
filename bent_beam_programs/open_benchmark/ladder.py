"""This project's integrators on problems of the open benchmark: two tables of docs/benchmark.md.

    python -m bent_beam_programs.open_benchmark.ladder           # observed orders on the ladder's lower rungs
    python -m bent_beam_programs.open_benchmark.ladder --laws    # errors of λ₀, r₀, λ₁ and r₁ by contact law

On the rungs, against the closed forms of ``theory``: ball, bar and string as :class:`hermite_fe.system.System`, the
stopped beam as a run of the Hermite path. Errors are the mean of |J − J exact| over the record, over the largest J.

Where loads act, the errors of a contact law on velocities stand next to those of Signorini's condition at the new
position, on the same beam, mesh and steps (θ = 1, strict contact).
"""

import sys
from collections.abc import Callable, Sequence
from functools import partial
from itertools import product
from typing import Any

import numpy as np

from bent_beam import Impact
from bent_beam.measure.numbers import Number
from bent_beam.meshes import UniformMesh
from bent_beam_programs.open_benchmark.histories import result_from_history
from bent_beam_programs.open_benchmark.problem import LADDER, problem
from bent_beam_programs.open_benchmark.references import reference
from bent_beam_programs.open_benchmark.result import Result
from bent_beam_programs.open_benchmark.score import score
from hermite_fe import HermiteFE
from hermite_fe.constraints import ContactLaw
from hermite_fe.contacts import NodeContact
from hermite_fe.far_fields import GridViscosity
from hermite_fe.integrators import INTEGRATORS as KINDS
from hermite_fe.run import integrate
from hermite_fe.system import ContactRows, System

Array = np.ndarray[Any, Any]
Scheme = Callable[[float], Any]  # an integrator of a time step

EVEN = {name: partial(kind, growth=0.0) for name, kind in KINDS.items()}
INTEGRATORS: dict[str, Scheme] = {
    "Moreau–Jean θ = 1": partial(EVEN["moreau_jean"], theta=1.0),
    "Moreau–Jean θ = ½": partial(EVEN["moreau_jean"], theta=0.5),
    "Signorini, new position": partial(EVEN["signorini_position"], theta=1.0),
    "nonsmooth generalised-α, ρ∞ = 0.8": partial(EVEN["nonsmooth_generalized_alpha"], spectral_radius=0.8),
    "generalised-α with penalty, ρ∞ = 0.8": lambda h: EVEN["generalized_alpha_penalty"](
        h, spectral_radius=0.8, stiffness=0.1 / h**2, damping=0.3 / h
    ),
    "massless boundary": EVEN["massless_boundary"],
}
COURANT = 0.437  # of their steps
# Where in its step an impact falls is chance: errors are means over step sizes that differ by a few per cent.
PHASES = (1.0, 0.93, 0.87, 0.81)


def judged(name: str, time: Array, impulse: Array, energy: Array) -> tuple[float, float]:
    """Error of the impulse, energy at the end over that at the start."""
    exact: Any = reference(problem(name)).impulse
    expected = exact(time)
    return np.mean(np.abs(impulse - expected)) / np.abs(expected).max(), energy[-1] / energy[0]


def run_of(
    name: str, integrator: Any, system: System, start: Array, velocity: Array, instants: int, held: float = 0.0
) -> tuple[float, float]:
    """A rung with its restitution, saved at so many instants; ``held`` is an energy at the start that no sum has."""
    _, given, end = LADDER[name]
    law, save = ContactLaw(given.get("restitution", 0.0)), np.linspace(0.0, end, instants)
    run = integrate(system, start, velocity, integrator, end, law=law, save=save)
    energy = run.sums["kinetic_energy"] + run.sums["strain_energy"] - run.sums["work_of_loads"]
    return judged(name, run.time, run.impulse.sum(axis=1), energy + held)


def ball(scheme: Scheme, refine: int) -> tuple[float, float]:
    """A unit mass dropped from ½ under unit gravity with restitution 1: ten impacts by t = 20."""
    one = np.ones((1, 1))
    system = System(mass=one, stiffness=0.0 * one, load=-one, contacts=first_touches(0.0))
    height, step = LADDER["ball"].given["height"], 0.0137 / refine  # steps that do not divide the flights
    return run_of("ball", scheme(step), system, np.array([height]), np.zeros(1), 1001, held=height)


def first_touches(gap: float) -> ContactRows:
    """The first unknown meets the wall after ``gap``."""
    return ContactRows(np.array([[0]]), np.array([[1.0]]), np.array([gap]))


def line(refine: int) -> tuple[Array, Array, Array]:
    """Places, lumped mass and stiffness of linear elements of unit stiffness and mass in a row of length 1, banded."""
    cells = 50 * refine
    share = np.r_[0.5, np.ones(cells - 1), 0.5]
    stiffness = np.array([2.0 * cells * share, np.full(cells + 1, -cells)])
    return np.linspace(0.0, 1.0, cells + 1), share[None] / cells, stiffness


def bar(scheme: Scheme, refine: int) -> tuple[float, float]:
    """A bar that flies at the wall, in contact for 2L/c, off again as it came."""
    given, (x, mass, stiffness) = LADDER["bar"].given, line(refine)
    system = System(mass=mass, stiffness=stiffness, contacts=first_touches(given["gap"]))
    return run_of("bar", scheme(COURANT * x[1]), system, 0.0 * x, 0.0 * x - given["velocity"], 601)


def string(scheme: Scheme, refine: int) -> tuple[float, float]:
    """A string that lands all at once, elastically, four times."""
    x, mass, stiffness = line(refine)
    inner = np.arange(1, x.size - 1)[:, None]
    contacts = ContactRows(inner, np.ones(inner.shape), np.zeros(inner.size))
    system = System(mass=mass, stiffness=stiffness, contacts=contacts, supports=(0, x.size - 1))
    start = 4.0 * LADDER["string"].given["height"] * x * (1.0 - x)
    return run_of("string", scheme(COURANT * x[1]), system, start, 0.0 * x, 801)


def stopped_beam(scheme: Scheme, refine: int) -> tuple[float, float]:
    """The free beam of κ/ν = 2 with its own damping, until before the wall first lets go."""
    asked = problem("stopped-beam")
    impact = Impact.dimensionless(asked.kappa_over_nu, damping=asked.damping, length=2.0)
    mesh, contact = UniformMesh(element_length=1.0 / (25 * refine)), NodeContact(hold=0, hold_until=0.0)
    method = HermiteFE(mesh=mesh, integrator=scheme(0.25 / 25.0**2 / refine), contact=contact)
    history = method.simulate(impact, end_time=asked.end_time, save=np.linspace(0.0, asked.end_time, 101))
    energy = history.array("kinetic_energy") + history.array("strain_energy")
    return judged(asked.id, history.time, history.array("total_impulse"), energy)


RUNGS = {"ball": ball, "bar": bar, "string": string, "stopped-beam": stopped_beam}


def in_phase(scheme: Scheme, phase: float) -> Scheme:
    """The scheme with steps that many times as long."""
    return lambda h: scheme(phase * h)


def cell(scheme: Scheme, rung: Callable[[Scheme, int], tuple[float, float]]) -> str:
    """One integrator on one rung: error at the coarsest and the finest mesh, observed order, energy left at the finest,
    each ± half of what the step sizes change (of the order: what one of them changes); or why it cannot take it."""
    refinements = (1, 2, 4, 8)
    try:
        found = [[rung(in_phase(scheme, phase), n) for phase in PHASES] for n in refinements]
    except ValueError as error:
        return " ".join(str(error).split())
    errors, energies = np.moveaxis(np.array(found), 2, 0)  # (refinements, phases) each
    means = np.array([np.delete(errors, k, axis=1).mean(axis=1) for k in range(len(PHASES))])  # one phase left out each
    orders = -np.polyfit(np.log(refinements), np.log(means.T), 1)[0]
    numbers = [Number(part.mean(), np.ptp(part) / 2.0) for part in (errors[0], errors[-1], orders, energies[-1])]
    return "{} … {}; {}; {}".format(*numbers)


LAWS = {"velocities (Moreau–Jean)": EVEN["moreau_jean"], "new position": EVEN["signorini_position"]}
PROBLEMS = ("leading-0.5", "first-0.5-1-1-1", "first-0.5--1--1-0", "first-0.5--0.5-0-0-1")
STEPS = 160.0  # an element length: as the adapter of Siconos has them


def result_of(name: str, law: str, size: float) -> Result:
    """A problem by a contact law on elements of this length."""
    asked = problem(name)
    names = ("acceleration", "fourth_derivative", "curvature_rate", "axial_force")
    loads = {name: asked.epsilon * value for name, value in zip(names, asked.loads) if value}
    impact = Impact.dimensionless(asked.kappa_over_nu, length=8.0).replace(**loads)
    scheme = LAWS[law](theta=1.0, time_step=asked.end_time / round(STEPS * asked.end_time / size))
    contact, far_field = NodeContact(hold=0, hold_until=0.0), GridViscosity(viscosity=0.0, end="following")
    method = HermiteFE(mesh=UniformMesh(size), integrator=scheme, contact=contact, far_field=far_field)
    return result_from_history(method.simulate(impact, end_time=asked.end_time, save=600), asked)


def errors_of(law: str, size: float, names: Sequence[str]) -> list[list[Any]]:
    """Relative errors and bars of λ₀ and r₀ without loads, then of λ₁ and r₁ of the problems named."""
    base = result_of(PROBLEMS[0], law, size)
    scores = [score(base), *(score(result_of(name, law, size), base) for name in names)]
    return [[(found.error(name), found.bar(name)) for name in list(found.measured)[-2:]] for found in scores]


def print_laws() -> None:
    print("| law on | Δx |", " | ".join(f"`{name}`" for name in PROBLEMS), "|")
    print("| ---" * (2 + len(PROBLEMS)), "|")
    for size, law in product((0.04, 0.02, 0.01, 0.005), LAWS):
        errors = errors_of(law, size, PROBLEMS[1:])
        shown = [["–" if e is None else f"{100 * e:+.2f} ± {100 * b:.2g}" for e, b in pair] for pair in errors]
        print(f"| {law} | {size:g} |", " | ".join(map(" / ".join, shown)), "|", flush=True)


def print_rungs() -> None:
    print(f"| integrator | {' | '.join(RUNGS)} |", "| --- " * (1 + len(RUNGS)) + "|", sep="\n")
    for name, scheme in INTEGRATORS.items():
        print(f"| {name} | {' | '.join(cell(scheme, rung) for rung in RUNGS.values())} |", flush=True)


if __name__ == "__main__":
    print_laws() if "--laws" in sys.argv else print_rungs()
