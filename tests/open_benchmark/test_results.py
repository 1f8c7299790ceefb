"""What a result file may hold, and what a score says of it."""

import numpy as np
import pytest
from histories import history_of

from bent_beam import Impact
from bent_beam.method import method_type
from bent_beam_programs.open_benchmark.histories import result_from_history
from bent_beam_programs.open_benchmark.problem import problem
from bent_beam_programs.open_benchmark.reading import load_result
from bent_beam_programs.open_benchmark.references import reference
from bent_beam_programs.open_benchmark.result import FEWEST, Result, ResultError, result_from_fields
from bent_beam_programs.open_benchmark.score import resolution_ignored, score
from tests.open_benchmark.exact import SIDE, TAU, exact_fields, scored, written
from theory import contact_parameters

STARTED = '{"outcome": "completed", "problem": "point-2", "metadata": '


def refusal(file):
    with pytest.raises(ResultError) as error:
        load_result(file)
    line = str(error.value)
    assert "\n" not in line and line.count(file.name) <= 1
    return line


def test_the_exact_impulse_and_moment_give_lambda0_and_r0_to_rounding():
    for found in (scored(**exact_fields(kappa)) for kappa in (0.05, 0.37, 0.8)):
        assert found.outcome == "completed"
        assert (found.error("lambda0"), found.error("r0")) == pytest.approx((0.0, 0.0), abs=1e-9)


def test_a_result_that_is_written_as_csv_scores_the_same_bits(tmp_path):
    fields = exact_fields()
    fields["J"] += np.random.default_rng(5).normal(0.0, 1e-3, TAU.size)
    first = load_result(written(tmp_path, **fields))
    table = np.column_stack([fields[name] for name in ("tau", "J", "Jm")])
    lines = ["tau,J,Jm", *(",".join(repr(float(v)).replace("e", "D") for v in row) for row in table)]
    (tmp_path / "run.csv").write_text("\n".join(lines))
    (tmp_path / "run.json").write_text(STARTED.replace("point-2", "leading-0.5") + '{"tool": "exact"}}')
    assert score(first).to_dict() == score(load_result(tmp_path / "run.csv")).to_dict()


def test_a_malformed_result_gets_one_line_naming_the_field(tmp_path):
    for changes, words in (
        ({"J": None}, "J is missing"),
        ({"outcome": "finished"}, "outcome must be one of"),
        ({"problem": "leading-x"}, "problem: 'leading-x' is not the id"),
        ({"metadata": "{"}, "metadata is not JSON"),
        ({"metadata": '{"tool": "\\ud800"}'}, "metadata holds characters that are not text"),
        ({"J": np.zeros(17)}, "J holds 17 values for 400 instants"),
        ({"J": np.full(400, np.nan)}, "J[0] is nan"),
        ({"J": np.array(["a"] * 400)}, "J must hold numbers"),
        ({"tau": np.linspace(0.1, 0.0, 400)}, "tau must increase"),
        ({"tau": np.linspace(0.0, 0.05, 400)}, "tau ends at 0.05"),
        ({"J_mnus": np.zeros(400)}, "'J_mnus' is not a field of a result (did you mean J_minus?)"),
        ({"J_minus": -np.ones(400)}, "J_minus is the size of the tensile impulse"),
        ({"x": np.zeros(3)}, "snap_tau is missing next to x"),
        ({"x": np.zeros(3), "snap_tau": np.zeros(0), "snap_gap": np.zeros((2, 3))}, "must have shape (0, points)"),
        ({"x": np.zeros(3), "snap_tau": np.zeros(2), "snap_gap": np.zeros((0, 3))}, "snap_gap is empty"),
    ):
        assert words in refusal(written(tmp_path, **changes))


def test_a_malformed_table_gets_one_line_naming_the_file_once_and_the_field(tmp_path):
    for table, about, words in (
        (b"tau,J,Jm\n0,zero,0\n", "{}", "run.csv, line 2: J is not a number (got 'zero')"),
        (b"this is a letter\n", "{}", "run.csv: 'this is a letter' is not a column"),
        (b"tau,J,Jm\n0,0\n", "{}", "run.csv, line 2: 2 values for 3 columns"),
        (b"tau,J,Jm\n\xff", "{}", "run.csv is not UTF-8 text"),
        (b"tau,J,Jm\n", '{"J": [1, 2]}', "run.json: 'J' is not a field of a result"),
        (b"tau,J,Jm\n", STARTED + "{}}", "tau is empty"),
    ):
        (tmp_path / "run.csv").write_bytes(table)
        (tmp_path / "run.json").write_text(about)
        assert words in refusal(tmp_path / "run.csv")


