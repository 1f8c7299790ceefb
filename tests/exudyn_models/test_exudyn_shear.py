"""Timoshenko's beam on the Exudyn path: beside an explicit code of its own, the Hermite path, and Exudyn's own output.

Units half length = EI = μ = V₀ = 1; l_s the shear length, g = κ_sG/E."""

import exudyn as exu
import leapfrog
import numpy as np
import pytest

import exudyn_models
from benchmarks.figures.shear import over_theory, stopped_run
from bent_beam import Impact
from bent_beam.measure.balance import balance_of
from bent_beam.measure.whole_impact import whole_impact
from bent_beam.meshes import UniformMesh
from comparison.bouncing import bounce
from exudyn_models import ExudynModel
from exudyn_models.assembly import assemble, lay_out
from exudyn_models.elements import ANCFCable
from hermite_fe import HermiteFE

G = 0.2
BEAM = Impact.whole_beam(0.5, relative_damping=3e-3, shear_length=0.05, shear_ratio=G)
SEED = 46


def test_the_whole_impact_is_that_of_an_explicit_code_and_so_is_that_of_plain_solve_dynamic() -> None:
    method = ExudynModel(mesh=UniformMesh(0.03))
    restitution, impulse, moment = leapfrog.whole_impact(0.5, 3e-3, 0.05, G, 50, 1.1)
    history = method.simulate_to_separation(BEAM, save=500)
    found = whole_impact(history)
    assert (found.restitution, found.impulse) == pytest.approx((restitution, impulse), abs=5e-3)
    assert found.peak_moment == pytest.approx(moment, rel=0.04)  # without shear 1.40
    assert found.energy_defect < 1e-8 and found.energy_gain < 1e-12
    balance = balance_of(history)
    assert balance.momentum < 1e-9 and balance.second_moment < 5e-3 and balance.warnings == []
    assert {"angle", "angular_velocity", "bending_moment"} <= set(history.dataset) and "slope" not in history
    model = exudyn_models.build(BEAM, end_time=1.1, mesh=UniformMesh(0.03))
    model.mbs.SolveDynamic(model.settings)
    gathered = model.mbs.GetSensorStoredData(model.sensors["impulse"])[-1, 1]
    assert gathered / 2.0 - 1.0 == pytest.approx(restitution, abs=5e-3)


def test_without_rotary_inertia_a_load_acts_from_the_first_step_on() -> None:
    """Of a stop that is not reached no impulse, and a₀t of the middle."""
    beam = Impact.whole_beam(0.4, shear_length=0.1, shear_ratio=0.0)
    beam = beam.replace(acceleration=20.0, wall_from=0.5, wall_to=0.5)
    history = ExudynModel(mesh=UniformMesh(0.05)).simulate(beam, end_time=0.01, save=5)
    middle = int(np.argmin(np.abs(history.positions(0))))
    assert history.array("velocity", -1)[middle] == pytest.approx(1.2, rel=1e-9)
    assert not history.array("total_impulse").any()


@pytest.mark.parametrize("impact", [BEAM, BEAM.unsheared], ids=lambda impact: impact.model)
def test_recorded_moments_are_those_that_exudyn_puts_out(impact: Impact) -> None:
    """At a state without velocities, in the middle of each element."""
    chosen = ExudynModel(mesh=UniformMesh(0.1)).chosen(impact, 0.1)
    assert isinstance(chosen.element, ANCFCable) == (impact is not BEAM)
    beam, _ = assemble(lay_out(impact, 0.1, chosen), chosen)
    data, bent = beam.mbs.systemData, np.random.default_rng(SEED)
    q = data.GetODE2Coordinates(configuration=exu.ConfigurationType.Initial)
    q[beam.vertical] += 1e-6 * bent.standard_normal(beam.vertical.size)
    q[beam.rotation] += 1e-5 * bent.standard_normal(beam.vertical.size)
    data.SetODE2Coordinates(q)
    data.SetODE2Coordinates_t(np.zeros_like(q))
    kind = exu.OutputVariableType.TorqueLocal
    middles = np.zeros(beam.lengths.size) if beam.scaling.shear_length else beam.lengths / 2  # as Exudyn counts places
    theirs = [beam.mbs.GetObjectOutputBody(body, kind, [at, 0.0, 0.0]) for body, at in zip(beam.bodies, middles)]
    theirs = np.array(theirs).reshape(beam.lengths.size, -1)[:, -1]
    assert beam.bending_moments(q).mean(axis=-1) == pytest.approx(theirs, rel=1e-6, abs=1e-7 * np.abs(theirs).max())
    assert np.abs(theirs).max() > 1e-5


