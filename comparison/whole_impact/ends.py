"""Where the theory of the first instants ends on a real beam: waves that have been at the ends, measured.

The same beam and one that is so long that nothing can come back, on the same elements with the same steps, differ by
them alone: relative changes of half length, force and impulse are stored over κ/ν and the phase of the waves. A beam
whose free motion has a fourth derivative q₀ needs moments and forces at its ends; without them waves start there at
once. Their part is stored too, per unit of q₀, from runs with ±q₀ and no pressure on the zone. (Nothing of the kind was
found for c₀ and an axial force.)

Half length and force come from moments of the impulse: parabolas in √t through ±:data:`WINDOW` in ln t.
``python -m comparison.whole_impact.ends`` measures all (two minutes) and writes ``ends.json`` in :mod:`theory`, which
``predict`` reads.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

import theory
from bent_beam.impact import Impact
from bent_beam.meshes import GradedMesh
from bent_beam.versions import stamp
from comparison.estimators import one_side
from comparison.plain import json_text
from comparison.store import RunStore, write_atomically
from comparison.workers import run_all
from theory import damped_point
from theory.stopped_beam import StoppedBeam
from theory.validity import phase

__all__ = ["Law", "law_of", "measure_ends", "reached", "theory_law"]

Array = NDArray[np.float64]
DATA = Path(theory.__file__).with_name("ends.json")
KAPPAS = (
    0.05, 0.06, 0.07, 0.085, 0.1, 0.12, 0.14, 0.17, 0.2, 0.235, 0.27, 0.31, 0.35, 0.42, 0.5, 0.57, 0.65, 0.72, 0.8,
    0.85, 0.9, 1.2,
)  # fmt: skip
DAMPINGS = (1e-4, 3e-4, 1e-3, 3e-3, 1e-2)
USUAL = 1e-3  # η/T* of the curves; other dampings get a factor on time
TOLERANCE = 0.02
LARGEST = 2.5  # changes beyond it are no small ones and stored as it
LONGER = 2.5  # times the beam: what comes back from its ends then comes 6.25 times later
TIMES = np.geomspace(2e-3, 0.07, 360)
"""Instants measured, T*: ten a period of the shortest waves that come back."""
PHASES = {"ends": np.arange(2.0, 42.01, 0.5), "quartic": np.linspace(0.0, 5.5, 81).round(3) ** 2}
"""Phases stored (`theory.validity.phase`): over them crests of all κ/ν lie side by side."""
NOISE = 0.7  # of the time at which the force has changed by the tolerance: before, there is nothing but noise
QUARTIC = 1.0  # q₀ of the runs with one, of min(κ/ν, 1): ends bend by 4 % of K until the last; 1.2 is felt as a square
QUARTIC_ELEMENTS = (0.045, 0.04, 0.036)
"""Meshes that share the noise of nodes that are caught: of a force the third part of the tolerance on one of them."""

WINDOW = 0.11  # of fitted times, ± in ln t
SAVED = 100  # instants an e-fold
ELEMENT = 0.04  # at the middle, over √(√(EI/μ) η)
ZONE = 4.0  # of such elements, in the same length
GROWTH = 0.01  # of elements further out
STEP = 2e-3  # over the time
FLAT = 0.05  # κ/ν below which elements and steps grow more slowly


class Law(NamedTuple):
    """Half length (m), force (N) and impulse (N s) of one side."""

    half_length: Array
    force: Array
    impulse: Array

    def over(self, other: Law) -> Array:
        """Relative differences of the three, shape (3, n)."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.array([a / b - 1.0 for a, b in zip(self, other)])


def law_of(
    impact: Impact, times: Array, *, element: float = ELEMENT, window: float = WINDOW, end: str = "free"
) -> Law:
    """A whole-beam run, by moments of the impulse at ``times`` (s): what one side bears.

    element : Δx at the middle over √(√(EI/μ) η), which the beam's own damping η smooths over by t = η; further out
        elements grow, steps grow with time.
    end : of the beam, as of a far field.
    """
    from hermite_fe import HermiteFE
    from hermite_fe.contacts import NodeContact
    from hermite_fe.far_fields import GridViscosity
    from hermite_fe.integrators import SignoriniPosition

    smoothed = math.sqrt(impact.wave_constant * impact.damping)
    refinement = ELEMENT / element
    flattest = min(1.0, impact.kappa_over_nu / FLAT)  # the flatter, the thinner the front over its distance
    method = HermiteFE(
        mesh=GradedMesh(
            element * smoothed, 1.0 + GROWTH * flattest / refinement, min(ZONE * smoothed, impact.half_length), 1e9
        ),
        integrator=SignoriniPosition(
            theta=0.5,
            time_step=0.5 * (element * smoothed) ** 2 / impact.wave_constant,
            growth=STEP * flattest**0.5 / refinement,
        ),
        contact=NodeContact(hold=0, hold_until=0.0),
        far_field=GridViscosity(viscosity=0.0, end=end),
    )
    ends = float(times[0]) * math.exp(-window), float(times[-1]) * math.exp(window)
    saved = np.geomspace(ends[0], ends[1], 2 + round(SAVED * math.log(ends[1] / ends[0])))
    history = method.simulate(impact, end_time=ends[1], save=saved)
    impulse, moment = one_side(history)
    with np.errstate(divide="ignore", invalid="ignore"):
        return _fitted(history.time, impulse, moment, times, window, max(impact.zone_pressure, 0.0))


