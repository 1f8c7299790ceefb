"""What leaves does not come back: reflection of wave packets."""

import re

import numpy as np
import pytest

from bent_beam import Impact
from bent_beam.meshes import ScaleFreeMesh, UniformMesh
from hermite_fe.banded import product
from hermite_fe.beam import HermiteBeam
from hermite_fe.far_fields import GridViscosity, Sponge
from hermite_fe.integrators import NonsmoothGeneralizedAlpha
from hermite_fe.masses import ConsistentMass
from hermite_fe.run import integrate
from hermite_fe.system import ContactRows, System
from hermite_fe.warnings_of_run import end_warnings

UNDAMPED = GridViscosity(viscosity=0.0)
GRADED = 2.0 * np.pi / (8.0 * 0.01)  # elements here are 1 % of it long: 8 in a wave
STEEP = 2.0 * np.pi / (15.0 * 0.02)


@pytest.mark.parametrize(
    ("x", "far_field", "k", "start", "turn", "least", "most"),
    [
        (ScaleFreeMesh(0.2, 1.01).nodes(12.0 * GRADED), GridViscosity(), 1.0, GRADED, np.pi / 0.01, 0.0, 1e-3),
        (ScaleFreeMesh(0.2, 1.02).nodes(12.0 * STEEP), UNDAMPED, 1.0, STEEP, np.pi / 0.02, 0.1, 2.0),
        (UniformMesh(2.0 * np.pi / 2.0 / 20.0).nodes(100.0), Sponge(viscosity=0.0), 2.0, 30.0, 100.0, 0.0, 1e-3),
        (UniformMesh(0.3).nodes(100.0), UNDAMPED, 1.0, 30.0, 100.0, 0.5, 2.0),
    ],
    ids=["growing elements with viscosity", "growing elements alone", "sponge", "free end"],
)
def test_a_packet_dies_in_viscosity_and_sponge_and_is_back_without(x, far_field, k, start, turn, least, most):
    """Of unit amplitude and wave number k, it is sent out at ``start``; what comes back to x < start is seen from when
    it would be at ``turn``, as far out as it gets, until it would be back twice."""
    beam, width = HermiteBeam(x, 1.0, 1.0), min(12.0 / k, start / 5.0)
    # u = Re f, f = exp(ikx − (x − start)²/2w²), and its velocity Re if″: every number in it runs outwards
    f = np.exp(1j * k * x - 0.5 * ((x - start) / width) ** 2)
    rate, change = 1j * k - (x - start) / width**2, -1.0 / width**2  # f′/f, and how that changes
    first, second, third = rate * f, (rate**2 + change) * f, (rate**3 + 3.0 * rate * change) * f
    q, v = beam.interpolate(f.real, first.real), beam.interpolate((1j * second).real, (1j * third).real)
    dampings = far_field.dampings(beam, Impact(1.0, 1.0, 2.0 * x[-1], 0.0, 1.0))
    away = ContactRows(dofs=[[0]], factors=[[-1.0]], gap=[1e9])
    system = System(ConsistentMass().matrix(beam), beam.stiffness(), away, dampings)
    end = 4.0 * (turn - start) / (2.0 * k)
    scheme = NonsmoothGeneralizedAlpha(0.05 / k**2, levels="velocity", spectral_radius=1.0)
    run = integrate(system, q, v, scheme, end, save=np.linspace(0.25, 1.0, 60) * end)
    assert run.failure == ""
    assert least <= np.abs(run.q[1:, 0::2][:, x < start]).max() < most


def test_far_fields_take_no_momentum_and_resist_bending_alone_by_their_constants() -> None:
    """Bent at the rate 1 they take ∫c Δx² dx √(EIμ), a sponge at each end ∫b w² s³ dx √(EIμ) = b w³/4 √(EIμ) more."""
    impact, half = Impact(3.0, 2.0, 20.0, 0.0, 1.0), ScaleFreeMesh(0.1, 1.02).nodes(10.0)
    beam = HermiteBeam(np.concatenate([-half[:0:-1], half]), 3.0, 2.0)
    grid = 0.3 * (beam.lengths**3).sum()
    for far_field, taken in ((GridViscosity(), grid), (Sponge(), grid + 2.0 * 0.03 * 5.0**3 / 4.0)):
        bands = sum(part for _, part in far_field.dampings(beam, impact))
        rigid, bent = beam.interpolate(np.ones(beam.nodes.size), 0.0 * beam.nodes), 0.5 * beam.nodes**2
        assert np.abs(product(bands, rigid)).max() < 1e-12 * np.abs(bands).max()
        rate = beam.interpolate(bent, beam.nodes)
        assert rate @ product(bands, rate) == pytest.approx(np.sqrt(6.0) * taken, rel=2e-3)


def test_waves_are_back_from_the_ends_at_the_same_time_however_long_the_run() -> None:
    impact, nodes = Impact.whole_beam(0.5), np.linspace(0.0, 1.0, 51)
    said = [end_warnings(impact, end, nodes, UNDAMPED) for end in (0.03, 0.1, 0.4)]
    times = [re.findall(r"be back at the contact from about t = (\S+) s", one[-1])[0] for one in said]
    assert len(set(times)) == 1 and 0.0 < float(times[0]) < 0.03
    assert end_warnings(impact, 0.5 * float(times[0]), nodes, UNDAMPED) == []
