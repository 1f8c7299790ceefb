"""How the tables of a case file become the quantities of :class:`bent_beam.Impact`."""

import math
from collections.abc import Mapping
from typing import Any

from bent_beam.checks import one_of, shortened
from bent_beam.errors import InputError
from bent_beam.fields import Part, declared
from bent_beam.hysteresis import FIRST_MODE
from bent_beam.impact import Impact
from bent_beam.loads import ENDS
from bent_beam.section import Section
from bent_beam.tables import AS_THEY_ARE, MODELS, WAYS, BeamTable, WallTable, _ImpactTable

TIMOSHENKO, EULER_BERNOULLI = MODELS
OWN_SHEAR = (
    'of a composite, whose G does not follow from E, take section.kind = "general" and beam.shear_stiffness, κ_sGA in N'
)
GRAVITY = 9.80665  # m/s², standard (3rd General Conference on Weights and Measures, 1901)


def impact_of(beam: BeamTable, arrival: _ImpactTable, wall: WallTable, section: Section | None) -> Impact:
    """What the tables describe. Raises ``ValueError`` naming field and value."""
    values: dict[str, Any] = {name: getattr(arrival, name) for name in (*AS_THEY_ARE, "first_touch")}
    values |= {"length": beam.length, "axial_force": beam.axial_force, "natural_curvature": beam.natural_curvature}
    _only_with("beam.tension_direction", beam.tension_direction, "beam.axial_force", beam.axial_force)
    values["tension_direction"] = beam.tension_direction or "axis"
    values |= _stiffness_and_mass(beam, section) | _shear(beam, section)
    values["curvature"] = _curvature(beam)
    values |= _damping(beam, math.sqrt(values["bending_stiffness"] / values["mass_per_length"]))
    values["left_end"], values["right_end"] = ends = _ends(beam)
    _only_with("beam.tension_direction", beam.tension_direction, "a free end", "free" in ends)
    if arrival.angular_speed is not None and beam.axial_force and ends != ("free", "free"):
        raise InputError(
            f"impact.angular_speed = {arrival.angular_speed!r} is of a beam that swings as it is, and "
            f"beam.axial_force = {beam.axial_force!r} bends it: give impact.velocity, of its middle"
        )
    values["velocity"] = _velocity(arrival, beam.length, ends)
    values["acceleration"] = _free_flight(arrival, values)
    values |= _wall(wall, values["mass_per_length"])
    impact = Impact(**values)
    if wall.damping_ratio is not None and impact.wall_span[0] == impact.wall_span[1]:
        raise InputError(f"wall.damping_ratio means nothing at a stop: give wall.damping (got {wall.damping_ratio!r})")
    return impact


def _one_of(table: Part, group: int, *, required: bool = True) -> tuple[str | None, float]:
    """Key and value of the one that is given of a group of :data:`WAYS` (``None``, 0: none is). :class:`InputError`
    names those that clash, or what is missing."""
    where, (first, *others) = table.where, WAYS[table.where][group]
    values = [(key, getattr(table, key)) for key in (first, *others)]
    given = [(key, value) for key, value in values if value not in (None, getattr(type(table), key))]
    if len(given) > 1:
        both = " and ".join(f"{where}.{key} = {value!r}" for key, value in given[:2])
        raise InputError(f"{both} say the same thing: give one of them")
    if not given and required:
        raise InputError(f"{where}.{first} is required (or {', '.join(others)})")
    return given[0] if given else (None, 0.0)


def _only_with(name: str, value: Any, other: str, is_given: Any, instead: str = "") -> None:
    """Raise :class:`InputError` for a value that means nothing without another. instead : what to do then."""
    if value is not None and not is_given:
        raise InputError(f"{name} has no effect without {other} (got {value!r}){instead}")


