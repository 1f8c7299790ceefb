"""Facts of the element (thesis A.6, 3.1.5, 3.1.8) and of the two validation beams (3.10–3.15)."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss

from bent_beam.meshes import ScaleFreeMesh
from hermite_fe.beam import (
    HermiteBeam,
    banded_product,
    deflection,
    element_mass,
    element_stiffness,
    shape_functions,
)

LENGTH, STIFFNESS = 5.0, 9.345e3  # thesis Figs 3.3 and 3.5
NODES = np.linspace(0.0, LENGTH, 53)
POINTS = np.linspace(0.0, LENGTH, 301)


def dense(bands: np.ndarray) -> np.ndarray:
    n = bands.shape[1]
    full = np.zeros((n, n))
    for m in range(bands.shape[0]):
        full += np.diag(bands[m, : n - m], -m)
    return full + np.tril(full, -1).T


def test_element_matrices_are_the_integrals_of_the_shape_functions() -> None:
    length = 0.37
    points, weights = leggauss(6)
    xi, weights = 0.5 * (points + 1.0), 0.5 * length * weights
    bending, shape = shape_functions(xi, length, 2), shape_functions(xi, length)
    assert np.allclose(
        element_stiffness(np.array([length]), 2.0)[0], 2.0 * bending.T @ (weights[:, None] * bending)
    )
    assert np.allclose(element_mass(np.array([length]), 3.0)[0], 3.0 * shape.T @ (weights[:, None] * shape))


def test_rigid_motions_strain_nothing_and_carry_the_rigid_mass() -> None:
    beam = HermiteBeam(ScaleFreeMesh(0.01, 1.1).nodes(2.0), 3.0, 5.0)
    x = beam.nodes
    shift, turn = beam.interpolate(np.ones_like(x), 0.0 * x), beam.interpolate(x, np.ones_like(x))
    scale = np.abs(beam.stiffness()).max()
    assert np.abs(banded_product(beam.stiffness(), shift)).max() < 1e-14 * scale
    assert np.abs(banded_product(beam.stiffness(), turn)).max() < 1e-14 * scale
    assert shift @ banded_product(beam.mass(), shift) == pytest.approx(5.0 * 2.0, rel=1e-12)
    assert turn @ banded_product(beam.mass(), turn) == pytest.approx(5.0 * 2.0**3 / 3.0, rel=1e-12)


def test_a_loose_beam_takes_its_natural_curvature() -> None:
    beam = HermiteBeam(np.linspace(-1.0, 1.0, 9), 2.0, 1.0)
    q = beam.static(beam.curvature_load(-0.7), {8: 0.0, 9: 0.0})
    assert np.allclose(q[0::2], -0.35 * beam.nodes**2, atol=1e-13)


def test_a_simply_supported_beam_with_a_middle_force_bends_to_the_exact_cubic() -> None:
    force = 5e5
    beam = HermiteBeam(NODES, STIFFNESS, 1.0)
    load = np.zeros(beam.dofs)
    load[2 * 26] = force
    w = deflection(NODES, beam.static(load, {0: 0.0, 2 * 52: 0.0}), POINTS)
    x = np.minimum(POINTS, LENGTH - POINTS)
    exact = -force * x**3 / (12 * STIFFNESS) + force * LENGTH**2 * x / (16 * STIFFNESS)  # (3.1.12)
    assert np.abs(w - exact).max() < 1e-10 * np.abs(exact).max()


def test_a_cantilever_with_an_end_force_bends_to_the_exact_cubic() -> None:
    force = 8e5
    beam = HermiteBeam(NODES, STIFFNESS, 1.0)
    load = np.zeros(beam.dofs)
    load[0] = force
    w = deflection(NODES, beam.static(load, {2 * 52: 0.0, 2 * 52 + 1: 0.0}), POINTS)
    exact = (
        force * POINTS**3 / (6 * STIFFNESS)
        - force * LENGTH**2 * POINTS / (2 * STIFFNESS)
        + force * LENGTH**3 / (3 * STIFFNESS)
    )  # (3.1.15)
    assert np.abs(w - exact).max() < 1e-10 * np.abs(exact).max()


def test_uniform_load_deflects_the_nodes_exactly() -> None:
    beam = HermiteBeam(np.linspace(0.0, 1.0, 5), 1.0, 2.0)
    q = beam.static(beam.uniform_load(3.0 * beam.mass_per_length), {0: 0.0, 1: 0.0})
    x = beam.nodes
    assert np.allclose(q[0::2], 6.0 * x**2 * (6.0 - 4.0 * x + x**2) / 24.0, rtol=1e-12)


def test_prescribed_support_values_are_kept() -> None:
    beam = HermiteBeam(np.linspace(0.0, 1.0, 5), 1.0, 1.0)
    q = beam.static(np.zeros(beam.dofs), {0: 0.1, 8: 0.3})
    assert np.allclose(q[0::2], 0.1 + 0.2 * beam.nodes)


@pytest.mark.parametrize("derivative", [0, 1, 2, 3])
def test_interpolation_is_exact_for_cubics(derivative: int) -> None:
    beam = HermiteBeam(np.array([0.0, 0.3, 1.0, 1.5]), 1.0, 1.0)
    cubic = np.poly1d([2.0, -1.0, 0.5, 0.25])
    q = beam.interpolate(cubic(beam.nodes), cubic.deriv()(beam.nodes))
    x = np.linspace(0.0, 1.5, 40)
    exact = cubic.deriv(derivative)(x) if derivative else cubic(x)
    assert np.allclose(deflection(beam.nodes, q, x, derivative), exact)


def test_bad_beams_and_supports_are_named() -> None:
    beam = HermiteBeam(np.linspace(0.0, 1.0, 5), 1.0, 1.0)
    with pytest.raises(ValueError, match="supports leave the beam free"):
        beam.static(np.zeros(10), {0: 0.0})
    with pytest.raises(ValueError, match="supports must name dofs"):
        beam.static(np.zeros(10), {10: 0.0})
    with pytest.raises(ValueError, match="at least two elements"):
        HermiteBeam(np.array([0.0, 1.0]), 1.0, 1.0)
    with pytest.raises(ValueError, match="increase strictly"):
        HermiteBeam(np.array([0.0, 1.0, 1.0]), 1.0, 1.0)
    with pytest.raises(ValueError, match="bending_stiffness must be positive"):
        HermiteBeam(np.array([0.0, 1.0, 2.0]), -1.0, 1.0)
    with pytest.raises(ValueError, match="x must lie on the beam"):
        deflection(beam.nodes, np.zeros(10), np.array([2.0]))
    with pytest.raises(ValueError, match="derivative must be"):
        shape_functions(np.array([0.5]), 1.0, 4)