def _fitted(time: Array, impulse: Array, moment: Array, times: Array, window: float, pressure: float) -> Law:
    """``pressure``, N/m, acts between the middle and the concentrated force whose place is the half length."""
    fits = np.array([[*_local(time, impulse, t, window), _local(time, moment, t, window)[1]] for t in times])
    force = fits[:, 1] / (2.0 * np.sqrt(times))
    turn = fits[:, 2] / (2.0 * np.sqrt(times))
    if pressure > 0.0:  # turn = (force − pλ)λ + pλ²/2
        place = (force - np.sqrt(np.maximum(force**2 - 2.0 * pressure * turn, 0.0))) / pressure
    else:
        place = turn / force
    return Law(place, force, fits[:, 0])


def _local(time: Array, values: Array, at: float, window: float) -> tuple[float, float]:
    """Value and slope in √t at ``at``, of a parabola in √t around it."""
    inside = (time > at * math.exp(-window)) & (time < at * math.exp(window))
    root = np.sqrt(time[inside])
    fit = np.polyfit(root - math.sqrt(at), values[inside], 2)
    return float(fit[2]), float(fit[1])


def theory_law(kappa: float, times: Array) -> Law:
    """The undamped infinite beam's law with EI = μ = V₀ = 1."""
    exact = theory.contact_parameters(kappa)
    force = math.sqrt(2.0 / math.pi) * exact.r0
    return Law(exact.lambda0 * np.sqrt(times), force / np.sqrt(times), 2.0 * force * np.sqrt(times))


def reached(times: Array, error: Array, tolerance: float) -> float | None:
    """When an error of either sign first reaches ``tolerance`` in size, by interpolation; ``None`` if it does not."""
    beyond = np.flatnonzero(np.abs(error) >= tolerance)
    if beyond.size == 0:
        return None
    k = int(beyond[0])
    if k == 0:
        return 0.0
    share = (math.copysign(tolerance, error[k]) - error[k - 1]) / (error[k] - error[k - 1])
    return float(times[k - 1] * (times[k] / times[k - 1]) ** share)


def measure_ends(kappa: float, damping: float = USUAL, element: float = ELEMENT) -> Array:
    """Relative changes of half length (0 for one point), force and impulse by the ends at :data:`TIMES`, (3, n)."""
    beam = Impact.whole_beam(kappa, relative_damping=damping)
    real, endless = (
        law_of(impact, TIMES, element=element) for impact in (beam, beam.replace(length=LONGER * beam.length))
    )
    return _tidy(real.over(endless), kappa)


def measure_quartic(kappa: float) -> Array:
    """The same by the free motion's fourth derivative, per unit of q₀ (V₀T*/ℓ⁴), against a longer beam whose ends
    follow the free motion; the mean of all meshes."""
    with np.errstate(invalid="ignore"):  # one point has no length to compare
        return _tidy(np.mean([_quartic(kappa, element) for element in QUARTIC_ELEMENTS], axis=0), kappa)


def _quartic(kappa: float, element: float) -> Array:
    size = QUARTIC * min(kappa, 1.0)
    beam = Impact.whole_beam(kappa, relative_damping=USUAL)
    answers = []
    for impact, end in ((beam, "free"), (beam.replace(length=LONGER * beam.length), "following")):
        bare, *loaded = (
            law_of(
                impact.replace(fourth_derivative=sign * size, acceleration=-sign * size),
                TIMES,
                element=element,
                end=end,
            )
            for sign in (0.0, 1.0, -1.0)
        )
        answers.append((loaded[0].over(bare) - loaded[1].over(bare)) / (2.0 * size))
    return np.asarray(answers[0] - answers[1])


def _tidy(change: Array, kappa: float) -> Array:
    """Bounded, and held once it is: what follows is no small change any more."""
    if kappa >= 1.0:
        change[0] = 0.0
    change = np.nan_to_num(change, nan=np.inf)
    for row in change:
        beyond = np.flatnonzero(np.abs(row) > LARGEST)
        if beyond.size:
            row[beyond[0] :] = np.sign(row[beyond[0]]) * LARGEST
    return change