def test_a_result_without_numbers_or_with_those_of_a_blow_up_is_kept_with_its_reason_and_not_scored():
    asked = scored("leading-0.5", tau=TAU, J=0.0 * TAU, Jm=0.0 * TAU)  # a wall that never pushes
    assert asked.outcome == "invalid" and asked.measured == {} and "J and Jm" in str(asked.reason)
    assert scored("leading-0.5", tau=TAU, J=TAU, Jm=1e120 * TAU).outcome.startswith("diverged(Jm[1]")
    lacks = scored("leading-0.5", outcome="unsupported(no axial force)")
    assert lacks.outcome == "unsupported(no axial force)" and lacks.measured == {} and lacks.reason == "no axial force"


def test_three_results_with_the_very_same_numbers_are_no_resolutions_and_without_two_that_agree_not_clean():
    exact = exact_fields()
    J = exact["J"] + 1e-4 * np.sin(300.0 * TAU) * np.sqrt(TAU)
    same, near, honest, far = (
        [scored("leading-0.5", tau=TAU, J=k * J, Jm=k * exact["Jm"]) for k in factors]
        for factors in ((1.0, 1.0, 1.0), (1.0, 1.0 + 1e-9, 1.0 + 2e-9), (1.0, 1.0001, 1.003), (0.992, 1.004, 1.0165))
    )
    for several in (same[:2], honest):
        assert {one.diagnosis[0].name for one in resolution_ignored(several)} == {"clean"}
    for three in (same, near):
        flagged = resolution_ignored(three)
        assert {one.symptoms[0].name for one in flagged} == {"copies"} and not any(one.diagnosis for one in flagged)
    assert "spread" in {one.name for found in resolution_ignored(far) for one in found.symptoms}


@pytest.mark.parametrize(("pull", "adhesion"), [(0.03, 0.03), (1.0, 1.0), (3.0, 1.5)])
def test_a_wall_that_pulls_is_adhesive_even_where_it_pulls_more_than_it_pushes(pull, adhesion):
    """It pushes by 1 and then pulls: over the largest impulse, 1, or 2 where it has pulled by 3."""
    share = TAU / TAU[-1]
    pushed, pulled = np.minimum(2.0 * share, 1.0), pull * np.maximum(2.0 * share - 1.0, 0.0)
    found = scored("stopped-beam", tau=TAU, J=pushed - pulled, J_minus=pulled)
    assert "adhesive" in found.outcome and found.figure("pull") == pytest.approx(adhesion, rel=0.02)


def test_gaps_in_the_zone_and_penetration_are_measured_over_the_way_travelled():
    x = np.linspace(0.0, 2.0, 401)
    front = contact_parameters(0.5).lambda0 * np.sqrt(0.05)
    gap = np.where(x < front, 0.002 * 0.05, (x - front) ** 2)
    gap[0] = -0.02 * 0.05
    found = scored(**exact_fields(), x=x, snap_tau=[0.05], snap_gap=gap[None, :])
    assert found.figure("lift") == pytest.approx(0.002) and found.figure("penetration") == pytest.approx(0.02)
    assert found.outcome == "completed, leaky"


def test_first_order_numbers_need_the_base_they_belong_to():
    asked = problem("first-0.5-1-1-1")
    exact, fields = contact_parameters(0.5, 1.0, 1.0, 1.0), exact_fields()
    load, change = asked.uniform_load, asked.epsilon * SIDE
    base = Result("completed", "", problem("leading-0.5"), {}, TAU, fields["J"], fields["Jm"])
    impulse = fields["J"] + 4.0 / 3.0 * (change * exact.r1 + load * exact.lambda0) * TAU**1.5
    moment = change * (exact.r0 * exact.lambda1 + exact.r1 * exact.lambda0) / 2.0 + load * exact.lambda0**2 / 4.0
    loaded = Result("completed", "", asked, {}, TAU, impulse, fields["Jm"] + moment * TAU**2)
    found = score(loaded, base)
    assert (found.error("lambda1"), found.error("r1")) == pytest.approx((0.0, 0.0), abs=1e-4)
    assert score(loaded).measured == {}
    with pytest.raises(ResultError, match="is not the base"):
        score(loaded, loaded)


def test_a_window_that_grows_with_the_contact_is_not_said_to_gain_energy():
    history = method_type("self_similar")().simulate(Impact.dimensionless(0.5), end_time=0.1, save=60)
    assert [finding.name for finding in score(result_from_history(history)).diagnosis] == ["clean"]


@pytest.mark.parametrize("name", ["damping", "rotation", "first_touch", "opposite_wall"])
def test_a_history_of_another_impact_than_the_exact_solution_s_is_refused(name):
    impact = Impact.whole_beam(0.5).replace(**{name: 0.3})
    with pytest.raises(ResultError, match=f"{name} is "):
        result_from_history(history_of(np.zeros(1), np.zeros(1), impact=impact))


