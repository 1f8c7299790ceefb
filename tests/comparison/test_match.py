"""The point of the project: any method is held against the theory, and those of this project agree with it."""

import json
import pickle
import re
from dataclasses import replace
from functools import cache
from itertools import product
from types import SimpleNamespace

import pytest
from here import CASES
from strangers import Stranger

from bent_beam import ImpactHistory, InputError, load_case
from bent_beam.measure.numbers import MISSING, Number
from bent_beam.meshes import UniformMesh
from comparison.figures.matching import leading_figure, write_match
from comparison.matching import PERTURBATION, _peak_force, answer, match
from comparison.methods import methods_from_file
from comparison.rows import THESIS_KAPPAS, MatchQuestion, first_order_epsilon, lost_row, match_table, questions
from comparison.store import RunStore
from exudyn_models import ExudynModel
from hermite_fe import HermiteFE
from self_similar_fe import SelfSimilarFE
from theory.elastic_wall import FLATTEST, MOST_DAMPED, SHARPEST, peak_force

KEEP = RunStore(None)


def off(number, least=0.0):
    return abs(number.relative(least))


@pytest.mark.parametrize(("method", "within"), [(HermiteFE(), 5e-4), (SelfSimilarFE(), 1e-4), (ExudynModel(), 5e-4)])
def test_every_path_matches_the_leading_order(method, within):
    row = answer(MatchQuestion(method, 0.25, error_bars="drift"), KEEP)
    assert off(row.lambda0) < 2.0 * within and off(row.r0) < within
    if isinstance(method, SelfSimilarFE):
        assert row.lift < 1e-5 and row.warnings == []


@pytest.mark.parametrize("method", [SelfSimilarFE(refine=0.5), pytest.param(ExudynModel(), marks=pytest.mark.verify)])
def test_a_point_contact_does_not_spread(method, tmp_path):
    """κ/ν ≥ 1: λ₀ = 0, r₀ = ν, r₁ = 2α; the largest load changes V₀t by the method's perturbation, ε α τ/2. Its time
    and steps are those of all its runs, and what is out of balance is the largest of them."""
    question = MatchQuestion(method, 1.25, (1.0, 0.0, 0.0), error_bars="drift")
    row = answer(question, RunStore(tmp_path))
    runs = [json.loads(file.read_text())["answer"] for file in tmp_path.iterdir()]
    for name in ("seconds", "steps"):
        assert getattr(row, name) == pytest.approx(sum(run[name] for run in runs))
    for name in ("pull", "momentum_residual", "gap_of_push"):
        known = [run["reading"][name] for run in runs if run["reading"][name] is not None]
        assert getattr(row, name) == max(known, default=None)
    assert 0.5 * row.epsilons[-1] * question.duration == pytest.approx(getattr(method, "perturbation", PERTURBATION))
    assert row.regime == "discrete" and row.lambda0.value == 0.0
    assert off(row.r0) < (1e-4 if isinstance(method, SelfSimilarFE) else 1e-3) and off(row.r1) < 5e-3


