"""The tables of a case file with fixed fields; :mod:`bent_beam.description` says what they describe.

A beam may be described as its owner knows it. One way or the other, never both: two ways to say the same thing clash,
and the error names them. A load, or a place, that has no key of its own is a key of ``[impact]`` by its field's name.
"""

import dataclasses
import re
from dataclasses import dataclass
from typing import Annotated, ClassVar, get_type_hints

from bent_beam.fields import Part, Quantity, declared
from bent_beam.impact import Impact
from bent_beam.loads import loads_of, places_of

MODELS = ("timoshenko", "euler_bernoulli")


def of_impact(name: str, **changes: str) -> Quantity:
    """The quantity of a field of ``Impact``, with some of its words changed."""
    return dataclasses.replace(declared(Impact)[name].quantity, **changes)  # type: ignore[arg-type]


@dataclass(frozen=True, kw_only=True)
class BeamTable(Part):
    """The beam: its stiffness and mass (or a ``[section]``), its length, its bow, what acts along it, its damping."""

    where: ClassVar[str] = "beam"

    bending_stiffness: Annotated[float | None, of_impact("bending_stiffness", text="EI; or a [section]")] = None
    mass_per_length: Annotated[float | None, of_impact("mass_per_length", text="μ; or a [section]")] = None
    length: Annotated[float, of_impact("length")]
    curvature: Annotated[float | None, of_impact("curvature")] = None
    sagitta: Annotated[float | None, Quantity("m", "the bow as its height over sagitta_length", above=0.0)] = None
    sagitta_length: Annotated[
        float | None, Quantity("m", "chord under the sagitta; the whole beam unless given", above=0.0)
    ] = None
    dogleg: Annotated[float | None, Quantity("°/30 m", "the bow as its dogleg severity", above=0.0)] = None
    natural_curvature: Annotated[float | None, of_impact("natural_curvature")] = None
    section_height: Annotated[float | None, of_impact("section_height")] = None
    model: Annotated[
        str | None, Quantity("", "whether shear counts", choices=MODELS, absent="with a shear stiffness timoshenko")
    ] = None
    shear_stiffness: Annotated[float | None, of_impact("shear_stiffness", text="κ_sGA; or a [section]")] = None
    rotary_inertia: Annotated[float | None, of_impact("rotary_inertia", text="ρI; or a [section]", absent="0")] = None
    axial_force: Annotated[float, of_impact("axial_force")] = 0.0
    tension_direction: Annotated[str | None, of_impact("tension_direction")] = None
    damping: Annotated[float | None, of_impact("damping")] = None
    damping_ratio: Annotated[
        float | None, Quantity("1", "the same as damping ratio of the first free–free bending mode", least=0.0)
    ] = None
    loss_factor: Annotated[float | None, Quantity("1", "damping as a loss factor at loss_frequency", least=0.0)] = None
    hysteretic_loss: Annotated[float | None, of_impact("hysteretic_loss")] = None
    loss_frequency: Annotated[
        float | None, Quantity("Hz", "where loss_factor or hysteretic_loss was measured", above=0.0)
    ] = None
    ends: Annotated[
        str | tuple[str, str], Quantity("", "free, hinged or clamped; a pair for the left and the right one")
    ] = "free"


@dataclass(frozen=True, kw_only=True)
class _ImpactTable(Part):
    """How the beam arrives, and what acts on it."""

    where: ClassVar[str] = "impact"

    velocity: Annotated[float | None, of_impact("velocity")] = None
    drop_height: Annotated[
        float | None,
        Quantity(
            "m", "fallen from rest along the wall's normal, instead of the velocity: V₀ = √(2gh cos θ)", above=0.0
        ),
    ] = None
    angular_speed: Annotated[
        float | None, Quantity("rad/s", "swinging about its hinge, or on arms, instead of the velocity", above=0.0)
    ] = None
    angular_arm: Annotated[
        float | None, Quantity("m", "of the arms on which a free beam swings without turning", above=0.0)
    ] = None
    amplitude: Annotated[
        float | None, Quantity("m", "vibrating at frequency, instead of the velocity: V₀ = 2πfA", above=0.0)
    ] = None
    frequency: Annotated[float | None, Quantity("Hz", "of the vibration with this amplitude", above=0.0)] = None
    gravity: Annotated[float | None, Quantity("m/s²", "g; 9.80665 where a drop height is given", least=0.0)] = None
    gravity_angle: Annotated[
        float,
        Quantity("°", "between gravity and the normal into the wall: 0 floor, 90 upright wall", least=0.0, most=180.0),
    ] = 0.0
    acceleration: Annotated[float | None, of_impact("acceleration")] = None
    first_touch: Annotated[float, of_impact("first_touch")] = 0.0


