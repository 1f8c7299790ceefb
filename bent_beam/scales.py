"""The fields of an impact, its scales and dimensionless groups (docs/theory.md, 1; thesis 2.2.16, 2.2.46–48).

l* = √(EI/μ)/V₀,  t* = l*/V₀: the fast layer;     T* = √(μL*⁴/EI): free vibration;     ε = t*/T*
l_s = √(EI/κ_sGA),  t_s = √(EIμ)/κ_sGA: shear;     g = J κ_sGA/(EI μ): κ_sG/E without added mass
"""

import math
from dataclasses import dataclass
from typing import Annotated

from bent_beam.fields import Part, Quantity
from bent_beam.loads import ENDS, SIMULATED, UNSHEARED, Feature, FreeMotion, Load, Place, loads_of, places_of

GOES_ON = "; leave it out for a wall that goes on"


@dataclass(frozen=True)
class Scales(Part):
    """The fields of :class:`bent_beam.Impact` with their units, meanings and ranges, and what follows from them."""

    bending_stiffness: Annotated[float, Quantity("N m²", "EI", above=0.0)]
    mass_per_length: Annotated[float, Quantity("kg/m", "μ", above=0.0)]
    length: Annotated[float, Quantity("m", "L of the whole beam", above=0.0)]
    curvature: Annotated[float, Quantity("1/m", "K, the bow at the first touch", least=0.0)]
    velocity: Annotated[float, Quantity("m/s", "V₀ towards the wall", above=0.0)]
    acceleration: Annotated[
        float,
        Load("m/s²", "a₀ at the first touch; in a case file free flight unless given", group="alpha", powers=(0, 2)),
    ] = 0.0
    curvature_rate: Annotated[
        float, Load("1/(m s)", "c₀ = ∂³y₀/∂x²∂t; its moment does not act at free ends", group="chi", powers=(2, 1))
    ] = 0.0
    fourth_derivative: Annotated[
        float, Load("1/m³", "q₀ = ∂⁴y₀/∂x⁴; its moment does not act at free ends", group="psi", powers=(4, 0))
    ] = 0.0
    section_height: Annotated[
        float, Quantity("m", "d, for EA = 12 EI/d² on the Exudyn path; of a [section] √12 radii of gyration", above=0.0)
    ] = 0.01
    shear_stiffness: Annotated[
        float | None, Feature("N", "κ_sGA of Timoshenko's beam; Euler and Bernoulli's without", above=0.0,
                              instead=UNSHEARED)] = None  # fmt: skip
    rotary_inertia: Annotated[float, Quantity("kg m", "J = ρI of a section, next to shear_stiffness", least=0.0)] = 0.0
    axial_force: Annotated[float, Load("N", "N, tension positive", group="axial")] = 0.0
    tension_direction: Annotated[
        str,
        Quantity("", "where the axial force points at the ends: along x, or the bow", choices=("axis", "tangent")),
    ] = "axis"
    damping: Annotated[float, Quantity("s", "η, Kelvin–Voigt damping of the beam's own material", least=0.0)] = 0.0
    hysteretic_loss: Annotated[
        float, Feature("1", "damping by a loss factor nearly the same at all frequencies", least=0.0, most=1.0,
                       instead=": take the Hermite path, or damping in its place")] = 0.0  # fmt: skip
    loss_frequency: Annotated[float | None, Quantity("Hz", "where EI and hysteretic_loss hold", above=0.0)] = None
    wall_curvature: Annotated[float, Quantity("1/m", "K_w, positive where the wall is concave; less than K")] = 0.0
    natural_curvature: Annotated[
        float | None,
        Quantity("1/m", "curvature without stress, K unless given; moments at the ends hold the rest of K"),
    ] = None
    rotation: Annotated[float, Load("rad/s", "rocking about the middle (runs of the full beam)", powers=(1, 1))] = 0.0
    first_touch: Annotated[float, Quantity("m", "the bow's apex from the middle (runs of the full beam)")] = 0.0
    opposite_wall: Annotated[float | None, Quantity("m", "of a second, flat wall behind the apex", above=0.0)] = None
    wall_stiffness: Annotated[
        float | None, Feature("N/m²", "k per length of beam, of a stop in N/m; rigid unless given", above=0.0)
    ] = None
    wall_damping: Annotated[
        float, Feature("N s/m²", "c beside k: the wall gives max(0, k p + c ṗ); of a stop in N s/m", least=0.0)
    ] = 0.0
    wall_clearance: Annotated[
        float, Feature("m", "of held ends: from the beam at rest to the wall in front, where a run then starts",
                       least=0.0, instead=": bentbeam simulate follows it, on the Hermite path")] = 0.0  # fmt: skip
    wall_from: Annotated[
        float | None, Place("m", "where the wall begins, from the middle", instead=SIMULATED, outside=GOES_ON)
    ] = None
    wall_to: Annotated[
        float | None, Place("m", "where it ends; a stop where it equals from", instead=SIMULATED, outside=GOES_ON)
    ] = None
    left_end: Annotated[str, Feature("", "how the end at x = −L/2 is held", choices=ENDS, instead=SIMULATED)] = "free"
    right_end: Annotated[str, Feature("", "how the end at x = L/2 is held", choices=ENDS, instead=SIMULATED)] = "free"

    @property
    def wave_constant(self) -> float:
        """√(EI/μ), m²/s: bending waves spread as x² ~ √(EI/μ) t."""
        return math.sqrt(self.bending_stiffness / self.mass_per_length)

    @property
    def time_scale(self) -> float:
        """t* = √(EI/μ)/V₀², s: the time unit of the fast layer."""
        return self.wave_constant / self.velocity / self.velocity

    @property
    def length_scale(self) -> float:
        """l* = √(EI/μ)/V₀, m: the length unit of the fast layer."""
        return self.wave_constant / self.velocity

    @property
    def deflection_scale(self) -> float:
        """V₀ t*, m: the unit of the fast layer's deflection with ν = 1 (equal to l*)."""
        return self.velocity * self.time_scale

    @property
    def half_length(self) -> float:
        """L* = L/2, m."""
        return self.length / 2.0

    @property
    def slow_time_scale(self) -> float:
        """T* = √(μ L*⁴/EI), s: the time scale of the beam's free vibration (2.2.16)."""
        return self.half_length**2 / self.wave_constant

    @property
    def moment_scale(self) -> float:
        """V₀√(EIμ), N m: the bending moment of a beam that is stopped at a point."""
        return self.velocity * math.sqrt(self.bending_stiffness * self.mass_per_length)

    @property
    def buckling_load(self) -> float:
        """π²EI/L², N: of a hinged beam, of a free one at rest (Euler)."""
        return math.pi**2 * self.bending_stiffness / self.length**2

    @property
    def epsilon(self) -> float:
        """ε = t*/T*, dimensionless: the small parameter of the expansion."""
        return (self.length_scale / self.half_length) ** 2

    @property
    def model(self) -> str:
        """Which beam it is: "timoshenko" with a shear stiffness, else "euler_bernoulli"."""
        return "euler_bernoulli" if self.shear_stiffness is None else "timoshenko"

    @property
    def shear_length(self) -> float:
        """l_s = √(EI/κ_sGA), m: over about this length a force is taken up by shear; 0 without."""
        return 0.0 if self.shear_stiffness is None else math.sqrt(self.bending_stiffness / self.shear_stiffness)

    @property
    def shear_time(self) -> float:
        """t_s = √(EIμ)/κ_sGA, s, the time scale of shear; 0 without."""
        return self.shear_length**2 / self.wave_constant

    @property
    def shear_ratio(self) -> float:
        """g = J κ_sGA/(EI μ), dimensionless: the square of shear waves' speed over that of bending waves' fastest."""
        return self.rotary_inertia / self.mass_per_length / self.shear_length**2 if self.shear_length else 0.0

    @property
    def wall_damping_ratio(self) -> float:
        """ζ = c/(2√(kμ)) of a wall that gives way; 0 of a rigid one."""
        stiffness = self.wall_stiffness or math.inf
        return self.wall_damping / (2.0 * math.sqrt(stiffness * self.mass_per_length))

    def free_motion(self, bow: float) -> FreeMotion:
        """y₀ with −``bow`` x²/2 in place of −Kx²/2, SI units, x from the first touch."""
        terms = {about.powers: getattr(self, load) for load, about in loads_of(type(self)).items() if about.powers}
        return FreeMotion({(0, 1): self.velocity + self.rotation * self.first_touch, (2, 0): -bow, **terms})

    def group(self, load: str) -> float:
        """A load in units of the fast layer, dimensionless with ν = 1: its term of y₀, or a force over μV₀²."""
        value, powers = getattr(self, load), loads_of(type(self))[load].powers
        if powers is None:
            return value / (self.mass_per_length * self.velocity**2)
        i, j = powers  # V₀t* = l*
        return value * self.length_scale ** (i - 1) * self.time_scale**j

    @property
    def kappa_over_nu(self) -> float:
        """κ/ν = K √(EI/μ)/V₀: the one parameter of the leading order."""
        return self.relative_curvature * self.length_scale

    @property
    def unbent_curvature(self) -> float:
        """Curvature of the beam without stress: that of the whole bow unless ``natural_curvature`` says otherwise."""
        return self.curvature if self.natural_curvature is None else self.natural_curvature

    @property
    def relative_curvature(self) -> float:
        """K − K_w, 1/m: of the beam against the wall. Without axial force a curved wall does nothing else."""
        return self.curvature - self.wall_curvature

    def _load_against(self, curvature: float) -> float:
        """μa₀ + EI q₀ + N(K − ``curvature``), N/m; nothing where the terms cancel to rounding."""
        motion = self.free_motion(0.0)
        terms = (
            self.mass_per_length * float(motion(0.0, by_t=2)),
            self.bending_stiffness * float(motion(0.0, by_x=4)),
            self.axial_force * (self.curvature - curvature),
        )
        total = math.fsum(terms)
        return total if abs(total) > 1e-14 * max(abs(term) for term in terms) else 0.0

    @property
    def uniform_pressure(self) -> float:
        """p = μa₀ + EI q₀ + N K, N/m: the uniform load under which the free motion is y₀."""
        return self._load_against(0.0)

    @property
    def zone_pressure(self) -> float:
        """p − N K_w, N/m: what presses a contact zone that lies on the wall; it lifts off where this is negative."""
        return self._load_against(self.wall_curvature)

    @property
    def forces(self) -> list[tuple[float, float]]:
        """Forces at points: place, m from the middle, and force, N towards the wall, of each load in N with a place."""
        loads = {name: getattr(self, name) for name, about in loads_of(type(self)).items() if about.unit == "N"}
        places = ((getattr(self, name), loads.get(about.load)) for name, about in places_of(type(self)).items())
        return [(place, force) for place, force in places if force]

    @property
    def lifts(self) -> bool:
        """Whether a load lifts a contact zone off the wall."""
        return self.zone_pressure < 0.0 or any(force < 0.0 for _, force in self.forces)

    def load_within(self, half: float, power: int = 0) -> float:
        """∫xⁿp dx over |x| ≤ ``half`` from the middle, of all loads together, N mⁿ, for an even n = ``power``. An axial
        force along the tangents at the ends of the bow adds −NK to it."""
        pressure = self._load_against(self.curvature if self.tension_direction == "tangent" else 0.0)
        at_points = math.fsum(force * place**power for place, force in self.forces if abs(place) <= half * (1.0 + 1e-9))
        return pressure * 2.0 * half ** (power + 1) / (power + 1) + at_points

    @property
    def net_load(self) -> float:
        """Sum of all loads over L, N/m: μ times the acceleration of the centre of mass without a wall."""
        return self.load_within(self.half_length) / self.length

    @property
    def epsilon_alpha(self) -> float:
        """εα/ν = a₀ t*/V₀."""
        return self.group("acceleration")

    @property
    def epsilon_chi(self) -> float:
        """εχ/ν = c₀ l*²/V₀."""
        return self.group("curvature_rate")

    @property
    def epsilon_psi(self) -> float:
        """εψ/ν = q₀ l*⁴/(V₀ t*)."""
        return self.group("fourth_derivative")

    @property
    def epsilon_axial(self) -> float:
        """n = N/(μV₀²)."""
        return self.group("axial_force")

    @property
    def alpha(self) -> float:
        """α with ν = 1."""
        return self.epsilon_alpha / self.epsilon

    @property
    def chi(self) -> float:
        """χ with ν = 1."""
        return self.epsilon_chi / self.epsilon

    @property
    def psi(self) -> float:
        """ψ with ν = 1."""
        return self.epsilon_psi / self.epsilon

    @property
    def axial(self) -> float:
        """n/ε with ν = 1, next to α, ψ, χ."""
        return self.epsilon_axial / self.epsilon

    @property
    def loaded_to_first_order(self) -> bool:
        """Whether loads act that theory to first order knows: those that have a group."""
        return any(getattr(self, load) for load, about in loads_of(type(self)).items() if about.group)

    @property
    def off_centre(self) -> bool:
        """Whether the impact is not symmetric about the middle: only a model of the full beam takes it."""
        begin, end = self.wall_span
        apart = self.rotation or self.first_touch or any(place for place, _ in self.forces)
        return bool(apart or self.left_end != self.right_end or begin != -end)

    @property
    def supported(self) -> bool:
        """Whether an end is held."""
        return (self.left_end, self.right_end) != ("free", "free")

    @property
    def wall_span(self) -> tuple[float, float]:
        """Where the wall begins and ends, m from the middle; the ends of the beam unless given."""
        half = self.half_length
        return -half if self.wall_from is None else self.wall_from, half if self.wall_to is None else self.wall_to

    @property
    def places(self) -> set[float]:
        """Where nodes stand whatever the mesh, m from the middle: the edges of the wall (without them the ends of the
        beam), and the places of forces."""
        return {*self.wall_span, *(place for place, _ in self.forces)}

    @property
    def wall_in_part(self) -> bool:
        """Whether the wall is a plate or a stop, and not all along the beam."""
        return self.wall_span != (-self.half_length, self.half_length)

    @property
    def relative_damping(self) -> float:
        """η/T*."""
        return self.damping / self.slow_time_scale
