"""Every model script runs as a user runs it and prints numbers that agree with the exact ones."""

import importlib
import itertools
import re
import runpy
import sys

import pytest
from here import ROOT

from exudyn_models.scripts import bent_beam_impact
from theory import contact_parameters

SCRIPTS = ROOT / "exudyn_models" / "scripts"


@pytest.fixture
def run(tmp_path, monkeypatch, capfd):
    """What a script prints without a display, and its complaints."""
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.chdir(tmp_path)

    def printed(name, *options):
        importlib.import_module(f"exudyn_models.scripts.{name}").main(options)
        return capfd.readouterr()

    return printed


def errors(output):
    """Relative errors that a script printed: "off by +0.12%" or "off by -1.2e-06"."""
    found = re.findall(r"off by ([-+][0-9.e+-]+)(%?)", output)
    return [abs(float(number)) / (100 if percent else 1) for number, percent in found]


@pytest.mark.parametrize(
    ("name", "options", "count", "tolerance"),
    [
        ("static_beam", (), 2, 1e-5),
        ("static_beam", ("--simply-supported",), 3, 1e-6),
        ("bouncing_ball", (), 3, 3e-3),
        ("bent_beam_impact", ("--element", "geometrically_exact"), 2, 2e-3),
        pytest.param("first_order_impacts", (), 4, 0.05, marks=pytest.mark.verify),
    ],
)
def test_script_prints_the_exact_answer_within(name, options, count, tolerance, run, tmp_path):
    found = errors(run(name, *options).out)
    assert len(found) == count
    assert max(found) < tolerance
    if "impact" not in name:  # which draw nothing
        assert (tmp_path / f"{name}.png").stat().st_size > 1000


@pytest.mark.verify
@pytest.mark.parametrize("kinds", list(itertools.product(*bent_beam_impact.KINDS.values())), ids="-".join)
def test_the_impact_in_exudyns_own_items_is_exact_with_each_combination_of_its_parts(kinds, run):
    """And at each κ/ν on offer; the script imports nothing of this project."""
    chosen = [f"--{part}={kind}" for part, kind in zip(bent_beam_impact.KINDS, kinds)]
    for kappa_over_nu in bent_beam_impact.EXACT if kinds[1:] == ("dashpot", "generalized_alpha") else (0.5,):
        lambda0, r0 = errors(run("bent_beam_impact", *chosen, f"--kappa-over-nu={kappa_over_nu}").out)
        assert lambda0 < 0.015 and r0 < 0.005


def test_the_table_of_the_script_is_exact():
    for kappa_over_nu, numbers in bent_beam_impact.EXACT.items():
        exact = contact_parameters(kappa_over_nu)
        assert numbers == pytest.approx((float(exact.lambda0), float(exact.r0)), abs=6e-6)


def test_a_script_runs_as_its_user_runs_it_writes_where_told_and_names_what_is_wrong(run, tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "argv", ["static_beam.py", "--out", "bent.png", "--elements", "4"])
    monkeypatch.syspath_prepend(SCRIPTS)
    runpy.run_path(str(SCRIPTS / "static_beam.py"), run_name="__main__")
    assert (tmp_path / "bent.png").exists()
    for wrong in (("--elements", "0"), ("--simply-supported", "--elements", "3"), ("--load", "nan")):
        with pytest.raises(SystemExit) as refusal:
            run("static_beam", *wrong)
        assert refusal.value.code == 2
    assert "no display" in run("static_beam", "--view").err
