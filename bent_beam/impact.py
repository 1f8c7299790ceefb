"""The physical problem: a naturally bent beam arriving at a wall.

    μ y_tt + EI(y_xxxx + η y_txxxx) − N y_xx = p − r,     0 ≤ r ⊥ g = y_w − y ≥ 0         (thesis 2.1.1–2; N, η added)

That is Euler and Bernoulli's beam. With a shear stiffness S = κ_sGA it is Timoshenko's, φ the turning of its sections
and J their rotary inertia (Timoshenko 1921, Philos. Mag. 41, 744; docs/shear.md):

    μ y_tt − S[(y_x − φ) + η(y_x − φ)_t]_x − N y_xx = p − r,     J φ_tt = EI(φ + ηφ_t)_xx + S[(y_x − φ) + η(y_x − φ)_t]

y > 0 points into the wall y_w = −K_w x²/2; x = 0 touches first, at t = 0. The free motion close to the contact is

    y₀ = V₀ t − K x²/2 + a₀ t²/2 + c₀ x² t/2 + q₀ x⁴/24.                      (thesis 2.2.30; bent_beam/loads.py)
"""

from __future__ import annotations

import dataclasses
from typing import Annotated, Any

from bent_beam.checks import check_arrangement, check_scales, non_negative, positive
from bent_beam.errors import InputError
from bent_beam.fields import Part, Quantity
from bent_beam.hysteresis import check_loss
from bent_beam.loads import ENDS, SIMULATED, UNSHEARED, Feature, Load, loads_of
from bent_beam.scales import Scales

__all__ = ["Impact"]

LONGEST = 1e30  # time, and change of the free motion by the loads, in the problem's own units
FIRST_SPREAD = 0.005  # T*: until then waves from the ends change the impulse by 1 % at most, of flat contacts by more
BEFORE_WAVES_RETURN = 0.01  # T*: the earliest that they change the impulse by 2 %