def one_point(damping: float, tolerance: float = TOLERANCE) -> float:
    """t/T* until which the ends change impulse and momentary force of one point by less, exact for κ/ν ≥ 1."""
    times = np.geomspace(1e-3, 0.1, 4000)
    beam, age = StoppedBeam(damping), times / damping
    endless = 2.0 * np.sqrt(2.0 / math.pi) * np.sqrt(times)
    force = beam.reaction(times) * times / (endless * damped_point.reaction_ratio(age))
    impulse = beam.impulse(times) / (2.0 * endless * damped_point.impulse_ratio(age))
    found = reached(times, np.maximum(np.abs(force - 1.0), np.abs(impulse - 1.0)), tolerance)
    assert found is not None
    return found


def _factors(curves: dict[float, list[Array]]) -> dict[float, float]:
    """By η/T*: the least, over κ/ν, of the time at which 2 % are reached over that with the usual damping."""

    def first(curve: Array) -> float | None:
        felt = [reached(TIMES, row, TOLERANCE) for row in curve]
        return min((time for time in felt if time is not None), default=None)

    at = {damping: [first(curve) for curve in found] for damping, found in curves.items()}
    exact = {damping: one_point(damping) / one_point(USUAL) for damping in (1e-5, *DAMPINGS)}
    least = {
        damping: min((a / b for a, b in zip(times, at[USUAL]) if a and b), default=math.inf)
        for damping, times in at.items()
    }
    return {damping: min(factor, least.get(damping, factor)) for damping, factor in exact.items()}


def write(curves: dict[float, list[Array]], quartic: Sequence[Array]) -> Path:
    """Write the table from the curves by damping, each a list over :data:`KAPPAS`."""
    names = ("half_length", "reaction", "impulse")

    def stored(cause: str, found: Sequence[Array], felt: Sequence[float]) -> dict[str, Any]:
        over = []
        for kappa, curve, least in zip(KAPPAS, found, felt):
            at, arrives = phase(kappa, TIMES)[cause], reached(TIMES, curve[1], least)  # phases fall with time
            if arrives is None:
                raise ValueError("TIMES: a force never changes as much as asked for; measure later")
            row = np.array([np.interp(PHASES[cause], at[::-1], of[::-1], right=0.0) for of in curve])
            over.append(np.where(PHASES[cause] > phase(kappa, np.array([NOISE * arrives]))[cause], 0.0, row))
        return {
            "phase": [float(f"{at:.6g}") for at in PHASES[cause]],
            **{name: [[float(f"{v:.4g}") for v in row[i].round(6)] for row in over] for i, name in enumerate(names)},
        }

    arrival = [reached(TIMES, curve[1], TOLERANCE) for curve in curves[USUAL]]
    if None in arrival:
        raise ValueError("TIMES: a force never changes as much as asked for; measure later")
    factors = _factors(curves)
    document = {
        "what": "relative change by the ends of a free beam, of half length, reaction and impulse, over kappa/nu "
        "(rows) and phase (columns) of the waves that are back at the front of the contact (theory.validity.phase; it "
        "falls with time), at damping eta/T* = 1e-3: `ends` without loads, `quartic` per unit of q0 l^4/(V0 T*) on "
        "top; measured until `last` t/T*; `arrival` is t/T* when the reaction has changed by the tolerance; the same "
        "comes `factor` times later at other `damping` (the least over kappa/nu; the smallest stands for none)",
        "tolerance": TOLERANCE,
        "source": "the whole beam against one without ends, comparison/whole_impact/ends.py",
        **stamp("python -m comparison.whole_impact.ends"),
        "settings": {"path": "hermite", "element": ELEMENT, "longer": LONGER, "window": WINDOW},
        "kappa_over_nu": KAPPAS,
        "last": float(TIMES[-1]),
        "arrival": [float(f"{at:.5g}") for at in arrival if at is not None],
        "damping": list(factors),
        "factor": [float(f"{factor:.4g}") for factor in factors.values()],
        "ends": stored("ends", curves[USUAL], [TOLERANCE] * len(KAPPAS)),
        "quartic": stored("quartic", quartic, [TOLERANCE / min(kappa, 1.0) for kappa in KAPPAS]),
    }
    write_atomically(DATA, json_text(document) + "\n")
    return DATA


def _main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--store", type=Path, help="folder that keeps finished points: interrupted, it goes on there")
    chosen = parser.parse_args()
    measured = RunStore(chosen.store).array
    asked = [(measure_ends, kappa, damping) for damping in DAMPINGS for kappa in KAPPAS]
    curves: dict[float, list[Array]] = {damping: [] for damping in DAMPINGS}
    for (_, _, damping), curve in zip(asked, run_all(measured, asked, jobs=chosen.jobs)):
        curves[damping].append(curve)
    quartic = run_all(measured, [(measure_quartic, kappa) for kappa in KAPPAS], jobs=chosen.jobs)
    print(write(curves, quartic))


if __name__ == "__main__":
    _main()
