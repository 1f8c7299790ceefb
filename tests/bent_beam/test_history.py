"""The record of a run: finite, complete, written whole or not at all, read back equal."""

import json

import numpy as np
import pytest

from bent_beam import Impact, ImpactHistory


def small(gap=None):
    time, x = np.array([0.0, 1.0, 2.0]), np.array([0.0, 0.5, 1.0, 2.0])
    fields = {
        "gap": (("time", "x"), np.arange(12.0).reshape(3, 4) if gap is None else gap),
        "impulse": (("time", "contact"), np.ones((3, 2))),
        "in_contact": (("time", "contact"), np.array([[True, False]] * 3)),
        "total_impulse": (("time",), np.array([0.0, 1.0, 2.0])),
        "kinetic_energy": (("time",), np.array([5.0, 4.0, 3.0])),
        "strain_energy": (("time",), np.array([0.0, 0.5, 1.0])),
        "loss_impact": (("time",), np.array([0.0, 0.5, 1.0])),
    }
    return ImpactHistory.build(
        impact=Impact.dimensionless(0.5),
        path="hermite",
        symmetry="half",
        settings={"mesh": {"kind": "UniformMesh"}},
        time=time,
        x=x,
        contact_x=x[:2],
        fields=fields,
        warnings=["front under-resolved"],
        steps=7,
        seconds=0.1,
    )


def test_a_history_is_read_back_equal(tmp_path):
    history = small()
    again = ImpactHistory.load(history.save(tmp_path / "run.nc"))
    assert again.dataset.identical(history.dataset)
    assert again.impact == history.impact
    assert again.settings == history.settings
    assert again.warnings == ["front under-resolved"]
    assert again.dataset["gap"].attrs["units"] == "m"
    assert [f.name for f in tmp_path.iterdir()] == ["run.nc"]  # no part left behind


def test_a_failed_write_leaves_the_old_file(tmp_path, monkeypatch):
    file = small().save(tmp_path / "run.nc")
    before = file.read_bytes()

    def torn(self, path, **_):
        path.write(b"half a fi")
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("xarray.Dataset.to_netcdf", torn)
    with pytest.raises(OSError, match="No space"):
        small().save(file)
    assert file.read_bytes() == before
    assert [f.name for f in tmp_path.iterdir()] == ["run.nc"]


def test_numbers_that_are_none_are_refused():
    with pytest.raises(ValueError, match="gap is not finite"):
        small(gap=np.full((3, 4), np.nan))


@pytest.mark.parametrize("damage", [b"", b"not netCDF", None])
def test_broken_files_are_refused(tmp_path, damage):
    file = small().save(tmp_path / "run.nc")
    data = file.read_bytes()
    file.write_bytes(data[: len(data) // 2] if damage is None else damage)
    with pytest.raises(ValueError, match=r"run\.nc"):
        ImpactHistory.load(file)


def test_the_budget_adds_up():
    budget = small().energy_budget()
    assert budget["defect"] == pytest.approx(0.0)
    assert budget["initial_energy"] == 5.0
    assert json.dumps(budget, allow_nan=False)
