"""Hermite beam elements, Euler and Bernoulli's or Timoshenko's, their bands and statics.

On an element of length l, with ξ = x/l ∈ [0, 1] and dofs (w₁, θ₁, w₂, θ₂), θ = dw/dx:

    N₁ = 1 − 3ξ² + 2ξ³,  N₂ = l(ξ − 2ξ² + ξ³),  N₃ = 3ξ² − 2ξ³,  N₄ = l(ξ³ − ξ²)     (thesis A.6)
    Kₑ = EI ∫ N″ᵀN″ dx,   Mₑ = μ ∫ NᵀN dx,   V = ½ (q − q_f)ᵀ K (q − q_f), q_f unstressed    (3.1.3–8)
    Gₑ = ∫ N′ᵀN′ dx,      ½ N qᵀ G q: the work of an axial force N on the shortening of the axis (geometric stiffness)

With a shear stiffness S (κ_sGA) θ is the angle of the section. The deflection is the cubic through the slopes θ₁ + γ
and θ₂ + γ with one shear angle γ = w′ − θ (Friedman & Kosmatka 1993, Comput. Struct. 47, 473),

    γ = σ[(w₂ − w₁)/l − ½(θ₁ + θ₂)],   σ = Φ/(1 + Φ),   Φ = 12EI/(S l²),      M = EI θ′,

exact in statics under forces at nodes; the sections' rotary inertia J adds J ∫ θᵀθ dx. Φ = 0 is the element above.

w is positive into the wall; node i has dofs 2i (w) and 2i + 1 (θ). Matrices are symmetric and kept in scipy's
lower banded form, shape (4, 2·nodes): ``scipy.linalg.cholesky_banded(…, lower=True)`` takes them as they are.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import Polynomial

from bent_beam.checks import non_negative, positive
from bent_beam.errors import InputError
from bent_beam.meshes import checked_nodes
from hermite_fe.banded import stiff_product
from hermite_fe.compiled import Array

REFINEMENTS = 4  # of a static solution
SHAPES = [Polynomial(c) for c in ([1, 0, -3, 2], [0, 1, -2, 1], [0, 0, 3, -2], [0, 0, -1, 1])]  # of ξ, N₂ and N₄ over l


def shape_functions(xi: Array, length: float, derivative: int = 0) -> Array:
    """N₁…N₄ (or their x-derivative up to the third) at ξ ∈ [0, 1], shape (points, 4) (thesis A.6)."""
    if derivative not in range(4):
        raise InputError(f"derivative must be 0, 1, 2 or 3 (got {derivative!r})")
    s = np.atleast_1d(np.asarray(xi, float))
    values = np.stack([shape.deriv(derivative)(s) for shape in SHAPES], axis=1) / length**derivative
    values[:, 1::2] *= length
    return values


BENDING = [[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]]
TURNING = [[0, 0, 0, 0], [0, 1, 0, -1], [0, 0, 0, 0], [0, -1, 0, 1]]
SHORTENING = [[36, 3, -36, 3], [3, 4, -3, -1], [-36, -3, 36, -3], [3, -1, -3, 4]]
ROTARY = (  # powers of Φ
    SHORTENING,
    [[0, -15, 0, -15], [-15, 5, 15, -5], [0, 15, 0, 15], [-15, -5, 15, 5]],
    [[0, 0, 0, 0], [0, 10, 0, 5], [0, 0, 0, 0], [0, 5, 0, 10]],
)
INERTIA = [[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]]


@dataclass(frozen=True)
class HermiteBeam:
    """A straight-axis beam of Hermite elements between given nodes.

    nodes : places x, m, strictly increasing, shape (nodes,); at least two elements.
    bending_stiffness : EI, N m². mass_per_length : μ, kg/m. shear_stiffness : κ_sGA, N; None: without shear.
    rotary_inertia : J, kg m, with shear.

    Raises ``ValueError`` naming the field for non-increasing nodes, one element, or a property out of its range.
    """

    nodes: Array
    bending_stiffness: float
    mass_per_length: float
    shear_stiffness: float | None = None
    rotary_inertia: float = 0.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "nodes", checked_nodes(self.nodes))
        positive("bending_stiffness", self.bending_stiffness)
        positive("mass_per_length", self.mass_per_length)
        non_negative("rotary_inertia", self.rotary_inertia)
        if self.shear_stiffness is not None:
            positive("shear_stiffness", self.shear_stiffness)

    @property
    def lengths(self) -> Array:
        """Element lengths, m, shape (elements,)."""
        return np.diff(self.nodes)

    @property
    def dofs(self) -> int:
        return 2 * self.nodes.size

    @property
    def phi(self) -> Array:
        """Φ of each element, shape (elements,)."""
        stiffness = math.inf if self.shear_stiffness is None else self.shear_stiffness
        return 12.0 * self.bending_stiffness / (stiffness * self.lengths**2)

    def elements(self, tables: Sequence[list[list[int]]], factor: Array) -> Array:
        """``tables``, of the powers of Φ, times ``factor``, (elements,), with a length for each θ of a row and of a
        column; shape (elements, 4, 4)."""
        one, phi = np.ones_like(self.lengths), self.phi[:, None, None]
        by_dof = np.stack([one, self.lengths, one, self.lengths], axis=1)
        table = sum(np.array(table) * phi**power for power, table in enumerate(tables))
        return np.asarray(table * (by_dof[:, :, None] * by_dof[:, None, :]) * factor[:, None, None])

    def of_slopes(self, element: Array) -> Array:
        """Element matrices, (elements, 4, 4), of the dofs from those of cubics through deflections and slopes."""
        half, across = np.full(self.lengths.size, -0.5), 1.0 / self.lengths
        angle = (self.phi / (1.0 + self.phi))[:, None] * np.stack([-across, half, across, half], axis=1)  # γ
        slopes = np.tile(np.eye(4), (self.lengths.size, 1, 1))
        slopes[:, 1::2] += angle[:, None, :]
        return np.asarray(slopes.transpose(0, 2, 1) @ element @ slopes)

    def assembled(self, element: Array) -> Array:
        """Element matrices (elements, 4, 4) in lower banded form, shape (4, dofs)."""
        bands, end = np.zeros((4, self.dofs)), 2 * len(element)
        for i in range(4):
            for j in range(i + 1):
                bands[i - j, j : j + end : 2] += element[:, i, j]
        return bands

    def stiffness(self, weight: Array | None = None) -> Array:
        """K (3.1.5) in lower banded form, shape (4, dofs); ``weight`` (elements,) multiplies each element."""
        element = self.elements((BENDING, TURNING), self.bending_stiffness / self.lengths**3 / (1.0 + self.phi))
        return self.assembled(element if weight is None else element * np.asarray(weight)[:, None, None])

    def geometric_stiffness(self) -> Array:
        """∫ N′ᵀN′ dx in lower banded form, shape (4, dofs); times an axial force N, tension positive, it stiffens."""
        return self.assembled(self.of_slopes(self.elements((SHORTENING,), 1.0 / (30.0 * self.lengths))))

    def element_masses(self) -> Array:
        """Consistent Mₑ (3.1.8), with J ∫ θᵀθ dx of the sections, shape (elements, 4, 4)."""
        translation = self.of_slopes(self.elements((INERTIA,), self.mass_per_length * self.lengths / 420.0))
        turning = self.rotary_inertia / (30.0 * self.lengths) / (1.0 + self.phi) ** 2
        return translation + self.elements(ROTARY, turning)

    def interpolate(self, value: Array, slope: Array) -> Array:
        """Dofs, interleaved, (dofs,), of fields at the nodes: deflection and slope, with shear the sections' angle."""
        return np.stack([value, slope], axis=1).ravel()

    def static(self, load: Array, supports: Mapping[int, float]) -> Array:
        """Static deflection K q = load with prescribed dofs ``{dof: value}``; shape (dofs,).

        Raises ``ValueError`` when a support is no dof of the beam, or when the supports leave it free to move.
        """
        if unknown := [dof for dof in supports if not 0 <= dof < self.dofs]:
            raise InputError(f"supports must name dofs from 0 to {self.dofs - 1} (got {unknown[0]!r})")
        from scipy.linalg import cho_solve_banded, cholesky_banded  # here: no impact needs what takes long to import

        length = self.nodes[-1] - self.nodes[0]
        rigid = [(1.0 - d % 2, self.nodes[d // 2] / length if d % 2 == 0 else 1.0) for d in supports]
        if not rigid or np.linalg.matrix_rank(np.array(rigid)) < 2:
            raise InputError(f"supports leave the beam free to move (got dofs {sorted(supports)})")
        stiffness, load = self.stiffness(), np.array(load, float)
        free = np.ones(self.dofs, bool)
        free[list(supports)] = False
        # rows and columns scaled to a unit diagonal: the raw matrix mixes w with θ and loses digits; supports by 0
        bands, scale = stiffness.copy(), np.where(free, 1.0 / np.sqrt(stiffness[0]), 0.0)
        for m in range(4):
            bands[m, : self.dofs - m] *= scale[: self.dofs - m] * scale[m:]
        bands[0, ~free] = 1.0
        factor = cholesky_banded(bands, lower=True)
        q = np.zeros(self.dofs)
        q[list(supports)] = list(supports.values())
        for _ in range(REFINEMENTS):  # with residuals by differences, which see what 12EI/Δx³·q rounds away
            residual = load - stiff_product(stiffness, q)
            q += scale * cho_solve_banded((factor, True), scale * residual)
        return np.asarray(q)
