"""Meshes: they cover the half beam, grow as they say, and reproduce the thesis's Table 3.2."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bent_beam.meshes import GradedMesh, NodesMesh, ScaleFreeMesh, SquareMesh, UniformMesh, mirrored, snapped

MESHES = st.builds(UniformMesh, st.floats(0.02, 50))
MESHES |= st.builds(GradedMesh, st.floats(0.02, 50), st.floats(1.0, 2.0), st.none() | st.floats(0.1, 60))
MESHES |= st.builds(SquareMesh, st.floats(0.3, 20), st.floats(1, 60), st.floats(1.0, 2.0))
MESHES |= st.builds(ScaleFreeMesh, st.floats(0.02, 10), st.floats(1.005, 2.0))


@given(MESHES, st.floats(1.0, 40.0))
def test_a_mesh_covers_the_half_beam_in_order(mesh, half_length):
    nodes = mesh.nodes(half_length)
    assert nodes[0] == 0.0
    assert nodes[-1] == half_length
    assert nodes.size >= 3
    assert np.all(np.diff(nodes) > 0.0)
    full = mirrored(nodes)
    assert np.array_equal(full, -full[::-1])


@pytest.mark.parametrize(("growth", "elements"), [(1.0, 20_000), (1.05, 302), (1.1, 192), (1.25, 120), (1.5, 92)])
def test_element_counts_of_table_3_2(growth, elements):
    """25 uniform elements a side reproduce the table up to one a side (which way its code rounded is not told)."""
    mesh = GradedMesh(element_length=2.5e-3, growth=growth, size_ratio=1e9)
    assert abs(2 * (mesh.nodes(25.0).size - 1) - elements) <= 2


def test_a_square_mesh_gives_a_front_the_same_time_in_each_element_and_a_scale_free_one_grows_with_distance():
    nodes = SquareMesh(first_element=0.1, zone=2.0).nodes(10.0)
    times = nodes[nodes <= 2.0] ** 2  # a front x = √t passes a node at t = x²
    assert np.allclose(np.diff(times), times[1])
    sizes = np.diff(SquareMesh(first_element=0.1, zone=2.0, growth=1.25).nodes(5.0))
    assert np.allclose(sizes[400:] / sizes[399:-1], 1.25, rtol=0.1)  # from the last of the zone on
    nodes = ScaleFreeMesh(element_length=1e-3, growth=1.02).nodes(10.0)
    sizes = np.diff(nodes)
    assert np.allclose(sizes[1:] / sizes[:-1], 1.02)
    assert GradedMesh(0.01).growth <= 1.02 >= ScaleFreeMesh(0.01).growth  # by more an element waves are reflected
    sizes = np.diff(GradedMesh(element_length=1e-4, growth=1.5).nodes(25.0))
    assert sizes.max() / sizes.min() == pytest.approx(1e3, rel=0.05)  # what the thesis caps them at
    assert GradedMesh(1.0, 1.1).nodes(0.4) == pytest.approx([0.0, 0.2, 0.4], rel=0.1)  # two, where it is shorter


@pytest.mark.parametrize(
    "mesh",
    [UniformMesh(0.01), GradedMesh(0.01, 1.04), SquareMesh(0.1, 2.0, 1.04), ScaleFreeMesh(0.01, 1.04, 0.1),
     ScaleFreeMesh(0.01, 1.04, zone=0.3, growth_outside=1.08), NodesMesh((0.0, *np.geomspace(0.1, 4.0, 80)))],
)  # fmt: skip
def test_a_mesh_refined_by_two_has_elements_of_half_the_length_everywhere(mesh):
    nodes, finer = mesh.nodes(4.0), mesh.refined(2.0).nodes(4.0)
    places = np.linspace(0.2, 3.6, 40)  # not where elements are rescaled to fit
    number = [np.interp(places, one, np.arange(one.size)) for one in (nodes, finer)]
    assert np.gradient(number[1], places) == pytest.approx(2.0 * np.gradient(number[0], places), rel=0.05)
    if isinstance(mesh, NodesMesh):
        assert np.isin(nodes, finer).all() and finer.size == 2 * nodes.size - 1


def test_impossible_meshes_are_refused():
    kinds = [(UniformMesh, 0.0), (GradedMesh, 1.0, 0.9), (SquareMesh, 0.1, -1.0), (UniformMesh(1e-9).nodes, 1.0)]
    kinds += [(NodesMesh, places) for places in ((0.0, 1.0), (0.0, 2.0, 1.0), (0.5, 1.0, 2.0))]
    for make, *values in kinds:
        with pytest.raises(ValueError, match="mesh"):
            make(*values)


def test_an_edge_takes_the_same_node_and_a_zone_has_the_same_elements_in_every_unit():
    for unit in (1.0, 1e-3, 1e3, 0.3048, 7.0):
        zone = GradedMesh(unit * 0.1, 1.1, zone=unit * 0.5).nodes(unit * 0.8)[:6]
        assert zone / unit == pytest.approx(0.1 * np.arange(6))
        moved = snapped(unit * np.arange(11) * 0.1, (unit * 0.45, unit * 0.85)) / unit
        assert moved == pytest.approx([0.0, 0.1, 0.2, 0.3, 0.45, 0.5, 0.6, 0.7, 0.85, 0.9, 1.0])


def test_what_is_left_at_the_end_is_an_element_of_its_own_from_half_the_shortest_on() -> None:
    """Less than that makes those before it longer: a sliver would ask for short steps."""
    few, many = (np.diff(GradedMesh(1.0, growth=1.02, zone=4.0).nodes(4.0 + rest)) for rest in (0.45, 0.55))
    assert few == pytest.approx(np.full(4, 1.1125)) and many == pytest.approx(np.array([1.0, 1.0, 1.0, 1.0, 0.55]))
