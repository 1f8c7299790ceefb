"""What a contact law on velocities costs where loads act: Moreau and Jean's scheme next to Signorini's condition at the
new position, on the same beam, mesh and steps (θ = 1, nothing held).

``python -m open_benchmark.contact_laws`` prints the table of docs/benchmark.md.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from hermite_fe import HermiteFE
from hermite_fe.contacts import NodeContact
from hermite_fe.far_fields import GridViscosity
from hermite_fe.integrators import Integrator, MoreauJean, SignoriniPosition
from open_benchmark.problem import problem
from open_benchmark.result import Result, result_from_history
from open_benchmark.score import score

__all__ = ["LAWS", "PROBLEMS", "compared_laws", "laws_text"]

LAWS: dict[str, Callable[[float], Integrator]] = {
    "velocities (Moreau–Jean)": lambda h: MoreauJean(theta=1.0, time_step=h, growth=0.0),
    "new position": lambda h: SignoriniPosition(theta=1.0, time_step=h, growth=0.0),
}
PROBLEMS = ("leading-0.5", "first-0.5-1-1-1", "first-0.5--1--1-0", "first-0.5--0.5-0-0-1")
HALF_LENGTH = 4.0  # l*
STEPS = 160.0  # an element length: as the adapter of Siconos has them

Errors = tuple[float | None, float | None]


def _result(name: str, law: Callable[[float], Integrator], size: float) -> Result:
    asked = problem(name)
    alpha, psi, chi, axial = (asked.epsilon * value for value in asked.loads)
    loads = {"acceleration": alpha, "fourth_derivative": psi, "curvature_rate": chi, "axial_force": axial}
    impact = Impact(
        bending_stiffness=1.0,
        mass_per_length=1.0,
        length=2.0 * HALF_LENGTH,
        curvature=asked.kappa_over_nu,
        velocity=1.0,
    ).replace(**{key: value for key, value in loads.items() if value})
    method = HermiteFE(
        mesh=UniformMesh(element_length=size),
        integrator=law(asked.end_time / round(STEPS * asked.end_time / size)),
        contact=NodeContact(hold=0, hold_until=0.0),
        far_field=GridViscosity(viscosity=0.0, end="following"),
    )
    history = method.simulate(impact, end_time=asked.end_time, save=600)
    return result_from_history(history, asked)


def compared_laws(sizes: Sequence[float] = (0.04, 0.02, 0.01, 0.005)) -> dict[tuple[str, float], dict[str, Errors]]:
    """(Law, element length) → problem → relative errors of λ₀ and r₀, of λ₁ and r₁ where loads act."""
    found = {}
    for size in sizes:
        for name, law in LAWS.items():
            base = _result(PROBLEMS[0], law, size)
            scores = {PROBLEMS[0]: score(base)}
            scores |= {asked: score(_result(asked, law, size), base) for asked in PROBLEMS[1:]}
            found[name, size] = {
                asked: (s.error("lambda1"), s.error("r1"))
                if "r1" in s.measured
                else (s.error("lambda0"), s.error("r0"))
                for asked, s in scores.items()
            }
    return found


def laws_text(found: dict[tuple[str, float], dict[str, Errors]]) -> str:
    """The same as a Markdown table, in per cent."""
    lines = [f"| law on | Δx | {' | '.join(f'`{name}`' for name in PROBLEMS)} |", "| --- " * (2 + len(PROBLEMS)) + "|"]
    for (law, size), errors in found.items():
        cells = [" / ".join("–" if e is None else f"{100 * e:+.2f}" for e in errors[name]) for name in PROBLEMS]
        lines.append(f"| {law} | {size:g} | {' | '.join(cells)} |")
    return "\n".join(lines)


if __name__ == "__main__":
    print(laws_text(compared_laws()))
