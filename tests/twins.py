"""One problem in two systems of units: every number must change with its unit."""

import json
from collections.abc import Mapping
from dataclasses import asdict, is_dataclass, replace
from functools import cache, partial
from typing import Any

import numpy as np
import pytest

from bent_beam import Impact, ImpactHistory
from bent_beam.fields import declared
from bent_beam.files import UNITS
from bent_beam.meshes import UniformMesh
from exudyn_models import ExudynModel
from exudyn_models.contacts import Rigid, SegmentFriction
from exudyn_models.elements import GeometricallyExact
from exudyn_models.geometry import TrueGeometry
from exudyn_models.integrators import RK44, GeneralizedAlpha, Newmark
from hermite_fe import HermiteFE
from hermite_fe.contacts import AlternateContact
from hermite_fe.integrators import INTEGRATORS
from self_similar_fe import SelfSimilarFE
from self_similar_fe.mesh import ExpandingMesh

EXACT = {"kg": 2.0**-30, "m": 2.0**-20, "s": 2.0**10}  # even powers of two: their roots are exact, too
POWERS = {"²": 2, "³": 3, "⁴": 4}
OF_INSTANT = {"half_contact_length": "m", "element": "m", "reaction": "N", "impulse": "N s", "impulse_around": "N s"}
OF_INSTANT |= {f"peak_{name}": unit for name, unit in zip(("force", "pressure", "penetration"), ("N", "N/m", "m"))}
OF_INSTANT |= dict.fromkeys(("peak_moment", "moment_left_out", "moment_spread"), "N m") | {"peak_force_sharp": "N"}
OF_INSTANT |= {"peak_moment_place": "m", "peak_moment_time": "s", "peak_force_place": "m", "peak_force_time": "s"}
OF_HIT = {"begin": "s", "end": "s", "place": "m", "impulse": "N s", "energy": "J", "lost": "J", "moment": "N m"}
OF_HIT |= dict.fromkeys(("before", "after"), "m/s")

# 2.4 m long, T* = 1.76 s
BEAM = Impact(2.0, 3.0, 2.4, 1.5, 1.25, acceleration=0.8, section_height=0.02, damping=2e-3)
LOADED = BEAM.replace(curvature_rate=0.3, fourth_derivative=0.5)
SHEARED = BEAM.replace(shear_stiffness=150.0, rotary_inertia=5e-3, axial_force=1.5)
BETWEEN = BEAM.replace(curvature=0.1, rotation=0.2, first_touch=0.15, opposite_wall=0.1)
SOFT = dict(wall_stiffness=6e4, wall_damping=40.0)
HELD = SHEARED.replace(left_end="clamped", right_end="hinged", wall_clearance=0.01)
TOUCHING = HELD.replace(wall_clearance=0.0, axial_force=0.0)
LOSSY = BEAM.replace(damping=0.0, hysteretic_loss=0.1, loss_frequency=5.0)


def hermite(scheme, m, s, **parts):
    return HermiteFE(mesh=UniformMesh(0.06 * m), integrator=INTEGRATORS[scheme](4e-3 * s, 0.0), **parts)


def exudyn(m, s, **parts):
    return ExudynModel(mesh=UniformMesh(0.15 * m), **parts)


def expanding(m, s):
    return SelfSimilarFE(mesh=ExpandingMesh(0.05, decades=2.0))


RUNS = {
    "Moreau and Jean": (BEAM, partial(hermite, "moreau_jean")),
    "Signorini, loads of the bow": (LOADED, partial(hermite, "signorini_position")),
    "nonsmooth generalised-α, sheared": (SHEARED, partial(hermite, "nonsmooth_generalized_alpha")),
    "penalty": (BEAM, partial(hermite, "generalized_alpha_penalty")),
    "massless boundary": (BEAM.replace(damping=0.0), partial(hermite, "massless_boundary", contact=AlternateContact())),
    "between two walls": (BETWEEN, partial(hermite, "moreau_jean", full_beam=True)),
    "two soft walls": (BETWEEN.replace(**SOFT), partial(hermite, "midpoint", full_beam=True)),
    "held": (HELD, partial(hermite, "moreau_jean", full_beam=True)),
    "hysteretic": (LOSSY, partial(hermite, "moreau_jean")),
    "expanding": (LOADED.replace(damping=0.0, curvature=0.7), expanding),
    "expanding, bare": (BEAM.replace(damping=0.0, curvature=0.7, acceleration=0.0), expanding),
    "Exudyn": (LOADED, exudyn),
    "Exudyn, sheared": (SHEARED, partial(exudyn, element=GeometricallyExact())),
    "Exudyn, constraints": (BEAM, partial(exudyn, contact=Rigid(), integrator=Newmark())),
    "Exudyn, generalised-α": (BEAM, partial(exudyn, integrator=GeneralizedAlpha(spectral_radius=0.8))),
    "Exudyn, explicit": (BEAM, partial(exudyn, integrator=RK44())),
    "Exudyn, soft wall": (BEAM.replace(**SOFT), exudyn),
    "Exudyn, between two walls": (BETWEEN, partial(exudyn, full_beam=True)),
    "Exudyn, held": (TOUCHING, partial(exudyn, full_beam=True, element=GeometricallyExact())),
    "Exudyn, true geometry": (BEAM.replace(curvature=0.1), partial(exudyn, geometry=TrueGeometry())),
    "Exudyn, a circle for a wall": (BEAM, partial(exudyn, contact=SegmentFriction(friction=0.2))),
}
OF_EVERY_KIND = ("Signorini, loads of the bow", "nonsmooth generalised-α, sheared", "expanding, bare", "Exudyn")
OF_EVERY_KIND += ("Exudyn, constraints", "Exudyn, explicit")  # whose solvers have settings without effect
QUICK = [kind if kind in OF_EVERY_KIND else pytest.param(kind, marks=pytest.mark.verify) for kind in RUNS]
SHORT = dict.fromkeys(("expanding", "expanding, bare"), 0.02)  # T*
SHORT |= {f"Exudyn, {kind}": 0.05 for kind in ("explicit", "soft wall", "true geometry")}


