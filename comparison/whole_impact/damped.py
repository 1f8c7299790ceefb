"""What the beam's own damping does to a contact zone: measured, over κ/ν and t/η.

On an endless beam without loads the damped impact has two numbers, κ/ν and the age T = t/η. Here half length, force and
impulse over those of the undamped theory are measured on two meshes or more, whose errors fall in proportion to the
elements, and extrapolated by a straight line. In a flat bow each node that is caught leaves noise, in the force of one
run some tenths of a per cent, which differs from mesh to mesh: there eight meshes share it. Until T = erf⁻¹(κ/ν)² the
contact is one point, and exact (:mod:`theory.damped_point`); so the half length is stored over λ₀√(ct)(1 − T_p/T),
which is smooth.

``python -m comparison.whole_impact.damped`` measures all (nine minutes on two cores) and writes ``damped_zone.json`` in
:mod:`theory`, which ``predict`` reads.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator
from scipy.special import erfinv

import theory
from bent_beam.impact import Impact
from bent_beam.versions import stamp
from comparison.plain import json_text
from comparison.store import RunStore, write_atomically
from comparison.whole_impact.ends import Law, law_of, theory_law
from comparison.workers import run_all
from theory import damped_zone

__all__ = ["AGES", "KAPPAS", "measure_zone"]

Array = NDArray[np.float64]
KAPPAS = (
    0.01, 0.014, 0.02, 0.03, 0.04, 0.05, 0.07, 0.1, 0.125, 0.15, 0.175, 0.2, 0.225, 0.25, 0.275, 0.3, 0.35, 0.4, 0.45,
    0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9, 0.93, 0.95, 0.97,
)  # fmt: skip
AGES = np.geomspace(0.0316, 3160.0, 81)
"""t/η: sixteen a decade."""
ELEMENTS = (0.04, 0.02)
"""At the middle, of √(cη), which damping smooths over by the age 1."""
MANY_ELEMENTS = tuple(np.geomspace(0.05, 0.0125, 8).tolist())
STEEP = 0.6  # κ/ν from which on two meshes are enough: at 0.75 the noise is 0.02 %, at 0.3 it would be 0.7 %
SHORT = 0.3  # λ₀ (of κ/ν = 0.8) below which a zone is so short that elements shrink with it, to LEAST of them
LEAST = 0.2
LOAD_KAPPAS = (0.02, 0.05, 0.1, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5)
LOAD_AGES = np.geomspace(0.3, 300.0, 25)
LOAD_ELEMENT = 0.04
PER_RUN = 4  # intervals of these ages
CHANGE = 0.15  # by the load, at the end of such a run
TOUCHING = (0.25, 0.275, 0.3, 0.35, 0.4, 0.45)
"""κ/ν between which the middle comes back to the wall while anybody looks."""
WINDOW = 0.15  # of the fits, ± in ln t
NOISY = 0.22  # κ/ν below which there is no pulse to resolve, and nodes that are caught make noise: twice the window
REACH = 20.0, 2.0  # half length over √(ct) at the last age, less a multiple of λ₀: nothing has been there and back


def measure_zone(kappa: float, ages: Array = AGES) -> Array:
    """Half length (as stored), force and impulse over the undamped theory's at ``ages``, shape (3, n): extrapolated
    from all meshes."""
    elements = ELEMENTS if kappa >= STEEP else MANY_ELEMENTS
    found = np.array([_over_theory(kappa, ages, element) for element in elements])
    _, at_zero = np.polyfit(elements, found.reshape(len(elements), -1), 1)
    return np.asarray(at_zero.reshape(found.shape[1:]))


def shortened(kappa: float) -> float:
    """How much shorter elements are where the zone is short, so that several lie in it."""
    front = theory.contact_parameters(kappa).lambda0
    return float(np.clip(front / SHORT, LEAST, 1.0)) if front > 0.0 else 1.0


def window_at(kappa: float) -> float:
    """Of the fits, ± in ln t."""
    return 2.0 * WINDOW if kappa < NOISY else WINDOW


def _over_theory(kappa: float, ages: Array, element: float) -> Array:
    reach = REACH[0] + REACH[1] * theory.contact_parameters(kappa).lambda0
    impact = Impact.dimensionless(kappa, damping=1.0, length=2.0 * reach * math.sqrt(float(ages[-1])))
    found: Law = law_of(impact, ages, element=element * shortened(kappa), window=window_at(kappa))
    half_length, force, impulse = (a / b for a, b in zip(found, theory_law(kappa, ages)))
    age_of_point = float(erfinv(kappa)) ** 2
    with np.errstate(divide="ignore", invalid="ignore"):
        spread = np.where(ages > 1.2 * age_of_point, half_length / (1.0 - age_of_point / ages), np.nan)
    first = int(np.argmax(np.isfinite(spread)))
    spread[:first] = spread[first]  # one point: multiplied by zero
    return np.array([spread, force, impulse])


def measure_loads(kappa: float, element: float = LOAD_ELEMENT) -> Array:
    """What damping changes of the answer to loads, relative, per unit of load times τ at :data:`LOAD_AGES`, shape
    (loads, 3, n): half length, force and impulse of a loaded run over those of a bare one, over what theory says of
    that, less one; no change where the contact is still one point and has no length.

    Raises ``FloatingPointError`` when a force or an impulse is not finite.
    """
    found = np.zeros((len(damped_zone.LOADS), 3, LOAD_AGES.size))
    for first in range(0, LOAD_AGES.size - 1, PER_RUN):
        part = slice(first, min(first + PER_RUN + 1, LOAD_AGES.size))
        new = slice(first + 1 if first else 0, part.stop)  # at the end of a run loads have done most
        for k, load in enumerate(damped_zone.LOADS):  # all loads of these ages share one bare run
            answer = _answer(kappa, load, LOAD_AGES[part], element)
            found[k, :, new] = answer[:, 1 if first else 0 :]
    found[:, 0] = np.nan_to_num(found[:, 0], posinf=0.0, neginf=0.0)
    if not np.isfinite(found).all():
        raise FloatingPointError(f"the force or impulse of a loaded run is not finite at kappa/nu = {kappa:g}")
    return smoothed(found) if kappa < NOISY else found


def smoothed(rates: Array) -> Array:
    """Each age's rate a half from itself and a quarter from either neighbour: nodes that are caught make noise."""
    ends = np.concatenate([rates[..., :1], rates, rates[..., -1:]], axis=-1)
    return np.asarray(0.5 * rates + 0.25 * (ends[..., :-2] + ends[..., 2:]))