def _of_section(beam: BeamTable, section: Section | None, name: str) -> float | None:
    """A quantity of the section, or as it is given; ``None`` where neither knows it."""
    given, known = getattr(beam, name), getattr(section, name, None)
    if given is not None and known is not None:
        instead = f"; {OWN_SHEAR}" if name == "shear_stiffness" else ""
        raise InputError(f"beam.{name} = {given!r} and [section] say the same thing: give one of them{instead}")
    # sizes that are each allowed may make one that is not
    return given if known is None else declared(Impact)[name].checked(f"section: {name}", known)


def _stiffness_and_mass(beam: BeamTable, section: Section | None) -> dict[str, Any]:
    """EI, μ and section height."""
    found = {name: _of_section(beam, section, name) for name in ("bending_stiffness", "mass_per_length")}
    for name, value in found.items():
        if value is None:
            raise InputError(f"beam.{name} is required (or a [section])")
    if beam.section_height is not None:
        if section is not None:
            raise InputError(f"beam.section_height = {beam.section_height!r} and [section] clash: give one")
        found["section_height"] = beam.section_height
    elif section is not None:
        # the rectangle with this section's radius of gyration has its EA = 12 EI/d² (Exudyn's true geometry asks)
        found["section_height"] = math.sqrt(12.0) * section.radius_of_gyration
    return found


def _shear(beam: BeamTable, section: Section | None) -> dict[str, Any]:
    """κ_sGA, N, and ρI, kg m, of Timoshenko's beam; none of Euler and Bernoulli's."""
    found = {name: _of_section(beam, section, name) for name in ("shear_stiffness", "rotary_inertia")}
    if found["shear_stiffness"] is None:
        _only_with("beam.rotary_inertia", beam.rotary_inertia, "beam.shear_stiffness", None)
        if beam.model == TIMOSHENKO:
            raise InputError(
                f"beam.model = {beam.model!r} needs beam.shear_stiffness, κ_sGA in N, or a [section] that knows it"
            )
        return {}
    return {} if beam.model == EULER_BERNOULLI else {name: value or 0.0 for name, value in found.items()}


def _curvature(beam: BeamTable) -> float:
    """K, 1/m, of the bow: that of the circle through both ends and the middle."""
    way, bow = _one_of(beam, 0)
    _only_with("beam.sagitta_length", beam.sagitta_length, "beam.sagitta", way == "sagitta")
    if way == "curvature":
        return bow
    if way == "dogleg":
        return math.radians(bow) / 30.0
    chord = beam.length if beam.sagitta_length is None else beam.sagitta_length
    if chord > beam.length:
        raise InputError(f"beam.sagitta_length must not exceed beam.length {beam.length!r} (got {chord!r})")
    if bow >= chord / 2.0:
        raise InputError(f"beam.sagitta must be less than half its length {chord!r} (got {bow!r})")
    return 8.0 * bow / (chord**2 + 4.0 * bow**2)


def _damping(beam: BeamTable, wave: float) -> dict[str, Any]:
    """η, s: ζ = ηω/2 for the damping ratio of a mode, ηω for the loss factor; or the hysteretic loss as it is."""
    way, amount = _one_of(beam, 1, required=False)
    measured, frequency = way in ("loss_factor", "hysteretic_loss"), beam.loss_frequency
    _only_with("beam.loss_frequency", frequency, "beam.loss_factor or beam.hysteretic_loss", measured)
    mode = FIRST_MODE**2 * wave / (2.0 * math.pi * beam.length**2)
    if measured and amount and frequency is None:
        raise InputError(
            f"beam.loss_frequency is required next to beam.{way} (got {amount!r} alone): the frequency, Hz, "
            f"at which it was measured; this beam's first free–free mode is at {mode:.4g} Hz"
        )
    if way == "hysteretic_loss" and amount:
        return {"hysteretic_loss": amount, "loss_frequency": frequency}
    if way == "damping_ratio":
        amount /= math.pi * mode
    if way == "loss_factor":
        amount /= 2.0 * math.pi * (frequency or 1.0)
    return {"damping": amount}