UNITS = [(1, 0, 0), (0, 1, 0), (0, 0, 1), (4, 0, 0), (0, 2, 0), (1, 1, 1), (-1, 0, 0), (-1, -1, 0), (-1, -1, 1)]
SOME = [(4, 0, 0), (1, 1, 1), (-1, -1, 0), (2, -1, 0.5)]
FIRST_ORDER = [  # kappas, loads, method, error bars, share of max(|theory|, 1); more in tables of the docs
    *((kappa, UNITS, SelfSimilarFE(), "quick", 0.03 if kappa == 0.1 else 0.01) for kappa in (0.1, 0.3, 0.5, 0.8)),
    *((kappa, [(2, -1, 0.5), (0, -2, 1)], HermiteFE(), "quick", 0.01) for kappa in (0.2, 0.4, 0.65)),
    *((kappa, SOME, ExudynModel(), "quick", 0.03) for kappa in (0.3, 0.4, 0.5, 0.65, 0.8)),
    # under tension: held by a load, and in free flight, where λ₁ and r₁ are λ_N and r_N
    *((k, [(0, 0, 0, 1), (-k, 0, 0, 1)], SelfSimilarFE(), "drift", 3e-3) for k in (0.1, 0.15, 0.25, 0.35, 0.5, 0.8)),
    *((kappa, [(-kappa, 0, 0, 1)], ExudynModel(), "drift", 0.03) for kappa in (0.1, 0.25, 0.5, 0.8)),
    (0.5, [(4, 0, 0)], ExudynModel(refine=0.5), "drift", 0.01),
    (0.07, [(-2, 0, 0, 3)], ExudynModel(), "drift", 0.02),  # a thin front off which the load lifts the zone
    (0.28, [(0, 1, 0)], ExudynModel(), "drift", 0.02),  # the far field would come to the wall
    (0.99, [(1, 0, 0), (-1, 0, 0)], ExudynModel(), "drift", 0.1),  # a zone of a few hundredths
    (1.3149, [(1, 0, 0), (-1, 0, 0), (-1.3149, 0, 0, 1)], ExudynModel(refine=0.5), "drift", 1e-3),  # none: one point
]


@pytest.mark.verify
@pytest.mark.parametrize(("kappa", "loads", "method", "error_bars", "limit"), FIRST_ORDER)
def test_every_path_matches_the_first_order(kappa, loads, method, error_bars, limit):
    """The self-similar path's bars hold it, too, but for κ/ν = 0.1, whose front is thin."""
    for first in loads:
        row = answer(MatchQuestion(method, kappa, tuple(map(float, first)), error_bars=error_bars), KEEP)
        assert off(row.lambda1, 1.0) < limit and off(row.r1, 1.0) < limit, first
        if isinstance(method, SelfSimilarFE) and error_bars == "quick" and kappa > 0.1:
            assert row.lambda1.covered and row.r1.covered, first


@pytest.mark.parametrize("jobs", [1, pytest.param(2, marks=pytest.mark.verify)])
def test_a_match_resumes_and_does_not_depend_on_jobs_or_on_who_refines(jobs, tmp_path):
    asked = questions([SelfSimilarFE(refine=0.5)], [0.5, 0.25, 2.0])
    first = match(asked[:2], store=RunStore(tmp_path))
    kept = {f.name: f.read_bytes() for f in tmp_path.iterdir()}
    both = match(asked, store=RunStore(tmp_path), jobs=jobs)
    assert both[:2] == first  # from the store: seconds and all
    assert {f.name: f.read_bytes() for f in tmp_path.iterdir() if f.name in kept} == kept
    for number, question in ((2, asked[2]), (0, MatchQuestion(SelfSimilarFE(), 0.5, refine=0.5))):
        alone = answer(question, KEEP)
        assert (alone.lambda0, alone.r0) == (both[number].lambda0, both[number].r0)
    assert pickle.loads(pickle.dumps((asked, both))) == (asked, both), "as they go from process to process"


def test_what_fails_is_a_row_with_its_reason(tmp_path, monkeypatch):
    for figure in ("matching.draw_matching", "work_precision.draw_work_precision"):  # tests of the report draw them
        monkeypatch.setattr(f"comparison.figures.{figure}", lambda *_: [])
    errors = (KeyError, MemoryError, SystemExit)  # outside its run
    at_once = [Stranger(), *(Stranger(trouble, trouble) for trouble in ("fails", "refuses"))]
    at_once += [Stranger(error, error.__name__) for error in errors]
    rows = match(questions(at_once, [0.5])) + match(questions([Stranger("creeps", "creeps")], [0.5]), limit=0.2)
    assert [r.r0.value is None for r in rows] == [False, *[True] * 6]
    assert "no luck" in rows[1].reason
    assert all(r.reason.startswith(r.label) and "nobody looked" in r.reason for r in rows[3:6])
    assert rows[6].reason == "time limit: not finished after 0.2 s"
    assert all(f.stat().st_size > 100 for f in write_match(rows, tmp_path))
    (tmp_path / "work-precision-first-order.png").write_text("of an earlier match")
    assert {*write_match(rows, tmp_path)} == {*tmp_path.iterdir()}
    document = json.loads((tmp_path / "match.json").read_text())
    assert document["rows"][1]["r0"] == {"value": None, "error": None, "theory": rows[0].r0.theory}
    lost = ["fails", *(error.__name__ for error in errors), "creeps"]  # what refuses says so before the run
    assert [f["label"] for f in document["failures"]] == lost
    assert all(r.reason in match_table(rows) for r in rows if r.reason) and "refined 1 times" not in match_table(rows)


