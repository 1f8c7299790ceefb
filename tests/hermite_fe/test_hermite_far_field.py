"""What leaves does not come back: reflection of wave packets, and indifference to a larger far field."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from bent_beam import Impact
from bent_beam.meshes import ScaleFreeMesh, UniformMesh
from hermite_fe import simulate
from hermite_fe.beam import HermiteBeam
from hermite_fe.far_fields import FarField, GridViscosity, Sponge
from hermite_fe.integrators import NonsmoothGeneralizedAlpha
from hermite_fe.run import integrate
from hermite_fe.system import ContactRows, System


def returned(nodes: NDArray[np.float64], far_field: FarField, number: float, start: float, turn: float) -> float:
    """Amplitude that comes back to x < start from a packet of unit amplitude and wave number sent out at
    ``start``.

    turn : how far out it gets at most; looked at from the time it would be there to the time it would be back
        twice.
    """
    beam = HermiteBeam(nodes, 1.0, 1.0)
    width, k, x = min(12.0 / number, start / 5.0), number, nodes
    envelope = np.exp(-0.5 * ((x - start) / width) ** 2)
    y = (x - start) / width
    first, second = -y / width * envelope, (y**2 - 1.0) / width**2 * envelope
    third = (3.0 * y - y**3) / width**3 * envelope
    cos, sin = np.cos(k * x), np.sin(k * x)
    # u = Re[A exp(ikx)] and its velocity Re[i ∂ₓₓ(A exp(ikx))]: every number in it runs outwards
    q = beam.interpolate(envelope * cos, first * cos - k * envelope * sin)
    v = beam.interpolate(
        (k**2 * envelope - second) * sin - 2.0 * k * first * cos,
        (3.0 * k**2 * first - third) * sin + (k**3 * envelope - 3.0 * k * second) * cos,
    )
    system = System(
        mass=beam.mass(),
        stiffness=beam.stiffness(),
        dampings=far_field.dampings(beam, Impact(1.0, 1.0, 2.0 * nodes[-1], 0.0, 1.0)),
        contacts=ContactRows(dofs=[[0]], factors=[[-1.0]], gap=[1e9]),
    )
    end = 4.0 * (turn - start) / (2.0 * k)
    run = integrate(
        system,
        q,
        v,
        NonsmoothGeneralizedAlpha(0.05 / k**2, levels="velocity", spectral_radius=1.0),
        end,
        save=np.linspace(0.25, 1.0, 60) * end,
    )
    assert run.failure == ""
    return float(np.abs(run.q[1:, 0::2][:, x < start]).max())


@pytest.mark.parametrize(("growth", "points"), [(1.01, 8.0)])
def test_growing_elements_with_viscosity_swallow_a_packet(growth: float, points: float) -> None:
    """``points`` : elements per wave length where the packet starts; it dies on its way to a few."""
    start = 2.0 * np.pi / (points * (growth - 1.0))  # elements there are start·(growth − 1) long, k = 1
    nodes = ScaleFreeMesh(0.2, growth).nodes(12.0 * start)
    assert returned(nodes, GridViscosity(), 1.0, start, np.pi / (growth - 1.0)) < 1e-3


def test_growing_elements_alone_send_it_back() -> None:
    start = 2.0 * np.pi / (15.0 * 0.02)
    nodes = ScaleFreeMesh(0.2, 1.02).nodes(12.0 * start)
    assert returned(nodes, GridViscosity(viscosity=0.0), 1.0, start, np.pi / 0.02) > 0.1


@pytest.mark.parametrize("number", [2.0])
def test_a_sponge_swallows_what_the_mesh_carries_to_the_end(number: float) -> None:
    nodes = UniformMesh(2.0 * np.pi / number / 20.0).nodes(100.0)
    assert returned(nodes, Sponge(viscosity=0.0), number, 30.0, 100.0) < 1e-3


def test_a_free_end_sends_everything_back() -> None:
    assert returned(UniformMesh(0.3).nodes(100.0), GridViscosity(viscosity=0.0), 1.0, 30.0, 100.0) > 0.5


def test_doubling_the_far_field_changes_nothing() -> None:
    def impulse(length: float) -> NDArray[np.float64]:
        impact = Impact.dimensionless(0.5, length=length)
        mesh = ScaleFreeMesh(0.01, 1.01)
        nodes = mesh.nodes(200.0)
        size = float(nodes[np.searchsorted(nodes, 0.5 * length)])  # the same elements, cut at a node
        return simulate(impact.replace(length=2.0 * size), end_time=0.3, mesh=mesh).array("total_impulse")

    small, large = impulse(100.0), impulse(200.0)
    assert small[-1] == pytest.approx(large[-1], rel=1e-4)


def test_far_fields_take_no_momentum_and_leave_rigid_motion_alone() -> None:
    impact = Impact(1.0, 1.0, 20.0, 0.0, 1.0)
    beam = HermiteBeam(ScaleFreeMesh(0.1, 1.02).nodes(10.0), 1.0, 1.0)
    for far_field in (GridViscosity(), Sponge()):
        bands = sum(part for _, part in far_field.dampings(beam, impact))
        n = beam.dofs
        full = sum(np.diag(bands[m, : n - m], -m) + (np.diag(bands[m, : n - m], m) if m else 0.0) for m in range(4))
        rigid = beam.interpolate(np.ones(beam.nodes.size), np.zeros(beam.nodes.size))
        assert np.abs(full @ rigid).max() < 1e-12 * np.abs(full).max()