def _ends(beam: BeamTable) -> tuple[str, str]:
    """How the left and the right end are held."""
    pair = (beam.ends, beam.ends) if isinstance(beam.ends, str) else beam.ends
    if not isinstance(pair, list | tuple) or len(pair) != 2:
        raise InputError(f"beam.ends must be one of {', '.join(ENDS)}, or a pair of these (got {shortened(beam.ends)})")
    left, right = (one_of("beam.ends", end, ENDS) for end in pair)
    return left, right


def _gravity(table: _ImpactTable) -> float:
    if table.gravity is not None:
        return table.gravity
    return GRAVITY if table.drop_height is not None else 0.0


def _towards_wall(table: _ImpactTable) -> float:
    """Gravity along the wall's normal, m/s²; none at a right angle, where the cosine of radians leaves 6e-17."""
    share = 0.0 if abs(table.gravity_angle) == 90.0 else math.cos(math.radians(table.gravity_angle))
    return _gravity(table) * share


def _velocity(table: _ImpactTable, length: float, ends: tuple[str, str]) -> float:
    """V₀, m/s, at the first touch; with a held end, at the middle."""
    (way, given), arm = _one_of(table, 0), table.angular_arm
    _only_with("impact.angular_arm", arm, "impact.angular_speed", way == "angular_speed")
    _only_with("impact.frequency", table.frequency, "impact.amplitude", way == "amplitude")
    if way == "velocity":
        return given
    if way == "amplitude":
        if table.frequency is None:
            raise InputError(f"impact.frequency, Hz, is required next to impact.amplitude (got {given!r} alone)")
        return 2.0 * math.pi * table.frequency * given
    if way == "angular_speed":
        if sorted(ends) not in (["free", "free"], ["free", "hinged"]):
            raise InputError(
                f"impact.angular_speed needs one hinge to swing about: give impact.velocity (got {given!r})"
            )
        if ends == ("free", "free") and arm is None:
            raise InputError(
                f"impact.angular_arm, m, is required next to impact.angular_speed (got {given!r} alone), of arms on "
                "which a free beam swings without turning; of one that turns, give impact.velocity, of its middle, "
                "and impact.rotation"
            )
        if ends != ("free", "free") and arm is not None:
            raise InputError(f"impact.angular_arm has no effect on a beam that swings about its hinge (got {arm!r})")
        return given * (arm or length / 2.0)
    along = _towards_wall(table)
    if along <= 0.0:
        raise InputError(
            f"impact.drop_height = {given!r} needs gravity towards the wall "
            f"(got impact.gravity = {_gravity(table)!r} at impact.gravity_angle = {table.gravity_angle!r})"
        )
    return math.sqrt(2.0 * along * given)


def _free_flight(table: _ImpactTable, values: Mapping[str, Any]) -> float:
    """a₀, m/s²: as given, or that of free flight under gravity: a₀ = g cos θ − (EI q₀ + N K)/μ."""
    gravity, force = _gravity(table), values["axial_force"]
    instead = ": give it, or set impact.gravity_angle to 0"
    _only_with("impact.gravity_angle", table.gravity_angle or None, "impact.gravity", gravity, instead)
    if table.acceleration is not None:
        return _one_of(table, 1)[1]
    bent = values["bending_stiffness"] * values["fourth_derivative"] + force * values["curvature"]
    return float(_towards_wall(table) - bent / values["mass_per_length"])


def _wall(wall: WallTable, mass_per_length: float) -> dict[str, Any]:
    """Fields of :class:`bent_beam.Impact` that the wall's table settles."""
    way, amount = _one_of(wall, 0, required=False)
    if way is not None and wall.stiffness is None:
        raise InputError(f"wall.{way} has no effect on a rigid wall: give wall.stiffness too (got {amount!r})")
    if way == "damping_ratio":
        amount *= 2.0 * math.sqrt((wall.stiffness or 0.0) * mass_per_length)
    return {
        "wall_curvature": wall.curvature,
        "opposite_wall": wall.opposite,
        "wall_clearance": wall.clearance,
        "wall_stiffness": wall.stiffness,
        "wall_damping": amount,
        "wall_from": wall.from_,
        "wall_to": wall.to,
    }