def _answer(kappa: float, load: str, ages: Array, element: float) -> Array:
    solved = _loaded(kappa, load, 1.0)
    exact = theory.contact_parameters(
        kappa, solved.epsilon_alpha, solved.epsilon_psi, solved.epsilon_chi, axial=solved.epsilon_axial
    )
    change = max(abs(exact.lambda1) / exact.lambda0, abs(exact.r1) / exact.r0)
    last = float(ages[-1])
    reach = (REACH[0] + REACH[1] * exact.lambda0) * math.sqrt(last)
    size = CHANGE / (change * last)
    if load == "psi":
        size = min(size, 6.0 * kappa / reach**2)  # the bow stays one
    if load == "chi":
        size = min(size, 0.5 * kappa / last)

    def over(impact: Impact) -> Array:
        impact = impact.replace(length=2.0 * reach)
        bare = impact.replace(acceleration=0.0, fourth_derivative=0.0, curvature_rate=0.0, axial_force=0.0)
        runs = [_run(i, tuple(ages.tolist()), element) for i in (impact, bare)]
        rows = [theory.predict(i.replace(damping=0.0), ages).times for i in (impact, bare)]
        names = ("half_contact_length", "reaction", "impulse")
        said = [Law(*(np.array([getattr(row, name) for row in at]) for name in names)) for at in rows]
        return (1.0 + runs[0].over(runs[1])) / (1.0 + said[0].over(said[1])) - 1.0

    if load in ("press", "lift"):  # of one sign only: from two sizes, against the square
        once, twice = over(_loaded(kappa, load, 0.5 * size)), over(_loaded(kappa, load, size))
        return np.asarray((4.0 * once - twice) / (size * ages))
    there, back = over(_loaded(kappa, load, size)), over(_loaded(kappa, load, -size))
    return np.asarray((there - back) / (2.0 * size * ages))