@dataclass(frozen=True, kw_only=True)
class WallTable(Part):
    """The wall: flat, rigid, and all along the beam unless said otherwise."""

    where: ClassVar[str] = "wall"

    curvature: Annotated[float, of_impact("wall_curvature")] = 0.0
    opposite: Annotated[float | None, of_impact("opposite_wall")] = None
    clearance: Annotated[float, of_impact("wall_clearance")] = 0.0
    stiffness: Annotated[float | None, of_impact("wall_stiffness")] = None
    damping: Annotated[float | None, of_impact("wall_damping")] = None
    damping_ratio: Annotated[float | None, Quantity("1", "the same as ζ = c/(2√(kμ))", least=0.0)] = None
    from_: Annotated[float | None, of_impact("wall_from")] = None
    to: Annotated[float | None, of_impact("wall_to")] = None


@dataclass(frozen=True, kw_only=True)
class RunTable(Part):
    """How long the impact is followed."""

    where: ClassVar[str] = "run"

    end_time: Annotated[float | None, Quantity("s", "end of the run", above=0.0)] = None
    duration: Annotated[
        float | None, Quantity("t*", "the same in units of t*; 0.1, but 0.01 T* at most, unless given", above=0.0)
    ] = None


HINTS = get_type_hints(Impact, include_extras=True)
KEYS = {name: f"wall.{name.removeprefix('wall_')}" for name in declared(Impact) if name.startswith("wall_")}
KEYS |= {"opposite_wall": "wall.opposite", "left_end": "beam.ends (left)", "right_end": "beam.ends (right)"}
OF_TABLES = {*KEYS, *declared(BeamTable), *declared(_ImpactTable)}
AS_THEY_ARE = [name for name in (*loads_of(Impact), *places_of(Impact)) if name not in OF_TABLES]
ImpactTable: type[_ImpactTable] = dataclasses.make_dataclass(
    "ImpactTable",
    [(name, HINTS[name], dataclasses.field(default=getattr(Impact, name))) for name in AS_THEY_ARE],
    bases=(_ImpactTable,), frozen=True, kw_only=True,
)  # fmt: skip

WAYS: dict[str, tuple[dict[str, tuple[str, ...]], ...]] = {
    "beam": (
        {"curvature": (), "sagitta": ("sagitta_length",), "dogleg": ()},
        {"damping": (), "damping_ratio": ()} | dict.fromkeys(("loss_factor", "hysteretic_loss"), ("loss_frequency",)),
    ),
    "impact": (
        {"velocity": (), "drop_height": (), "angular_speed": ("angular_arm",), "amplitude": ("frequency",)},
        {"acceleration": (), "gravity": ("gravity_angle",)},
    ),
    "wall": ({"damping": (), "damping_ratio": ()},),
    "run": ({"end_time": (), "duration": ()},),
    "section": ({"inner_diameter": (), "wall_thickness": ()},),
}
"""Keys that say the same thing, each with those that only belong to it: one that is laid over a case replaces the
others."""
OWN = re.compile(rf"(?<![\w./-])(?:{'|'.join(KEYS)})\b(?![/-]|\.\w)")  # not in the name of a file

TABLES: dict[str, type[Part]] = {"beam": BeamTable, "impact": ImpactTable, "wall": WallTable, "run": RunTable}
"""Tables with fixed fields; ``[section]`` and ``[mesh]`` have a kind."""


def in_keys(text: str) -> str:
    """A sentence about fields of ``Impact`` with the keys of a case file in place of those that are called otherwise.

    >>> in_keys("wall_from is not modelled by this method (got 0.1)")
    'wall.from is not modelled by this method (got 0.1)'
    """
    return OWN.sub(lambda found: KEYS[found[0]], text)