@pytest.mark.parametrize(("finest", "within"), [(0.06, 0.02), pytest.param(0.03, 0.01, marks=pytest.mark.verify)])
def test_a_stopped_point_converges_to_the_transform(finest: float, within: float) -> None:
    """The penalty is as soft as an element in shear: what the impulse lacks falls with the element. Bars are twice what
    half of the elements change; the coarse runs' moments cross the exact one. At 3 and 10 t_s."""
    runs = [stopped_run("exudyn", times * finest, 10.0) for times in (4, 2, 1)]
    impulse, moment = ([np.interp((3.0, 10.0), run.time, over_theory(run, name) - 1.0) for run in runs]
                       for name in ("impulse", "moment"))  # fmt: skip
    assert np.abs([impulse[2], moment[2]]).max() < within
    for _, middle, fine in (impulse, moment) if finest == 0.03 else (impulse,):
        assert (np.abs(fine) <= 2.0 * np.abs(fine - middle)).all()
    assert (np.abs(impulse[2]) < 0.5 * np.abs(impulse[1]))[0] and (np.abs(impulse[1]) < 0.5 * np.abs(impulse[0]))[0]


def drawn() -> list[tuple[float, float, float, float]]:
    """κ/ν, η/T*, l_s and g, stratified: each size once with each other where they go round."""
    random, cases = np.random.default_rng(SEED), []
    for k, kappa in enumerate((0.1, 0.2, 0.5, 1.0)):
        for j, damping in enumerate((7e-5, 7e-4, 3e-3)):
            length = (0.02, 0.08)[(k + j) % 2]
            spread = 2.0 ** random.uniform(-0.2, 0.2, 3)
            cases.append((kappa * spread[0], damping * spread[1], length * spread[2], random.uniform(0.2, 0.33)))
    return [*cases, (0.5, 3e-3, 0.002, G)]


@pytest.mark.verify
@pytest.mark.parametrize("case", drawn(), ids=lambda case: ", ".join(f"{x:.3g}" for x in case))
def test_drawn_beams_agree_with_the_hermite_path_and_the_explicit_code_within_bars(case) -> None:
    print(f"seed {SEED}")
    kappa, damping, length, g = case
    impact = Impact.whole_beam(kappa, relative_damping=damping, shear_length=length, shear_ratio=g)
    exudyn, hermite = (bounce(impact, method) for method in (ExudynModel(), HermiteFE()))
    names = ("restitution", "impulse", "peak_moment")
    explicit = {}
    if length > 0.01:
        fine, half = (leapfrog.whole_impact(kappa, damping, length, g, n, 1.3) for n in (200, 100))
        explicit = {name: (value, 2.0 * abs(value - other)) for name, value, other in zip(names, fine, half)}
    for name in names:
        ours, theirs = exudyn.numbers[name], hermite.numbers[name]
        print(f"{name}: exudyn {ours}, hermite {theirs}, explicit {explicit.get(name)}")
        agree = abs(ours.value - theirs.value) <= ours.bar + theirs.bar
        if not agree and (name, length) == ("peak_moment", 0.002):  # the last of three numbers
            pytest.xfail("no element resolves the shear length: Exudyn 1.180 ± 0.002, a finer Hermite run 1.1772")
        assert agree, name
        if name in explicit:
            value, bar = explicit[name]
            assert abs(ours.value - value) <= ours.bar + bar, name