@lru_cache(maxsize=4)  # for the bare run, which comes again between any two loaded ones
def _run(impact: Impact, ages: tuple[float, ...], element: float) -> Law:
    return law_of(impact, np.array(ages), element=element, window=window_at(impact.kappa_over_nu), end="following")


def _loaded(kappa: float, load: str, size: float) -> Impact:
    changes = {
        "press": {"acceleration": size},
        "lift": {"acceleration": -size},
        "chi": {"curvature_rate": size},
        "psi": {"fourth_derivative": size, "acceleration": -size},
        "axial": {"axial_force": size, "acceleration": -size * kappa},
    }[load]
    return Impact.dimensionless(kappa, damping=1.0).replace(**changes)


def touches(rows: Sequence[Array]) -> tuple[Array, Array]:
    """κ/ν, and the age at which the lifted middle comes back to the wall: the sharpest peak of the force, by a parabola
    through three ages, interpolated between :data:`TOUCHING`."""
    ages = []
    for kappa in TOUCHING:
        force = rows[KAPPAS.index(kappa)][1]
        bend = np.where((AGES[1:-1] > 5.0) & (AGES[1:-1] < 1000.0), np.diff(force, 2), 0.0)
        j = int(np.argmin(bend)) + 1
        off = 0.5 * (force[j - 1] - force[j + 1]) / (force[j - 1] - 2.0 * force[j] + force[j + 1])
        ages.append(AGES[j] * (AGES[1] / AGES[0]) ** off)
    between = np.linspace(TOUCHING[0], TOUCHING[-1], 17)
    return between, np.exp(PchipInterpolator(TOUCHING, np.log(ages))(between))


def write(rows: Sequence[Array], loads: Sequence[Array]) -> Path:
    """Write the table from what was measured at :data:`KAPPAS` and :data:`LOAD_KAPPAS`."""
    table, touch = np.array(rows), touches(rows)
    names = ("half_length", "reaction", "impulse")
    document = {
        "what": "endless damped beam over undamped theory, by kappa/nu (rows) and age t/eta (columns): reaction, "
        "impulse, and half_length over lambda0 sqrt(ct) (1 - erfinv(kappa/nu)^2/age); `touch` is the age at which the "
        "lifted middle comes back to the wall; under `loads` what damping "
        "changes of the answer to a load, relative, per unit of load times tau",
        **stamp("python -m comparison.whole_impact.damped"),
        "settings": {"path": "hermite", "extrapolated_from_elements": MANY_ELEMENTS, f"from {STEEP:g} on": ELEMENTS},
        "kappa_over_nu": KAPPAS,
        "age": [float(f"{age:.6g}") for age in AGES],
        **{name: [[float(f"{v:.5g}") for v in row] for row in table[:, i]] for i, name in enumerate(names)},
        "touch": {
            "kappa_over_nu": [float(f"{kappa:.6g}") for kappa in touch[0]],
            "age": [float(f"{age:.5g}") for age in touch[1]],
        },
        "loads": {
            "kappa_over_nu": LOAD_KAPPAS,
            "age": [float(f"{age:.6g}") for age in LOAD_AGES],
            **{
                load: {
                    name: [[float(f"{v:.3g}") for v in at[k, i]] for at in loads] for i, name in enumerate(names)
                }
                for k, load in enumerate(damped_zone.LOADS)
            },
        },
    }
    write_atomically(damped_zone.DATA, json_text(document) + "\n")
    return damped_zone.DATA


def _main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--store", type=Path, help="folder that keeps finished points: interrupted, it goes on there")
    chosen = parser.parse_args()
    measured = RunStore(chosen.store).array
    zones, loads = (
        run_all(measured, [(measure, kappa) for kappa in kappas], jobs=chosen.jobs)
        for measure, kappas in ((measure_zone, KAPPAS), (measure_loads, LOAD_KAPPAS))
    )
    print(write(zones, loads))


if __name__ == "__main__":
    _main()