def test_the_plot_shows_what_was_measured_and_says_what_is_missing_of_nothing_else():
    """Of one κ/ν a run of first order that failed, before or after, takes no point of leading order away."""
    good, other = (answer(MatchQuestion(Stranger(), kappa), KEEP) for kappa in (0.5, 0.6))
    lost = replace(good, alpha=1.0, lambda0=MISSING, r0=MISSING, refine=2.0, reason="stopped")
    for rows in ([good, lost, other], [lost, good, other]):
        figure = leading_figure(rows)
        assert "left out" not in figure.get_supxlabel()
        (points,) = (line for line in figure.axes[0].lines if line.get_label() == "Stranger")
        assert points.get_xdata().tolist() == [0.5, 0.6]
    assert "1 row (Stranger)" in leading_figure([lost, other]).get_supxlabel()
    figure.draw_without_rendering()
    numbers = [tick.get_text() for axis in figure.axes[:2] for tick in axis.get_yticklabels(which="both")]
    assert {"0.1", "1", "2"} <= {*numbers} and "10^" not in "".join(numbers)  # no powers within one decade
    scales = {(axis.get_yscale(), axis.get_title(loc="right")) for axis in figure.axes}
    assert scales == {("log", ""), ("symlog", "linear within ±0.01 %, beyond logarithmic")}


without_lift = cache(SelfSimilarFE.simulate)


@pytest.mark.parametrize(("lift", "said"), [(0.04, ""), (0.05, "λ₀ r₀"), (0.08, "λ₀ r₀ r₁")])
def test_bars_wider_than_2_percent_of_leading_and_10_of_first_order_are_a_warning(lift, said, monkeypatch):
    """A zone thrown off its wall by so much of V₀t: that share of the push is doubtful, of r₁ twice as much."""

    def lifted(method, impact, **asked):
        data = without_lift(method, impact, **asked).dataset
        return ImpactHistory.of(data.assign(gap=data["gap"] + lift * impact.velocity * data["time"]))

    monkeypatch.setattr(SelfSimilarFE, "simulate", lifted)
    row = answer(MatchQuestion(SelfSimilarFE(refine=0.5), 0.5, (4.0, 0.0, 0.0), error_bars="drift"), KEEP)
    told = " ".join(warning for warning in row.warnings if warning.startswith("wide error bar"))
    assert [symbol for symbol in ("λ₀", "r₀", "λ₁", "r₁") if f"{symbol} = " in told] == said.split()
    assert ("λ₀" in said) == (row.r0.bar > 0.02 * row.r0.value) and ("r₁" in said) == (row.r1.bar > 0.1 * row.r1.value)
    assert max(off(row.lambda1, 1.0), off(row.r1, 1.0)) < 0.01  # what the zone bears of its load is none of its rim's


def test_lambda1_of_a_zone_that_the_run_does_not_show_is_missing_and_said_so():
    """Elements longer than the zone at κ/ν = 0.95; at 1.05 there is one point, and λ₁ = 0."""
    coarse = HermiteFE(mesh=UniformMesh(element_length=0.3))
    flat, sharp = (answer(MatchQuestion(coarse, k, (3.0, 0.0, 0.0), error_bars="drift"), KEEP) for k in (0.95, 1.05))
    assert not flat.lambda1.measured and flat.lambda1.theory and flat.r1.measured
    assert any(warning.startswith("λ₁ is missing") for warning in flat.warnings)
    assert sharp.lambda1.covered and not any("λ₁" in warning for warning in sharp.warnings)


