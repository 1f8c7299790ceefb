"""Euler–Bernoulli cable of the absolute nodal coordinate formulation (Exudyn's ``ObjectANCFCable2D``).

    m = EI(κ − κ₀ + η κ̇),   n = EA(|r′| − 1),   κ = (r′ × r″)/|r′|²,   r cubic between nodes with coordinates (r, r′)

For small deflections this is the Hermite element of the beam equation. η, s, is the material's plus that of the grid,
c·√(μ/EI)·Δx², which damps only what the mesh cannot resolve: waves of wave number k by the ratio c(kΔx)²/2.
"""

import math
from dataclasses import dataclass
from typing import Any, ClassVar

import exudyn.itemInterface as items
import numpy as np
from numpy.polynomial.polynomial import polyder, polyval

from bent_beam import Impact
from bent_beam.loads import UNSHEARED
from exudyn_models.elements.beam import Beam, Element
from exudyn_models.geometry import POINTS, WEIGHTS, Array

CUBICS = np.array([[1.0, 0.0, -3.0, 2.0], [0.0, 1.0, -2.0, 1.0], [0.0, 0.0, 3.0, -2.0], [0.0, 0.0, -1.0, 1.0]]).T
AT_STRETCH, AT_BENDING, AT_ENDS = (
    tuple(np.asarray(polyval(places, polyder(CUBICS, derivative)), np.float64) for derivative in range(3))
    for places in ((POINTS + 1) / 2, 0.5 + np.array([-1.0, 1.0]) / math.sqrt(12.0), np.array([0.0, 1.0]))
)
"""Hermite functions of the unit element, and derivatives, at the Gauss points where Exudyn integrates stretch, at the
two where it integrates bending, and at the ends, each of shape (4 functions, points)."""


class _Cable(Beam):
    rotation_coordinate = 3

    def node(self, i: int) -> Any:
        shape, (place, velocity) = self.shape, self.at_first(i)
        cos, sin, stretched = np.cos(shape.angle[i]), np.sin(shape.angle[i]), 1.0 + self.stretch
        turning, rate = shape.angular_velocity[i], 1.0 / self.units.time
        return items.NodePoint2DSlope1(
            referenceCoordinates=[shape.s[i] * self.units.length, 0.0, 1.0, 0.0],
            initialCoordinates=[*place, stretched * cos - 1.0, stretched * sin],
            initialVelocities=[*velocity, -turning * sin * rate, turning * cos * rate],
        )

    def body(self, i: int) -> Any:
        units = self.units
        return items.ObjectANCFCable2D(
            length=self.lengths[i] * units.length,
            massPerLength=units.mass_per_length,
            bendingStiffness=units.bending_stiffness,
            axialStiffness=self.axial_stiffness * units.force,
            bendingDamping=self.viscosity[i] * units.bending_stiffness * units.time,
            referenceCurvature=self.shape.curvature / units.length,
            nodeNumbers=[self.nodes[i], self.nodes[i + 1]],
            useReducedOrderIntegration=1,
        )

    def _fields(self, q: Array, shapes: tuple[Array, ...], *derivatives: int) -> list[Array]:
        """Derivatives by s of x, then of y, at the points of ``shapes``, each (…, elements, points)."""
        length, found = self.lengths[:, None], []
        for offset in (0, 1):
            at_nodes = q[..., self.horizontal[:-1, None] + [0, 2, 4, 6] + offset]  # x₁, x₁′, x₂, x₂′
            at_nodes[..., 1::2] *= length
            found += [at_nodes @ shapes[derivative] / length**derivative for derivative in derivatives]
        return found

    def _bent(self, q: Array, shapes: tuple[Array, ...]) -> Array:
        """κ − κ₀ at the points of ``shapes``, (…, elements, points)."""
        return np.asarray(self._curvature(*self._fields(q, shapes, 1, 2)) - self.shape.curvature)

    def slope(self, q: Array) -> Array:
        return np.asarray(q[..., self.rotation] / (1.0 + q[..., self.horizontal + 2]))

    def axial_energy(self, q: Array) -> Array:
        x1, y1 = self._fields(q, AT_STRETCH, 1)
        square = (np.hypot(1.0 + x1, y1) - 1.0) ** 2 - self.stretch**2
        integral = (square * (self.lengths[:, None] * WEIGHTS / 2)).sum(axis=(-2, -1))
        return np.asarray(self.axial_stiffness * integral / 2)

    def bending_energy(self, q: Array) -> Array:
        return np.asarray((self._bent(q, AT_BENDING) ** 2).mean(axis=-1) @ self.lengths) / 2

    def damping_work(self, q: Array, v: Array) -> tuple[Array, Array]:
        x1, x2, y1, y2 = self._fields(q, AT_BENDING, 1, 2)
        u1, u2, w1, w2 = self._fields(v, AT_BENDING, 1, 2)
        bent, along = self._curvature(x1, x2, y1, y2), 1.0 + x1
        rate = u1 * y2 + along * w2 - w1 * x2 - y1 * u2 - 2.0 * bent * (along * u1 + y1 * w1)
        rate /= along**2 + y1**2
        work = ((rate[1:] + rate[:-1]) / 2 * np.diff(bent, axis=0)).mean(axis=-1) * self.lengths
        return work @ self.grid_viscosity, work.sum(axis=-1) * self.scaling.material_damping

    def bending_moments(self, q: Array) -> Array:
        return self._bent(q, AT_ENDS)

    def _curvature(self, x1: Array, x2: Array, y1: Array, y2: Array) -> Array:
        x1 = x1 + 1.0
        return np.asarray((x1 * y2 - y1 * x2) / (x1**2 + y1**2))

    def axial_mass(self) -> Array:
        return self.element_matrices()[0]

    def element_matrices(self) -> tuple[Array, Array, Array]:
        length = self.lengths
        scale = np.stack([np.ones_like(length), length, np.ones_like(length), length], axis=1)
        outer = scale[:, :, None] * scale[:, None, :]
        n, _, b = AT_STRETCH
        mass = (n * WEIGHTS / 2) @ n.T * outer * length[:, None, None]
        bending = (b * WEIGHTS / 2) @ b.T * outer / (length**3)[:, None, None]
        return mass, bending, bending


@dataclass(frozen=True)
class ANCFCable(Element):
    """ANCF cable elements, cubic: the default of a beam without shear."""

    beam: ClassVar[type[Beam]] = _Cable

    def refuses(self, impact: Impact) -> str | None:
        if impact.shear_stiffness is None:
            return None
        return (
            "exudyn.element.kind ancf_cable has no shear: take geometrically_exact "
            f"(got shear_stiffness {impact.shear_stiffness!r}){UNSHEARED}"
        )