@dataclasses.dataclass(frozen=True)
class Impact(Part, Scales):
    """A bent beam about to hit a wall (SI units); free, rigid and symmetric about x = 0 unless said otherwise.

    Units, meanings and ranges of the fields stand at the fields. Raises ``ValueError`` naming field and value.

    >>> from bent_beam import Impact
    >>> pipe = Impact(bending_stiffness=1.224e6, mass_per_length=29.02, length=90.0, curvature=0.002, velocity=2.0)
    >>> round(pipe.kappa_over_nu, 3)
    0.205
    """

    bending_stiffness: Annotated[float, Quantity("N m²", "EI", above=0.0)]
    mass_per_length: Annotated[float, Quantity("kg/m", "μ", above=0.0)]
    length: Annotated[float, Quantity("m", "L of the whole beam", above=0.0)]
    curvature: Annotated[float, Quantity("1/m", "K, the bow at the first touch", least=0.0)]
    velocity: Annotated[float, Quantity("m/s", "V₀ towards the wall", above=0.0)]
    acceleration: Annotated[
        float, Load("m/s²", "a₀ at the first touch; free flight unless given", group="alpha", powers=(0, 2))
    ] = 0.0
    curvature_rate: Annotated[float, Load("1/(m s)", "c₀ = ∂³y₀/∂x²∂t", group="chi", powers=(2, 1))] = 0.0
    fourth_derivative: Annotated[float, Load("1/m³", "q₀ = ∂⁴y₀/∂x⁴", group="psi", powers=(4, 0))] = 0.0
    section_height: Annotated[
        float, Quantity("m", "d, for EA = 12 EI/d² on the Exudyn path; from the [section]", above=0.0)
    ] = 0.01
    shear_stiffness: Annotated[
        float | None, Feature("N", "κ_sGA of Timoshenko's beam; Euler and Bernoulli's without", above=0.0,
                              instead=UNSHEARED)] = None  # fmt: skip
    rotary_inertia: Annotated[float, Quantity("kg m", "J = ρI of a section, next to shear_stiffness", least=0.0)] = 0.0
    axial_force: Annotated[float, Load("N", "N, tension positive", group="axial")] = 0.0
    tension_direction: Annotated[
        str,
        Quantity("", "of the axial force at the ends: along x, or along the bow's ends", choices=("axis", "tangent")),
    ] = "axis"
    damping: Annotated[float, Quantity("s", "η, Kelvin–Voigt damping of the beam's own material", least=0.0)] = 0.0
    hysteretic_loss: Annotated[
        float, Feature("1", "loss factor of the material, nearly that of all frequencies", least=0.0, most=1.0,
                       instead=": take the Hermite path, or damping in its place")] = 0.0  # fmt: skip
    loss_frequency: Annotated[float | None, Quantity("Hz", "where EI and hysteretic_loss hold", above=0.0)] = None
    wall_curvature: Annotated[float, Quantity("1/m", "K_w, positive where the wall is concave; less than K")] = 0.0
    natural_curvature: Annotated[float | None, Quantity("1/m", "stress-free K; the whole bow's unless given")] = None
    rotation: Annotated[float, Load("rad/s", "rocking about the middle (runs of the full beam)", powers=(1, 1))] = 0.0
    first_touch: Annotated[float, Quantity("m", "the bow's apex from the middle (runs of the full beam)")] = 0.0
    opposite_wall: Annotated[float | None, Quantity("m", "distance of a second wall behind the apex", above=0.0)] = None
    wall_stiffness: Annotated[
        float | None, Feature("N/m²", "k per length of beam, of a stop in N/m; rigid unless given", above=0.0)
    ] = None
    wall_damping: Annotated[
        float, Feature("N s/m²", "c beside k: the wall gives max(0, k p + c ṗ); of a stop in N s/m", least=0.0)
    ] = 0.0
    wall_clearance: Annotated[
        float, Feature("m", "of held ends: from the beam at rest to the wall in front, where a run then starts",
                       least=0.0, instead=": bentbeam simulate follows it, on the Hermite path")] = 0.0  # fmt: skip
    wall_from: Annotated[float | None, Feature("m", "where the wall begins, from the middle", instead=SIMULATED)] = None
    wall_to: Annotated[float | None, Feature("m", "where it ends; at wall_from: a stop", instead=SIMULATED)] = None
    left_end: Annotated[str, Feature("", "how the end at x = −L/2 is held", choices=ENDS, instead=SIMULATED)] = "free"
    right_end: Annotated[str, Feature("", "how the end at x = L/2 is held", choices=ENDS, instead=SIMULATED)] = "free"

    def __post_init__(self) -> None:
        super().__post_init__()
        check_arrangement(self)
        check_scales(self)
        check_loss(self)

    @classmethod
    def dimensionless(
        cls,
        kappa_over_nu: float,
        *,
        epsilon_alpha: float = 0.0,
        epsilon_psi: float = 0.0,
        epsilon_chi: float = 0.0,
        epsilon_axial: float = 0.0,
        damping: float = 0.0,
        length: float = 1e3,
    ) -> Impact:
        """The impact in units of the fast layer: EI = μ = V₀ = 1, so l* = t* = 1 and ν = 1. The beam stands for an
        infinite one, which goes on at its ends: an axial force follows the bow there."""
        return cls(
            bending_stiffness=1.0,
            mass_per_length=1.0,
            length=length,
            velocity=1.0,
            curvature=positive("kappa_over_nu", kappa_over_nu),
            acceleration=epsilon_alpha,
            fourth_derivative=epsilon_psi,
            curvature_rate=epsilon_chi,
            axial_force=epsilon_axial,
            tension_direction="tangent",
            damping=damping,
        )

    @classmethod
    def whole_beam(
        cls, kappa_over_nu: float, *, relative_damping: float = 0.0, shear_length: float = 0.0, shear_ratio: float = 0.0
    ) -> Impact:
        """The free–free beam in units of its half length: EI = μ = V₀ = L/2 = 1, so T* = 1; damping is η/T*,
        shear_length l_s over L/2 (0: Euler and Bernoulli's), shear_ratio κ_sG/E (:mod:`bent_beam.scales`)."""
        bare = cls.dimensionless(kappa_over_nu, damping=relative_damping, length=2.0).replace(tension_direction="axis")
        if shear_length == 0.0:
            return bare
        length = positive("shear_length", shear_length)
        return bare.replace(shear_stiffness=length**-2.0, rotary_inertia=shear_ratio * length**2)

    def replace(self, **changes: Any) -> Impact:
        """A copy with some fields changed, validated again."""
        return dataclasses.replace(self, **changes)

    @property
    def unsheared(self) -> Impact:
        """The same of Euler and Bernoulli's beam."""
        return self.replace(shear_stiffness=None, rotary_inertia=0.0)

    def checked_end_time(self, end_time: float | None = None) -> float:
        """``end_time`` (s) of a simulation, or ``ValueError`` when it is out of all proportion to t*. ``None``: 0.1 t*,
        the longest time that the thesis computes, but 0.01 T* at most: then waves come back from the ends and what is
        asked without a time, the first spread of the contact, is over."""
        if end_time is None:
            end_time = min(0.1 * self.time_scale, BEFORE_WAVES_RETURN * self.slow_time_scale)
        if positive("end_time", end_time) / self.time_scale < 1.0 / LONGEST:
            raise InputError(
                f"end_time must be at least {1 / LONGEST:g} t* (got {end_time!r}, t* = {self.time_scale!r} s)"
            )
        return self.checked_time("end_time", end_time)

    def checked_time(self, name: str, value: float) -> float:
        """A time (s) since impact, or ``ValueError`` when it, or what the loads do by then, is out of proportion."""
        time = non_negative(name, value) / self.time_scale
        if time > LONGEST:
            raise InputError(f"{name} must not exceed {LONGEST:g} t* (got {value!r}, t* = {self.time_scale!r} s)")
        for load in loads_of(Impact):
            given = getattr(self, load)
            if abs(self.group(load)) * time > LONGEST:
                raise InputError(f"{load} is out of all proportion to a time of {value:.6g} s (got {given!r})")
        return float(value)
