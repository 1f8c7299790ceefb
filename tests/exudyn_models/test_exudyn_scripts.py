"""Every model script runs as a user runs it and prints numbers that agree with the exact ones; so does one model in
three dimensions, of a beam that slides on its wall."""

import importlib
import itertools
import re
import runpy
import sys

import exudyn as exu
import exudyn.itemInterface as items
import numpy as np
import pytest
from exudyn.beams import GenerateBeamElementsAlongLine
from here import ROOT

from exudyn_models.integrators import GeneralizedAlpha
from exudyn_models.scripts import bent_beam_impact
from exudyn_models.solvers import NewtonSolver, quiet
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


FRICTION, AMPLITUDE = 0.3, 1e-3
ELEMENTS, LENGTH, END = 60, 3.0, 0.1


def taken_and_sideways(steps):
    """What the contact has taken from the free motion, and how far z has gone, at the nodes at the end, of half of a
    straight beam. It arrives at a bulging wall, κ/ν = 0.5; its surface slides along z, faster than it is deflected, so
    that each contact carries μ_f R sideways."""
    h, mbs = LENGTH / ELEMENTS, exu.SystemContainer().AddSystem()
    cable = items.ObjectANCFCable(massPerLength=1.0, bendingStiffness=1.0, axialStiffness=1.0)
    symmetric = [1, 0, 0, 0, 1, 1]  # x and both slopes
    line = [0.0, 0.0, 0.0], [LENGTH, 0.0, 0.0], ELEMENTS
    nodes = GenerateBeamElementsAlongLine(mbs, *line, cable, groundConstraintsStart=symmetric)["nodes"]
    ground = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=mbs.AddNode(items.NodePointGround()), coordinate=0))
    wall = AMPLITUDE * 0.5 * np.linspace(0.0, LENGTH, ELEMENTS + 1) ** 2 / 2
    stiffness, damping, loads = 10.0 / h**3, 3.0 / h, []
    for k, node in enumerate(nodes):
        mbs.SetNodeParameter(node, "initialVelocities", [0.0, AMPLITUDE, 0.0, 0.0, 0.0, 0.0])
        state = mbs.AddNode(items.NodeGenericData(numberOfDataCoordinates=1, initialCoordinates=[wall[k] + 1e-14]))
        law = {"contactStiffness": stiffness, "contactDamping": damping, "offset": -wall[k]}
        across, along = (mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=c)) for c in (1, 2))
        mbs.AddObject(items.ObjectContactCoordinate(markerNumbers=[across, ground], nodeNumber=state, **law))
        loads.append(mbs.AddLoad(items.LoadCoordinate(markerNumber=along, load=0.0)))
    mbs.Assemble()

    def slide(mbs, time):
        """The friction of each contact, from the reaction that it has at the start of a step."""
        q, v = mbs.systemData.GetODE2Coordinates(), mbs.systemData.GetODE2Coordinates_t()
        depth = q[1::6] - wall
        force = np.where(depth > 0.0, stiffness * depth + damping * v[1::6], 0.0)  # Exudyn's own law
        for load, value in zip(loads, force.tolist()):
            mbs.SetLoadParameter(load, "load", FRICTION * value)
        return True

    mbs.SetPreStepUserFunction(slide)
    settings = NewtonSolver(contact_iterations=5).settings(AMPLITUDE, round_off=1e-11, along=0.0)
    GeneralizedAlpha(spectral_radius=0.5).configure(settings)
    settings.timeIntegration.endTime, settings.timeIntegration.numberOfSteps = END, steps
    with quiet():
        mbs.SolveDynamic(settings)
    q = mbs.systemData.GetODE2Coordinates()
    return np.array([AMPLITUDE * END - q[1::6], q[2::6]])


@pytest.mark.verify
def test_a_sliding_beam_is_pushed_sideways_by_the_friction_coefficient_times_its_deflection():
    """The friction lags by a step: first order in it, extrapolated to none (9 % off at 400 steps, 4 % at 800)."""
    taken, sideways = 2 * taken_and_sideways(800) - taken_and_sideways(400)
    assert taken.max() > 0.5 * AMPLITUDE * END
    assert np.abs(sideways - FRICTION * taken).max() < 0.02 * FRICTION * taken.max()
