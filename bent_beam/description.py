"""From the beam as its owner knows it to the quantities of :class:`bent_beam.Impact`.

One or the other, never both: two ways to say the same thing clash, and the error names them.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from bent_beam.checks import one_of, shortened
from bent_beam.errors import InputError
from bent_beam.fields import declared
from bent_beam.hysteresis import FIRST_MODE
from bent_beam.impact import Impact
from bent_beam.section import Section
from bent_beam.supports import ENDS
from bent_beam.tables import BeamTable, ImpactTable, WallTable

__all__ = ["beam_quantities", "free_flight", "impact_velocity", "one_of_these", "wall_quantities"]

GRAVITY = 9.80665  # m/s², standard (3rd General Conference on Weights and Measures, 1901)


def one_of_these(where: str, values: Mapping[str, float | None], *, required: bool = True) -> tuple[str | None, float]:
    """Name and value of the one that is given (``None``, 0: none is).

    Raises :class:`InputError` naming those that clash, or what is missing.
    """
    given = [(name, value) for name, value in values.items() if value is not None]
    if len(given) > 1:
        both = " and ".join(f"{where}.{name} = {value!r}" for name, value in given[:2])
        raise InputError(f"{both} say the same thing: give one of them")
    if not given and required:
        raise InputError(f"{where}.{next(iter(values))} is required (or {', '.join(list(values)[1:])})")
    return given[0] if given else (None, 0.0)


def beam_quantities(beam: BeamTable, section: Section | None) -> dict[str, Any]:
    """Fields of :class:`bent_beam.Impact` that the beam's tables settle."""
    found: dict[str, Any] = {"length": beam.length, "axial_force": beam.axial_force}
    found["natural_curvature"] = beam.natural_curvature
    if beam.tension_direction is not None:
        if not beam.axial_force:
            raise InputError(
                f"beam.tension_direction has no effect without beam.axial_force (got {beam.tension_direction!r})"
            )
        found["tension_direction"] = beam.tension_direction
    for name in ("bending_stiffness", "mass_per_length"):
        value = getattr(beam, name)
        if section is None and value is None:
            raise InputError(f"beam.{name} is required (or a [section])")
        if section is not None and value is not None:
            raise InputError(f"beam.{name} = {value!r} and [section] say the same thing: give one of them")
        found[name] = value if section is None else _of_section(section, name)
    if beam.section_height is not None:
        if section is not None:
            raise InputError(f"beam.section_height = {beam.section_height!r} and [section] clash: give one")
        found["section_height"] = beam.section_height
    elif section is not None:
        # d of EA = 12 EI/d²: that of a rectangle with this section's radius of gyration
        found["section_height"] = math.sqrt(12.0) * section.radius_of_gyration
    found["curvature"] = _curvature(beam)
    wave = math.sqrt(found["bending_stiffness"] / found["mass_per_length"])
    found |= _damping(beam, wave)
    found["left_end"], found["right_end"] = _ends(beam)
    return found


def _ends(beam: BeamTable) -> tuple[str, str]:
    """How the left and the right end are held."""
    pair = (beam.ends, beam.ends) if isinstance(beam.ends, str) else beam.ends
    if not isinstance(pair, list | tuple) or len(pair) != 2:
        raise InputError(f"beam.ends must be one of {', '.join(ENDS)}, or a pair of these (got {shortened(beam.ends)})")
    try:
        left, right = (one_of("beam.ends", end, ENDS) for end in pair)
    except ValueError as error:
        raise InputError(str(error)) from None
    return left, right


def wall_quantities(wall: WallTable, mass_per_length: float) -> dict[str, Any]:
    """Fields of :class:`bent_beam.Impact` that the wall's table settles."""
    way, amount = one_of_these("wall", {"damping": wall.damping, "damping_ratio": wall.damping_ratio}, required=False)
    if way is not None and wall.stiffness is None:
        raise InputError(f"wall.{way} has no effect on a rigid wall: give wall.stiffness too (got {amount!r})")
    if way == "damping_ratio":
        if wall.from_ is not None and wall.from_ == wall.to:
            raise InputError(f"wall.damping_ratio means nothing at a stop: give wall.damping, N s/m (got {amount!r})")
        amount *= 2.0 * math.sqrt((wall.stiffness or 0.0) * mass_per_length)
    return {
        "wall_curvature": wall.curvature,
        "opposite_wall": wall.opposite,
        "wall_stiffness": wall.stiffness,
        "wall_damping": amount,
        "wall_from": wall.from_,
        "wall_to": wall.to,
    }


