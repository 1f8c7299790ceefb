"""What a reader should know of a case itself, whatever is computed for it; and of a run by its energies at the end: one
account for every door."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from bent_beam import Impact, ImpactHistory
from bent_beam.files import LOSSES
from bent_beam.hysteresis import first_mode
from bent_beam.loads import unmodelled
from bent_beam.measure.numbers import MISSING
from bent_beam.section import Section
from comparison.readable import with_bar
from comparison.whole_numbers import WHOLE

Energies = Mapping[str, float | None]

LIGHTEST = {"youngs_modulus": (1e5, "Pa"), "density": (5.0, "kg/m³")}  # of materials, and units
SOUND = (9.0, 30e3)  # m/s, √(E/ρ): soft rubber has 30, diamond 18 000; MPa for Pa makes 5 of steel, g/cm³ 160 000
STRETCHED = 0.05  # |N|/EA, from which no material of a section is linear
STUBBY = 15.0  # radii of gyration: some four depths
OVERDAMPED = 0.5  # of the first mode, from which a damping ratio is no material's
SUNK = 0.1  # of the beam's length: how far it sinks into a soft wall, from which the wall's unit deserves a doubt
STEEP = 0.3  # slope of the bow at the beam's ends from which the small-slope theory deserves a warning
ACROSS = 0.01  # |N|/κ_sGA, likewise
STRAIGHTENED = 0.1  # N L²/(π² EI) of either sign, from which an axial force deserves one
NOTABLE_LOSS = 0.02  # of the initial energy, likewise
WIDE, LEAST_RESTITUTION = 0.1, 0.3  # of a number, an error bar, likewise; a smaller restitution counts as this
MAY_BE_WIDE = {name: WHOLE[name].title for name in ("restitution", "impulse", "peak_moment", "peak_force")}
MAY_BE_WIDE |= {"half_contact_length": "half contact length"}


def doubts(impact: Impact, section: Section | None) -> list[str]:
    """Sentences on steep bows, straight beams, bows that an axial force straightens or bends, and what a stress
    includes."""
    found = []
    slope = impact.relative_curvature * impact.half_length
    if slope >= STEEP and not _has_no_size(impact):
        found.append(
            f"the bow's own slope at its ends is {slope:.2g}: theory and simulation are for small slopes (at 0.5 the "
            "force is about 10 % larger)"
        )
    found += [] if section is None else _of_section(impact, section)
    radius = section.radius_of_gyration if section else math.sqrt(impact.rotary_inertia / impact.mass_per_length)
    if impact.length < STUBBY * radius:
        found.append(
            f"the beam is only {impact.length / radius:.2g} radii of gyration long, and these numbers are for slender "
            "beams; are the sizes of the section in m?"
        )
    ratio = math.pi * impact.damping * first_mode(impact)
    if ratio >= OVERDAMPED and not _has_no_size(impact):
        found.append(f"the material damps the first mode with a ratio of {ratio:.2g}: is it meant in percent?")
    begin, end = impact.wall_span
    ratio = impact.wall_damping_ratio
    if begin < end and ratio > 1.0 and not _has_no_size(impact):
        found.append(f"the wall's damping ratio is {ratio:.3g}, beyond critical (a ratio is not in percent)")
    sunk = impact.velocity * math.sqrt(impact.mass_per_length / (impact.wall_stiffness or math.inf))  # of a stiff beam
    if begin < end and sunk > SUNK * impact.length and not _has_no_size(impact):
        found.append(
            f"the wall gives way by some {sunk:.2g} m, the beam is {impact.length:g} m long: is wall.stiffness in N/m²?"
        )
    if impact.relative_curvature == 0.0 and not impact.wall_in_part and impact.wall_stiffness is None:
        found.append(
            "a straight beam touches a rigid wall with its whole length at once: its rebound is that of the contact "
            "law, from 0 to 1, not of the beam; give it a bow, or the wall a stiffness"
        )
    if impact.opposite_wall is not None and impact.wall_curvature:
        found.append("the second wall is flat and the first one curved: their distance varies along the beam")
    force, pull = impact.axial_force, impact.axial_force / impact.buckling_load
    free = impact.unbent_curvature == impact.curvature and not impact.supported
    if abs(pull) > STRAIGHTENED and impact.curvature and impact.tension_direction == "axis" and free:
        does = "tension, which straightens it" if pull > 0.0 else "compression, which bends it further"
        at_rest = f" (at rest to about {float(f'{100.0 / (1.0 + pull):.2g}'):g} % of its height)" if pull > -1.0 else ""
        found.append(
            f"the bow is free of stress and not in equilibrium under the {does}{at_rest}; where other forces hold it, "
            'give beam.tension_direction = "tangent" and impact.acceleration = 0'
        )
    if impact.shear_stiffness and abs(force) > ACROSS * impact.shear_stiffness:
        found.append(
            f"the axial force is {abs(force) / impact.shear_stiffness:.2g} of the shear stiffness: whether it acts "
            "along the axis (hermite) or across the sections (exudyn) changes answers by that order"
        )
    if force and section is not None:
        found.append(f"stresses include |N|/A = {1e-6 * section.stress(0.0, force):.4g} MPa of the axial force")
    return found


def _of_section(impact: Impact, section: Section) -> list[str]:
    """Of its material, of what an axial force does to it, and of what weighs."""
    found = [
        f"section.{name} = {value:g} {unit} is less than of any foam: is it in {unit}?"
        for name, (least, unit) in LIGHTEST.items()
        if (value := getattr(section, name)) < least
    ]
    speed, (least, most) = math.sqrt(section.youngs_modulus / section.density), SOUND
    if not found and not least <= speed <= most:
        found.append(
            f"section.youngs_modulus = {section.youngs_modulus:g} and section.density = {section.density:g} make a "
            f"speed of sound of {speed:.3g} m/s, which no material has: are they in Pa and kg/m³?"
        )
    strain = section.stress(0.0, impact.axial_force) / section.youngs_modulus
    if not found and strain > STRETCHED:
        found.append(f"beam.axial_force = {impact.axial_force:g} N strains the section by {strain:.2g}: is it in N?")
    if section.added_mass and impact.acceleration and impact.uniform_pressure:  # an axial force on a bow has a₀, too
        found.append(
            f"all of the mass weighs, section.added_mass = {section.added_mass:g} kg/m included, and no buoyancy is "
            "taken off (a gravity that does so: docs/guide/problems.md, a beam in a fluid)"
        )
    return found


def steep(history: ImpactHistory) -> list[str]:
    """A sentence on slopes of the motion beyond the theory of small ones; they may grow where an axial force presses a
    beam that turns."""
    name = "angle" if "angle" in history else "slope"
    if name not in history or _has_no_size(history.impact):
        return []
    slopes = np.abs(history.array(name))
    largest = float(slopes.max(initial=0.0))
    if largest < STEEP or largest < 1.1 * float(slopes[0].max(initial=0.0)):  # of the bow itself
        return []
    when = float(history.time[int(np.argmax(slopes.max(axis=1) >= STEEP))])
    since = f" ({STEEP:g} at {when:.3g} s)" if when else ""
    return [f"slopes of the motion reach {largest:.2g}{since}: simulation is for small slopes"]


def _has_no_size(impact: Impact) -> bool:
    """In units EI = μ = V₀ = 1 the amplitude is free."""
    return impact.bending_stiffness == impact.mass_per_length == impact.velocity == 1.0


def comparable(impact: Impact) -> bool:
    """Whether the theory has an answer at all: a bow, symmetric about its first touch, before a wall that it knows."""
    from theory.prediction import MODELLED  # SciPy

    return impact.relative_curvature > 0.0 and not impact.off_centre and unmodelled(impact, MODELLED) is None


def energy_at_end(history: ImpactHistory, until: float | None = None) -> dict[str, float | None]:
    """The energies at the end, or at ``until``, s, in J, what was lost by cause, and the defect that these leave."""
    budget = history.energy_budget(until)
    return {
        "initial": budget["initial_energy"],
        "kinetic": float(history.array("kinetic_energy")[0]) + budget["kinetic_energy"],
        "strain": float(history.array("strain_energy")[0]) + budget["strain_energy"],
        "wall": budget.get("contact_energy"),
        **{name: budget.get(name) for name in ("work_of_loads", *LOSSES)},
        "defect": budget["defect"],
    }


def numerical_loss(energy: Energies) -> float:
    """Share of the initial energy that the scheme, the mesh and its viscosity took: what is booked for them, and what
    is missing without being booked at all."""
    booked = sum(energy[name] or 0.0 for name in ("loss_algorithmic", "loss_viscous"))
    return (booked + max(-(energy["defect"] or 0.0), 0.0)) / (energy["initial"] or 1.0)


def energy_residual(energy: Energies) -> float:
    """What the terms of the budget leave, over the initial energy and the work of the loads."""
    return abs(energy["defect"] or 0.0) / ((energy["initial"] or 1.0) + abs(energy["work_of_loads"] or 0.0))


def loss_warnings(energy: Energies) -> list[str]:
    """A warning where :func:`numerical_loss` is notable."""
    share = numerical_loss(energy)
    if abs(share) < NOTABLE_LOSS:
        return []
    did = "took" if share > 0.0 else "gave"
    return [f"steps, mesh and grid viscosity {did} {100.0 * abs(share):.2g} % of the initial energy"]


def yields(numbers: Mapping[str, Any], section: Section | None) -> bool | None:
    """Whether the largest stress among ``numbers``, SI, is beyond the section's yield stress (``None`` where either
    is not known)."""
    found, limit = with_bar(numbers.get("peak_stress", MISSING))[0], getattr(section, "yield_stress", None)
    return None if limit is None or found is None else found > limit


def told_by(numbers: Mapping[str, Any], section: Section | None) -> list[str]:
    """What ``numbers``, SI, say themselves: which bars are wide, and whether the beam yields or may, by its bar."""
    found, beyond = wide_bars(numbers), yields(numbers, section)
    if section is None or beyond is None:
        return found
    (stress, bar), limit = with_bar(numbers["peak_stress"]), section.yield_stress or 0.0
    if beyond or (stress or 0.0) + bar > limit:
        found.append(
            f"the largest stress {'is' if beyond else 'may be'} beyond the yield stress of {1e-6 * limit:.4g} MPa: all "
            "numbers are those of an elastic beam"
        )
    return found


def wide_bars(numbers: Mapping[str, Any]) -> list[str]:
    """A warning of the numbers whose error bars are wide; a band is none, nor is a half length of 0, of one point."""
    wide = []
    for name, title in MAY_BE_WIDE.items():
        number, least = numbers.get(name, MISSING), LEAST_RESTITUTION if name == "restitution" else 0.0
        known = number.value is not None and not (name == "half_contact_length" and number.value == 0.0)
        if known and (number.bar or 0.0) > WIDE * max(abs(number.value), least):
            wide.append(title)
    return [f"wide error bars: {', '.join(wide)}; elements, steps and contact law decide here"] if wide else []