def factor(unit: str, base: Mapping[str, float]) -> float:
    """What a number in ``unit``, as "1/(m s)" or "N m²", is multiplied by."""
    newton = base["kg"] * base["m"] / base["s"] ** 2
    known = {"1": 1.0, "rad": 1.0, "Hz": 1.0 / base["s"], "N": newton, "J": newton * base["m"], **base}
    known["Pa"] = newton / base["m"] ** 2
    above, _, below = unit.partition("/")
    value = 1.0
    for side, sign in ((above, 1), (below.strip("()"), -1)):
        for word in side.split():
            value *= known[word.rstrip("²³⁴")] ** (sign * POWERS.get(word[-1], 1))
    return value


def in_units(part: Any, base: Mapping[str, float]) -> Any:
    """An impact or a section in other units."""
    fields = {name: (getattr(part, name), field.quantity.unit) for name, field in declared(type(part)).items()}
    given = {n: v * factor(unit or "1", base) if isinstance(v, float) else v for n, (v, unit) in fields.items()}
    return type(part)(**given)


def run(kind: str, base: Mapping[str, float] | None = None) -> ImpactHistory:
    """One of ``RUNS``, in other units where these are given."""
    impact, method = RUNS[kind]
    end = SHORT.get(kind, 0.3) * impact.slow_time_scale
    if base is not None:
        impact, end = in_units(impact, base), end * base["s"]
    made = method(**{name: (base or {}).get(name, 1.0) for name in "ms"})
    if not isinstance(made, SelfSimilarFE):
        made = made.for_whole_beam(impact)
    return made.simulate(impact, end_time=end, save=60)


once = cache(run)


def retold(history: ImpactHistory, base: Mapping[str, float]) -> ImpactHistory:
    """The record of a run in other units."""
    parts = history.variables.items()
    told = {n: v._replace(values=v.values * factor(UNITS[n], base)) if n in UNITS else v for n, v in parts}
    impact = json.dumps(asdict(in_units(history.impact, base)))
    return replace(history, variables=told, attrs={**history.attrs, "impact": impact})


def agree(one: Any, other: Any, units: Mapping[str, str] = {}, base: Mapping[str, float] = EXACT) -> None:
    """``other`` is ``one`` times its unit, attribute by attribute; what has none in ``units`` is the same number."""
    for name, value in vars(one).items():
        theirs, unit = getattr(other, name), factor(units.get(name, "1"), base)
        if isinstance(value, dict) and all(isinstance(part, float) for part in value.values()):
            assert value.keys() == theirs.keys()
            value, theirs = tuple(value.values()), tuple(theirs.values())
        parts = value if isinstance(value, tuple) else (value,)
        if parts and is_dataclass(parts[0]):
            for part, its in zip(parts, theirs if isinstance(value, tuple) else (theirs,), strict=True):
                agree(part, its, units, base)
        elif isinstance(value, (float, tuple, np.ndarray)):
            wanted = np.asarray(value, float) * unit
            near = 1e-9 * max(np.abs(wanted).max(initial=0.0), unit)
            assert np.asarray(theirs) == pytest.approx(wanted, rel=0.0, abs=near), name
        else:
            assert theirs == value, name


def differences(one: ImpactHistory, other: ImpactHistory, base: Mapping[str, float]) -> dict[str, float]:
    """Of every variable with a unit that says something, the largest difference over the largest value."""
    assert one.dataset.variables.keys() == other.dataset.variables.keys()
    units = UNITS | {"complementarity_product": "J"}  # a path's own number, whose unit no file states
    wanted = {n: v.values * factor(units[n], base) for n, v in one.dataset.variables.items() if n in units}
    sizes = {name: np.abs(values).max(initial=0.0) for name, values in wanted.items()}
    return {n: float(np.abs(other.dataset[n].values - wanted[n]).max() / size) for n, size in sizes.items() if size}