def _of_section(section: Section, name: str) -> float:
    """EI or μ of a section. Raises :class:`InputError` where sizes that are each allowed make one that is not."""
    try:
        return float(declared(Impact)[name].checked(f"section: {name}", getattr(section, name)))
    except ValueError as error:
        raise InputError(str(error)) from None


def _curvature(beam: BeamTable) -> float:
    """K, 1/m, of the bow: that of the circle through both ends and the middle."""
    ways = {"curvature": beam.curvature, "sagitta": beam.sagitta, "dogleg": beam.dogleg}
    way, bow = one_of_these("beam", ways)
    if way != "sagitta" and beam.sagitta_length is not None:
        raise InputError(f"beam.sagitta_length has no effect without beam.sagitta (got {beam.sagitta_length!r})")
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
    ways = {"damping": beam.damping, "damping_ratio": beam.damping_ratio, "loss_factor": beam.loss_factor}
    way, amount = one_of_these("beam", ways | {"hysteretic_loss": beam.hysteretic_loss or None}, required=False)
    if way not in ("loss_factor", "hysteretic_loss"):
        if beam.loss_frequency is not None:
            raise InputError(
                f"beam.loss_frequency has no effect without beam.loss_factor or beam.hysteretic_loss "
                f"(got {beam.loss_frequency!r})"
            )
    elif beam.loss_frequency is None:
        mode = FIRST_MODE**2 * wave / (2.0 * math.pi * beam.length**2)
        raise InputError(
            f"beam.loss_frequency is required next to beam.{way} (got {amount!r} alone): the frequency, Hz, "
            f"at which it was measured; this beam's first free–free mode is at {mode:.4g} Hz"
        )
    if way == "hysteretic_loss":
        return {"hysteretic_loss": amount, "loss_frequency": beam.loss_frequency}
    if way == "damping_ratio":
        amount *= 2.0 * (beam.length / FIRST_MODE) ** 2 / wave
    if way == "loss_factor":
        amount /= 2.0 * math.pi * (beam.loss_frequency or 0.0)
    return {"damping": amount}


def impact_velocity(table: ImpactTable, length: float, ends: tuple[str, str] = ("free", "free")) -> float:
    """V₀, m/s, of the first touch, where an end is held of the middle."""
    ways = {"velocity": table.velocity, "drop_height": table.drop_height, "angular_speed": table.angular_speed}
    way, given = one_of_these("impact", ways)
    if way != "angular_speed" and table.angular_arm is not None:
        raise InputError(f"impact.angular_arm has no effect without impact.angular_speed (got {table.angular_arm!r})")
    if way == "angular_speed" and ends != ("free", "free"):
        if sorted(ends) != ["free", "hinged"]:
            raise InputError(
                f"impact.angular_speed needs one hinge to swing about: give impact.velocity (got {given!r})"
            )
        if table.angular_arm is not None:
            raise InputError(
                f"impact.angular_arm has no effect on a beam that swings about its hinge (got {table.angular_arm!r})"
            )
    if way == "velocity":
        return given
    if way == "angular_speed":
        return given * (length / 2.0 if table.angular_arm is None else table.angular_arm)
    gravity = _gravity(table)
    along = gravity * math.cos(math.radians(table.gravity_angle))
    if along <= 0.0:
        raise InputError(
            f"impact.drop_height = {given!r} needs gravity towards the wall "
            f"(got impact.gravity = {gravity!r} at impact.gravity_angle = {table.gravity_angle!r})"
        )
    return math.sqrt(2.0 * along * given)


def _gravity(table: ImpactTable) -> float:
    if table.gravity is not None:
        return table.gravity
    return GRAVITY if table.drop_height is not None else 0.0


def free_flight(table: ImpactTable, beam: Mapping[str, Any]) -> float:
    """a₀, m/s²: as given, or that of free flight under gravity, which tension bends: a₀ = g cos θ − (EI q₀ + N K)/μ.

    Without gravity and tension a beam of which no acceleration is given does not accelerate.
    """
    gravity = _gravity(table)
    if table.gravity_angle and not gravity:
        raise InputError(f"impact.gravity_angle has no effect without impact.gravity (got {table.gravity_angle!r})")
    if table.acceleration is not None:
        if table.gravity is not None:
            raise InputError(
                f"impact.acceleration = {table.acceleration!r} and impact.gravity = {table.gravity!r} say the same "
                "thing: give one of them"
            )
        return table.acceleration
    pull = gravity * math.cos(math.radians(table.gravity_angle))
    force = beam["axial_force"]
    if not gravity and not force:
        return 0.0
    bent = beam["bending_stiffness"] * table.fourth_derivative + force * beam["curvature"]
    return float(pull - bent / beam["mass_per_length"])
