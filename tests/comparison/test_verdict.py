"""``predict --simulate``: half length, impulse and reaction as they are read off a run of the whole beam."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from bent_beam import Impact, ImpactHistory
from bent_beam.cases import Case
from comparison.command_line.app import run
from comparison.verdict import verdict
from theory import predict

K10 = Path(__file__).resolve().parents[2] / "cases" / "thesis_K10.toml"
TIMES = [0.001, 0.002, 0.0025]


def case(**loads: float) -> Case:
    impact = Impact.whole_beam(0.5).replace(**loads)
    return Case(title="", impact=impact, end_time=TIMES[-1], mesh=None, tables={})


class Perfect:
    """A method whose runs are what the theory says, on a mesh of its own."""

    def simulate(self, impact: Impact, *, end_time: float, save: Any, progress: Any = None) -> ImpactHistory:
        if progress is not None:
            progress(0.5)
            progress(1.0)
        time = np.asarray(save)
        x = np.linspace(0.0, 0.15, 600)
        fine = np.linspace(0.0, np.sqrt(end_time), 4001)[1:] ** 2
        front, force, pressure = (
            np.array([getattr(row, name) for row in predict(impact, fine).times])
            for name in ("half_contact_length", "reaction", "contact_force_per_length")
        )
        push = force / 2.0 - pressure * front  # one side's concentrated reaction, about 1/√t
        part = (np.sqrt(fine) - np.sqrt(np.concatenate([[0.0], fine[:-1]]))) * 2.0 * np.sqrt(fine) * push
        step = np.diff(fine, prepend=0.0)
        moment = np.cumsum(part * front + pressure * front**2 / 2.0 * step)
        total = 2.0 * np.cumsum(part + pressure * front * step)
        reached = np.interp(x, front, fine, left=0.0, right=np.inf)  # when the zone comes by
        share = np.gradient(x) * pressure[-1]
        pressed = share * np.maximum(time[:, None] - reached, 0.0)
        still = np.zeros((time.size, x.size))
        fields = {
            "gap": (("time", "x"), still),
            "slope": (("time", "x"), still),
            "impulse": (("time", "contact"), pressed),
            "impulse_moment": (("time",), np.interp(time, fine, moment)),
            "total_impulse": (("time",), np.interp(time, fine, total)),
        }
        return ImpactHistory.build(
            impact=impact, path="perfect", symmetry="half", settings={}, time=time, x=x, contact_x=x, fields=fields
        )


@pytest.mark.parametrize("acceleration", [0.0, 20.0])
def test_a_perfect_run_is_read_as_the_theory_says(monkeypatch: pytest.MonkeyPatch, acceleration: float) -> None:
    monkeypatch.setattr("bent_beam.method.method_from_tables", lambda *_: Perfect())
    found = verdict(case(acceleration=acceleration), TIMES, simulate=True)
    for row, exact in zip(found["simulated"], found["times"], strict=True):
        assert exact["contact_force_per_length"] == pytest.approx(acceleration)
        assert row["half_contact_length"] == pytest.approx(exact["half_contact_length"], rel=5e-3)
        assert row["impulse"] == pytest.approx(exact["impulse"], rel=1e-3)


@pytest.mark.parametrize("options", [[], ["--quiet"], ["--json"]])
def test_a_simulation_says_how_far_it_is_unless_asked_to_be_silent(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], options: list[str]
) -> None:
    """Both runs on one bar, which never goes back and ends full."""
    told: list[float] = []
    asked: list[bool] = []

    def console(quiet: bool) -> Recorded:
        asked.append(quiet)
        return Recorded(told)

    monkeypatch.setattr("bent_beam.method.method_from_tables", lambda *_: Perfect())
    monkeypatch.setattr("comparison.command_line.predict.Console", console)
    assert run(["predict", str(K10), "--simulate", *options]) == 0
    assert asked == [bool(options)] and capsys.readouterr().err == ""
    assert told == sorted(told) and len(told) == 4 and told[-1] == pytest.approx(1.0)


class Recorded:
    """A console that keeps what a bar would show."""

    def __init__(self, told: list[float]) -> None:
        self.fraction = told.append

    @contextmanager
    def progress(self, _: str) -> Iterator[Any]:
        yield self


@pytest.mark.parametrize("acceleration", [0.0, 20.0])
def test_the_whole_beam_is_as_the_theory_says_before_its_ends_are_felt(acceleration: float) -> None:
    """To the 2 % that the theory claims: an undamped run's own noise is 1 % (its error bars say more)."""
    found = verdict(case(acceleration=acceleration), [0.002, 0.003], simulate=True)
    for row, exact in zip(found["simulated"], found["times"], strict=True):
        assert exact["valid"]
        assert row["half_contact_length"] == pytest.approx(exact["half_contact_length"], rel=2e-2)
        assert row["impulse"] == pytest.approx(exact["impulse"], rel=5e-3)