def test_a_wall_that_gives_way_has_its_largest_force_in_the_row_and_says_from_when_on_it_is_as_a_rigid_one():
    """f(½, ½) = 3.155, whatever k; with c = √(kμ) a zone comes within 2 % of a rigid wall's after 200 √(μ/k)."""
    walls = {"wall": (1e5, 0.5), "refine": 0.5}, {"wall": (5e6, 0.5), "refine": 0.25}
    row, stiff = (answer(MatchQuestion(HermiteFE(), 0.5, error_bars="drift", **wall), KEEP) for wall in walls)
    (said,) = (text for text in row.warnings if "rigid wall" in text)
    assert said.endswith("from 0.632 t* on (the run ends at 0.1 t*)")
    assert not any("rigid wall" in text for text in stiff.warnings)
    assert row.peak_force.known == pytest.approx(3.155, rel=2e-3)
    head, _, line, *_ = (re.split(r"\s{2,}", text.strip()) for text in match_table([row]).splitlines())
    assert (head[3:5], head[7]) == (["lambda0", "%"], "F/(V0 sqrt(mu)(EI k)^1/4)") and row.wall == (1e5, 0.5)
    assert (float(line[4]), line[7]) == (pytest.approx(100.0 * row.lambda0.relative(), abs=6e-4), str(row.peak_force))
    assert row.peak_force.theory == pytest.approx(3.155, rel=1e-3)


def test_every_shipped_list_can_be_asked_for_and_those_of_all_pairs_hold_every_integrator_with_every_contact():
    lists = CASES / "methods"
    assert all(methods_from_file(file) for file in lists.glob("*.toml"))
    files = lists / "hermite.toml", lists / "exudyn.toml"
    methods = methods_from_file(*files)
    for kind, file in zip((HermiteFE, ExudynModel), files):
        pairs = [(type(m.integrator), type(m.contact)) for m in methods if isinstance(m, kind)]
        rigid = [one for one in kind.PARTS["integrator"].values() if not getattr(one, "elastic", False)]
        assert len(pairs) == len(set(pairs)) and set(pairs) == set(product(rigid, kind.PARTS["contact"].values()))
        assert [m for m in methods if isinstance(m, kind)] == methods_from_file(file)
    with pytest.raises(InputError, match="given twice"):
        methods_from_file(*files, files[0])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("method = 3", "at least one"),
        ("[[metod]]\npath = 1", "did you mean method"),
        ("[[method]]\nlabel = 1\npath = 'hermite'", "label must be"),
        ("[[method]]\nlabel = 'x'", "path is required"),
        ("[[method]]\nlabel = ''\npath = 'hermite'", "label must be"),
        (f"[[method]]\nlabel = '{'x' * 81}'\npath = 'hermite'", "label must be"),
        ("[[method]]\nlabel = '$\\frac{$ <b>'\npath = 'hermite'", "label must not hold"),  # no mathematics
        ('[[method]]\nlabel = "\\u001b]0;x"\npath = "hermite"', "label must be"),  # nothing that a terminal obeys
        ("[[method]]\npath = 'hermit'", "did you mean hermite"),
    ],
)
def test_a_bad_methods_file_is_refused_in_one_line(tmp_path, text, message):
    file = tmp_path / "methods.toml"
    file.write_text(text)
    with pytest.raises(InputError, match=message):
        methods_from_file(file)
    for label in ("x", "x" * 80):
        file.write_text(f"[[method]]\nlabel = '{label}'\npath = 'hermite'")
        assert methods_from_file(file)[0].label == label


def test_a_bow_free_of_stress_is_let_go_by_a_tension_as_it_flies() -> None:
    """μ a₀ = −N K in free flight: α = −κN."""
    pulled, told = questions([HermiteFE()], [0.4], [(None, 0.0, 0.0, 0.1), (1.0, 0.0, 0.0, 0.1)])
    assert (pulled.first, told.first) == ((-0.4 * 0.1, 0.0, 0.0, 0.1), (1.0, 0.0, 0.0, 0.1))
    (slack,) = questions([HermiteFE()], [0.4], [(None, 1.0, 0.0)])
    assert slack.first == (0.0, 1.0, 0.0, 0.0) and str(slack.first[0]) == "0.0", "no force, no acceleration"
    alone, *others = (lost_row(question, "not asked").of_tension_alone for question in (pulled, told, slack))
    assert alone and not any(others)


