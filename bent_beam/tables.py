"""The tables of a case file: every field with its unit, default and range; ``bentbeam settings`` prints them."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, ConfigDict, Field

__all__ = ["TABLES", "BeamTable", "CaseFile", "ImpactTable", "RunTable", "WallTable"]


def number(unit: str, text: str, *, default: Any = ..., **bounds: Any) -> Any:
    """A finite number with its unit and meaning."""
    return Field(
        default, allow_inf_nan=False, strict=True, description=text, json_schema_extra={"unit": unit}, **bounds
    )


class Table(BaseModel):
    """Base: unknown keys are errors."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class BeamTable(Table):
    """The beam: its stiffness and mass (or a ``[section]``), its length, its bow, what acts along it, its damping."""

    bending_stiffness: float | None = number("N m²", "EI; or a [section]", gt=0, default=None)
    mass_per_length: float | None = number("kg/m", "μ; or a [section]", gt=0, default=None)
    length: float = number("m", "L of the whole beam", gt=0)
    curvature: float | None = number("1/m", "K, the bow at the first touch", ge=0, default=None)
    sagitta: float | None = number("m", "the bow as its height over sagitta_length", gt=0, default=None)
    sagitta_length: float | None = number(
        "m", "chord under the sagitta; the whole beam unless given", gt=0, default=None
    )
    dogleg: float | None = number("°/30 m", "the bow as its dogleg severity", gt=0, default=None)
    natural_curvature: float | None = number(
        "1/m", "curvature of the beam free of stress; all of the bow unless given", default=None
    )
    section_height: float | None = number(
        "m", "d, for EA = 12 EI/d² on the Exudyn path; from the [section]", gt=0, default=None
    )
    axial_force: float = number("N", "N, tension positive", default=0.0)
    damping: float | None = number("s", "η, Kelvin–Voigt damping of the beam's own material", ge=0, default=None)
    damping_ratio: float | None = number(
        "1", "the same as damping ratio of the first free–free bending mode", ge=0, default=None
    )
    loss_factor: float | None = number("1", "the same as loss factor at loss_frequency", ge=0, default=None)
    loss_frequency: float | None = number("Hz", "where the loss factor was measured", gt=0, default=None)


class ImpactTable(Table):
    """How the beam arrives, and what acts on it."""

    velocity: float | None = number("m/s", "V₀ towards the wall", gt=0, default=None)
    drop_height: float | None = number(
        "m", "fallen from rest, instead of the velocity: V₀ = √(2gh)", gt=0, default=None
    )
    angular_speed: float | None = number(
        "rad/s", "swinging about a pivot angular_arm away, instead of the velocity", gt=0, default=None
    )
    angular_arm: float | None = number(
        "m", "from the pivot to the first touch; half the length unless given", gt=0, default=None
    )
    gravity: float | None = number("m/s²", "g; 9.80665 where a drop height is given", ge=0, default=None)
    gravity_angle: float = number(
        "°", "between gravity and the normal into the wall: 0 floor, 90 upright wall", ge=0, le=180, default=0.0
    )
    acceleration: float | None = number("m/s²", "a₀ at the first touch; free flight unless given", default=None)
    curvature_rate: float = number("1/(m s)", "c₀ = ∂³y₀/∂x²∂t", default=0.0)
    fourth_derivative: float = number("1/m³", "q₀ = ∂⁴y₀/∂x⁴", default=0.0)
    rotation: float = number("rad/s", "rocking about the middle (runs of the full beam)", default=0.0)
    first_touch: float = number("m", "place of the bow's apex from the middle (runs of the full beam)", default=0.0)


class WallTable(Table):
    """The wall, flat unless said otherwise."""

    curvature: float = number("1/m", "K_w, positive where the wall is hollow", default=0.0)
    opposite: float | None = number("m", "distance of a second wall behind the bow's apex", gt=0, default=None)


class RunTable(Table):
    """How long the impact is followed."""

    end_time: float | None = number("s", "end of the run", gt=0, default=None)
    duration: float | None = number(
        "t*", "the same in units of t*; 0.1, but 0.01 T* at most, unless given", gt=0, default=None
    )


class CaseFile(Table):
    """A whole case file; further tables belong to the installed paths."""

    model_config = ConfigDict(extra="allow", frozen=True)

    title: str = ""
    beam: BeamTable
    section: dict[str, Any] = Field(default_factory=dict)
    impact: ImpactTable
    wall: WallTable = WallTable()
    run: RunTable = RunTable()
    mesh: dict[str, Any] = Field(default_factory=dict)


TABLES: dict[str, type[Table]] = {"beam": BeamTable, "impact": ImpactTable, "wall": WallTable, "run": RunTable}
"""Tables with fixed fields; ``[section]`` and ``[mesh]`` have a kind."""
