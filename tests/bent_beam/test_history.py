"""The record of a run: finite, complete, written whole or not at all, read back equal."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from histories import history_of

from bent_beam import Impact, ImpactHistory, InputError


def small(**fields):
    rising = np.array([0.0, 0.5, 1.0])
    known = {"gap": np.arange(12.0).reshape(3, 4), "in_contact": np.array([[True, False] * 2] * 3)}
    known |= {"total_impulse": rising, "kinetic_energy": 5.0 - 2.0 * rising}
    known |= {"strain_energy": rising, "loss_impact": rising}
    return history_of([0.0, 1.0, 2.0], [0.0, 0.5, 1.0, 2.0], **known | fields).with_warnings(["front under-resolved"])


def test_a_history_until_a_time_ends_there_and_recorded_moments_come_instant_by_instant_or_together():
    time, x = np.linspace(0.0, 1.0, 5), np.linspace(0.0, 1.0, 4)
    run = history_of(time, x, bending_moment=np.outer(time, [3.0, 2.0, 1.0, 0.0]))
    cut = run.until(0.5)
    assert cut.time.tolist() == [0.0, 0.25, 0.5] and cut.array("gap").shape == (3, 4)
    whole = replace(run, attrs={**run.attrs, "steps": 100})
    assert (whole.until(0.5).steps, run.until(0.0).time.size) == (50, 1)
    with pytest.raises(InputError, match="time must not be negative"):
        run.until(-1.0)
    together, places = run.bending_moments(slice(1, 3))
    for row, k in zip(together, (1, 2)):
        moments, where = run.bending_moments(k)
        assert np.array_equal(row, moments) and np.array_equal(where, places)


def test_a_history_is_read_back_equal_and_its_budget_adds_up(tmp_path):
    history = small()
    again = ImpactHistory.load(history.save(tmp_path / "run.nc"))
    assert again.dataset.identical(history.dataset)
    assert again.warnings == ["front under-resolved"]
    assert again.dataset["gap"].attrs["units"] == "m"
    assert [f.name for f in tmp_path.iterdir()] == ["run.nc"]  # no part left behind
    budget = again.energy_budget()
    assert budget["defect"] == pytest.approx(0.0) and budget["initial_energy"] == 5.0
    assert (budget["kinetic_energy"], budget["loss_impact"]) == (-2.0, 1.0)  # from the first to the last instant
    half = again.energy_budget(until=0.4)  # straight between instants
    assert (half["kinetic_energy"], half["loss_impact"]) == pytest.approx((-0.4, 0.2))
    assert small(strain_energy=np.array([1.0, 1.5, 2.0])).energy_budget()["initial_energy"] == 6.0
    with pytest.raises(ValueError, match="gap is not finite"):
        small(gap=np.full((3, 4), np.nan))
    (tmp_path / "run.nc").write_bytes((tmp_path / "run.nc").read_bytes()[:9000])
    with pytest.raises(ValueError, match=r"run\.nc"):
        ImpactHistory.load(tmp_path / "run.nc")
    one = history_of([0.0], [0.0, 1.0])  # a single instant will do
    assert ImpactHistory.load(one.save(tmp_path / "one.nc")).time.tolist() == [0.0]


def test_stress_is_that_of_bending_and_of_the_pull_along_the_beam():
    """|M|/W + |N|/A of a beam of EI = 2 that is bent from K₀ = 3 to 2, and pulled or pressed."""
    section, x = SimpleNamespace(area=4.0, section_modulus=0.5), np.array([[0.0, 0.5, 1.0, 2.0]])
    for force in (10.0, -10.0):
        impact = Impact(2.0, 1.0, 4.0, 3.0, 1.0, axial_force=force)
        bare = history_of([0.0], x[0], impact=impact, gap=x**2, slope=-2.0 * x)
        assert bare.stress is None
        assert bare.described("", section).stress == pytest.approx(2.0 * (3.0 - 2.0) / 0.5 + 10.0 / 4.0)


def test_the_first_force_of_a_history_that_begins_late_is_a_mean_since_the_first_touch():
    """Whatever the unit of time."""
    late = history_of([2e-3, 4e-3], [0.0, 1.0], total_impulse=np.array([0.01, 0.03]))
    assert late.force == pytest.approx([5.0, 10.0])
    assert late.impulse_at([0.0, 1e-3, 3e-3]) == pytest.approx([0.0, 0.005, 0.02])
    assert small().force == pytest.approx([0.0, 0.5, 0.5])


@pytest.mark.parametrize(("share", "whole"), [(1.0, True), (0.97, False)])
def test_an_arc_of_true_geometry_is_whole_by_its_own_length(share, whole) -> None:
    """Turned by 0.9 at its ends it is 13 % shorter along x."""
    angle, impact = 0.9 * share * np.linspace(0.0, 1.0, 21), Impact.whole_beam(0.9)
    run = history_of([0.0, 1.0], np.sin(angle) / 0.9, impact=impact, gap=np.tile((1.0 - np.cos(angle)) / 0.9, (2, 1)))
    along = replace(run, attrs={**run.attrs, "settings": '{"geometry": {"kind": "TrueGeometry"}}'})
    assert along.is_whole == whole and not run.is_whole