@pytest.mark.parametrize(("name", "factor"), [("bar", 0.5), ("ball", -1.0), ("string", 1.07), ("stopped-beam", 1.0)])
def test_the_ladder_has_verdicts_too(name, factor):
    asked = problem(name)
    tau = np.linspace(0.0, asked.end_time, 600)
    found = scored(name, tau=tau, J=factor * reference(asked).impulse(tau))
    assert [finding.name for finding in found.diagnosis] == ["clean" if factor == 1.0 else "off"]
    assert ("off" in found.outcome) == (factor != 1.0)


def test_the_judge_adds_up_nodal_histories_of_half_and_whole_beams_and_holds_them_against_momentum():
    x, when = np.linspace(0.0, 2.0, 41), np.array([0.05, 0.1])
    share = np.exp(-20.0 * x)
    impulse = np.sqrt(TAU)[:, None] * share / share.sum()
    # a beam that has lost the momentum 2√τ at one rate all along
    velocity = 1.0 - np.sqrt(when)[:, None] / 2.0 * np.ones(41)
    half = exact_fields() | {"node_x": x, "node_impulse": impulse}
    half |= {"x": x, "snap_tau": when, "snap_gap": 0.0 * velocity, "snap_v": velocity}
    both = np.c_[impulse[:, :0:-1], 2.0 * impulse[:, :1], impulse[:, 1:]]
    whole = exact_fields() | {"node_x": np.r_[-x[:0:-1], x], "node_impulse": both}
    for found in map(result_from_fields, (half, whole)):
        assert found.J == pytest.approx(2.0 * np.sqrt(TAU))
        assert found.Jm == pytest.approx(np.sqrt(TAU) * (x @ share) / share.sum())
    assert scored(**half).raw and abs(scored(**half).figure("momentum")) < 1e-6


def test_the_largest_force_is_the_top_of_what_the_nodes_give_and_a_stop_stands_on_one_side_alone():
    for name, place, share in (("elastic-stop-18000", 0.783, 1.0), ("elastic-wall-0.5-0", 0.0, 2.0)):
        end = problem(name).end_time
        tau = np.linspace(0.0, end, 300)
        pushed = 100.0 * end / np.pi * (1.0 - np.cos(np.pi * tau / end))[:, None]
        found = scored(name, tau=tau, node_x=[place], node_impulse=pushed)
        assert found.measured["peak_force"].value == pytest.approx(share * 100.0, rel=1e-4)
        assert found.measured["peak_time"].value == pytest.approx(0.5 * end, rel=1e-4)
        assert found.outcome == "completed, off" and found.reference["peak_force"]["error"] > 0.0


def test_the_largest_force_at_an_end_of_the_record_is_not_extrapolated():
    t = np.linspace(0.005, 3.995, 400)
    for force in (9.0 - t - 0.05 * t**2, 1.0 + t - 0.01 * t**2, np.append(9.0, np.zeros(399))):  # falls, grows, jolts
        found = scored("elastic-wall-0.5-0", tau=np.linspace(0.0, 4.0, 401), J=np.append(0.0, np.cumsum(0.01 * force)))
        assert found.measured["peak_force"].value == pytest.approx(force.max())
        assert 0.0 < (found.measured["peak_time"].value or 0.0) < 4.0


def test_the_ends_of_the_fit_window_are_in_it():
    enough, lacking = (np.linspace(*problem("point-2").fit_window, count) for count in (FEWEST, FEWEST - 1))
    scored("point-2", tau=enough, J=enough, Jm=enough)
    with pytest.raises(ResultError, match="instants in the fit window"):
        scored("point-2", tau=lacking, J=lacking, Jm=lacking)


def test_a_history_in_si_units_is_the_same_result_and_what_pulls_point_by_point_is_told():
    impact = Impact(2.0, 3.0, 1e3, 0.5, 5.0)
    pushed = np.array([[0.0, 0.0, 0.0], [3.0, 1.0, 0.0], [3.0, 2.0, -1.0]])  # of one side, at 0, ℓ and 2ℓ
    unit = 3.0 * 5.0 * impact.length_scale
    sizes = {"impulse": unit * pushed, "total_impulse": 2.0 * unit * pushed.sum(axis=1)}
    x, time = impact.length_scale * np.arange(3.0), impact.time_scale * np.array([0.0, 0.5, 1.0])
    found = result_from_history(history_of(time, x, impact=impact, **sizes), problem("leading-0.5"))
    told = [found.tau, found.J, found.Jm, found.series["J_minus"]]
    assert np.allclose(told, [[0.0, 0.5, 1.0], [0.0, 8.0, 8.0], [0.0, 1.0, 0.0], [0.0, 0.0, 2.0]])
