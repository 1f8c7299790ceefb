"""Cross-sections as a catalogue gives them: dimensions and material → EI, μ, section modulus.

I is the second moment of area about the axis of bending, W = I/(h/2) the section modulus, h the height in the plane of
bending, i = √(I/A) the radius of gyration.

A further kind is a class here and its line of ``SECTIONS``. ``new_case.py`` has a line of each kind, the predictor's
``beam.js`` and ``case.js`` have those that the page knows.
"""

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Annotated, ClassVar

from bent_beam.errors import InputError
from bent_beam.fields import Part, Quantity


@dataclass(frozen=True, kw_only=True)
class Section(Part, ABC):
    """What all sections have."""

    where: ClassVar[str] = "section"

    youngs_modulus: Annotated[float, Quantity("Pa", "E", above=0.0)]
    density: Annotated[float, Quantity("kg/m³", "of the material", above=0.0)]
    yield_stress: Annotated[float | None, Quantity("Pa", "limit for the largest stress", above=0.0, absent="-")] = None
    added_mass: Annotated[float, Quantity("kg/m", "outer mass moving with the beam (mud, cladding)", least=0.0)] = 0.0

    @property
    @abstractmethod
    def area(self) -> float:
        """A of the material, m²."""

    @property
    @abstractmethod
    def second_moment(self) -> float:
        """I, m⁴."""

    @property
    @abstractmethod
    def height(self) -> float:
        """h, m."""

    @property
    def shear_stiffness(self) -> float | None:
        """κ_s G A, N; ``None`` where κ_s is not known."""
        return None

    @property
    def bending_stiffness(self) -> float:
        """EI, N m²."""
        return self.youngs_modulus * self.second_moment

    @property
    def mass_per_length(self) -> float:
        """μ with what moves along, kg/m."""
        return self.density * self.area + self.added_mass

    @property
    def rotary_inertia(self) -> float:
        """ρI of the material, kg m."""
        return self.density * self.second_moment

    @property
    def section_modulus(self) -> float:
        """W, m³."""
        return self.second_moment / (self.height / 2.0)

    @property
    def radius_of_gyration(self) -> float:
        """i, m."""
        return math.sqrt(self.second_moment / self.area)

    def stress(self, moment: float, axial_force: float = 0.0) -> float:
        """Largest normal stress |M|/W + |N|/A, Pa, of a bending moment (N m) and an axial force (N)."""
        return abs(moment) / self.section_modulus + abs(axial_force) / self.area


@dataclass(frozen=True, kw_only=True)
class _Shaped(Section, ABC):
    """A section whose shape says how it shears."""

    poisson_ratio: Annotated[float, Quantity("", "for shear", least=-0.99, most=0.5)] = 0.3

    @property
    @abstractmethod
    def shear_coefficient(self) -> float:
        """κ_s of Timoshenko's beam (Cowper 1966, J. Appl. Mech. 33, 335)."""

    @property
    def shear_stiffness(self) -> float:
        return self.shear_coefficient * self.youngs_modulus / (2.0 * (1.0 + self.poisson_ratio)) * self.area


@dataclass(frozen=True, kw_only=True)
class _Round(_Shaped, ABC):
    """A round section of diameter ``height``."""

    @property
    def bore(self) -> float:
        """Inner diameter, m: nothing of a solid one."""
        return 0.0

    @property
    def area(self) -> float:
        return math.pi / 4.0 * (self.height**2 - self.bore**2)

    @property
    def second_moment(self) -> float:
        return math.pi / 64.0 * (self.height**4 - self.bore**4)

    @property
    def shear_coefficient(self) -> float:
        n, square = self.poisson_ratio, (self.bore / self.height) ** 2
        rim = (1.0 + square) ** 2
        return 6.0 * (1.0 + n) * rim / ((7.0 + 6.0 * n) * rim + (20.0 + 12.0 * n) * square)


@dataclass(frozen=True, kw_only=True)
class Pipe(_Round):
    """A pipe."""

    outer_diameter: Annotated[float, Quantity("m", "", above=0.0)]
    inner_diameter: Annotated[float | None, Quantity("m", "or wall_thickness", least=0.0, absent="-")] = None
    wall_thickness: Annotated[float | None, Quantity("m", "or inner_diameter", above=0.0, absent="-")] = None
    fluid_density: Annotated[float, Quantity("kg/m³", "density of the contents", least=0.0)] = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        outer = self.outer_diameter
        if (self.inner_diameter is None) == (self.wall_thickness is None):
            raise InputError(
                "section.inner_diameter and section.wall_thickness say the same: give one of them "
                f"(got {self.inner_diameter!r} and {self.wall_thickness!r})"
            )
        if self.wall_thickness is not None:
            if self.wall_thickness >= outer / 2.0:
                raise InputError(
                    f"section.wall_thickness must be less than half the outer diameter {outer!r}, or the walls "
                    f"cross (got {self.wall_thickness!r})"
                )
        elif (self.inner_diameter or 0.0) >= outer:
            raise InputError(
                f"section.inner_diameter must be less than the outer diameter {outer!r}, or the walls cross "
                f"(got {self.inner_diameter!r})"
            )

    @property
    def bore(self) -> float:
        if self.wall_thickness is not None:
            return self.outer_diameter - 2.0 * self.wall_thickness
        return self.inner_diameter or 0.0

    @property
    def height(self) -> float:
        return self.outer_diameter

    @property
    def mass_per_length(self) -> float:
        return super().mass_per_length + self.fluid_density * math.pi / 4.0 * self.bore**2


@dataclass(frozen=True, kw_only=True)
class RoundBar(_Round):
    """A solid round bar."""

    diameter: Annotated[float, Quantity("m", "", above=0.0)]

    @property
    def height(self) -> float:
        return self.diameter


@dataclass(frozen=True, kw_only=True)
class Rectangle(_Shaped):
    """A rectangle."""

    width: Annotated[float, Quantity("m", "", above=0.0)]
    thickness: Annotated[float, Quantity("m", "in the plane of bending", above=0.0)]

    @property
    def area(self) -> float:
        return self.width * self.thickness

    @property
    def second_moment(self) -> float:
        return self.width * self.thickness**3 / 12.0

    @property
    def height(self) -> float:
        return self.thickness

    @property
    def shear_coefficient(self) -> float:
        return 10.0 * (1.0 + self.poisson_ratio) / (12.0 + 11.0 * self.poisson_ratio)


@dataclass(frozen=True, kw_only=True)
class General(Section):
    """Any section by its properties, as a catalogue of rails gives them."""

    area_of_section: Annotated[float, Quantity("m²", "A", above=0.0)]
    second_moment_of_area: Annotated[float, Quantity("m⁴", "I", above=0.0)]
    section_height: Annotated[float, Quantity("m", "twice the distance of the outermost fibre", above=0.0)]

    @property
    def area(self) -> float:
        return self.area_of_section

    @property
    def second_moment(self) -> float:
        return self.second_moment_of_area

    @property
    def height(self) -> float:
        return self.section_height


SECTIONS: dict[str, type] = {"pipe": Pipe, "round_bar": RoundBar, "rectangle": Rectangle, "general": General}
"""Kinds of a case file's ``[section]`` table."""