def test_a_row_of_first_order_is_told_with_its_loads_and_refinement_against_theory_or_one() -> None:
    """λ₁ = 1 beside 0.5 is off by half of 1, r₁ = 3 beside 4 by a quarter of 4."""
    question = MatchQuestion(SelfSimilarFE(label="mine"), 0.5, (4.0, -1.0, 0.5, 0.2), refine=2.0)
    loaded = question.loaded(0.01)
    groups = (loaded.epsilon_alpha, loaded.epsilon_psi, loaded.epsilon_chi, loaded.epsilon_axial)
    assert groups == pytest.approx([0.01 * load for load in question.first])
    numbers = {"lambda1": Number(1.0, 0.2, theory=0.5), "r1": Number(3.0, 0.2, theory=4.0)}
    text = match_table([replace(lost_row(question, ""), reason=None, warnings=["wide"], **numbers)])
    head, _, line, *_ = (re.split(r"\s{2,}", row.strip()) for row in text.splitlines())
    assert [line[head.index(name)] for name in ("refine", "alpha,psi,chi,N")] == ["2", "4,-1,0.5,0.2"]
    at = head.index("lambda1"), head.index("r1")
    assert [line[i : i + 2] for i in at] == [["1.0 ± 0.2", "+50.000"], ["3.0 ± 0.2", "-25.000"]]
    assert "warning: mine, kappa/nu = 0.5, (alpha, psi, chi, N) = (4, -1, 0.5, 0.2), refined 2 times: wide" in text


def test_the_default_rows_are_the_cases_of_the_thesis_that_touch_with_a_zone() -> None:
    cases = [load_case(file).impact.kappa_over_nu for file in CASES.glob("thesis_K*.toml")]
    assert sorted(THESIS_KAPPAS) == pytest.approx(sorted(kappa for kappa in cases if kappa < 1.0))


@pytest.mark.parametrize("front", [2.0, 0.05])
def test_runs_of_first_order_change_the_free_motion_by_a_small_part(front) -> None:
    """Of V₀t at the end, at z, a little beyond the front; less where the front is near the middle."""
    z, part = front + (1.0 + front**2) ** -0.5, 0.05 * front / (front + 0.2)
    epsilon = first_order_epsilon(SimpleNamespace(front=front), (-1.0, 5.0, -3.0, 0.1), 0.05, 0.1)
    assert epsilon * 0.1 * (1.0 / 2.0 + 5.0 * z**4 / 24.0 + 3.0 * z**2 / 2.0 + 0.1 / 2.0) == pytest.approx(part)


def test_the_theory_of_a_soft_wall_stands_beside_the_force_of_a_beam_without_loads_within_its_range() -> None:
    sound = {"first": None, "kappa_over_nu": 0.5, "wall": (1e3, MOST_DAMPED)}
    runs = [SimpleNamespace(reading={"peak_force": force}) for force in (1.0, 1.1)]

    def theory(**change):
        found = _peak_force(SimpleNamespace(**sound | change), runs)  # type: ignore[arg-type]
        assert found.value == 1.0 and found.bar > 0.0
        return found.theory

    assert theory() == peak_force(0.5, MOST_DAMPED).value != theory(wall=None) == peak_force(0.5, 0.0).value
    assert theory(kappa_over_nu=SHARPEST) is not None and theory(kappa_over_nu=FLATTEST) is not None
    beyond = [{"kappa_over_nu": 1.01 * SHARPEST}, {"kappa_over_nu": 0.99 * FLATTEST}, {"first": (1.0, 0.0, 0.0, 0.0)}]
    assert [theory(**change) for change in (*beyond, {"wall": (1e3, 1.01 * MOST_DAMPED)})] == [None] * 4
