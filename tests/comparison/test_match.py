"""The point of the project: any method is held against the theory, and those of this project agree with it."""

import json
import signal
import time
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path
from typing import ClassVar

import pytest

import comparison.match as matching
from bent_beam import InputError, SimulationError
from bent_beam.method import method_from_tables
from comparison.compared import Compared
from comparison.figures.matching import draw_first_order
from comparison.match import MatchRow, Question, answer, failures, match, questions
from comparison.methods import default_methods, methods_from_file, methods_of
from comparison.store import RunStore
from comparison.tables import match_document, match_table, write_match
from comparison.time_limit import affordable_refinement
from comparison.workers import Expired, limited
from exudyn_models import ExudynModel
from hermite_fe import HermiteFE
from self_similar_fe import SelfSimilarFE
from theory import contact_parameters

KEEP = RunStore(None)


def off(number, least=0.0):
    return abs(number.relative(least))


@pytest.mark.parametrize("kappa", [0.25, 0.8])
def test_the_nonsmooth_solver_matches_the_leading_order(kappa):
    row = answer(Question(HermiteFE(), kappa), KEEP)
    assert off(row.lambda0) < 1e-3
    assert off(row.r0) < 5e-4


@pytest.mark.parametrize("kappa", [0.05, 0.5])
def test_the_self_similar_solver_matches_the_leading_order(kappa):
    row = answer(Question(SelfSimilarFE(), kappa), KEEP)
    assert off(row.lambda0) < 2e-4
    assert off(row.r0) < 1e-4
    assert row.lift < (1e-5 if kappa >= 0.25 else 5e-4)
    assert row.warnings == []


@pytest.mark.parametrize("kappa", [0.5])
def test_exudyn_matches_the_leading_order(kappa):
    row = answer(Question(ExudynModel(), kappa, error_bars="drift"), KEEP)
    assert off(row.lambda0) < 1e-3
    assert off(row.r0) < 5e-4


def test_a_point_contact_does_not_spread():
    """κ/ν ≥ 1: λ₀ = 0, r₀ = ν, r₁ = 2α."""
    row = answer(Question(SelfSimilarFE(), 1.25, (1.0, 0.0, 0.0), error_bars="drift"), KEEP)
    assert row.regime == "discrete"
    assert row.lambda0.value == 0.0
    assert off(row.r0) < 1e-4
    assert off(row.r1) < 5e-3
    assert off(answer(Question(ExudynModel(), 1.25, error_bars="drift"), KEEP).r0) < 1e-3


@pytest.mark.parametrize(
    ("kappa", "first"),
    [
        pytest.param(0.5, (4.0, 0.0, 0.0), marks=pytest.mark.verify),
        pytest.param(0.5, (-1.0, -1.0, 0.0), marks=pytest.mark.verify),
        pytest.param(0.3, (-1.0, -1.0, 1.0), marks=pytest.mark.verify),
        pytest.param(0.8, (0.0, 0.0, 1.0), marks=pytest.mark.verify),
    ],
)
def test_the_self_similar_solver_matches_the_first_order(kappa, first):
    row = answer(Question(SelfSimilarFE(), kappa, first, error_bars="drift"), KEEP)
    for number in (row.lambda1, row.r1):
        assert off(number, 1.0) < 0.01
        assert number.covered


@pytest.mark.verify
def test_exudyn_matches_the_first_order_of_a_pressed_zone():
    """On half of its elements and steps, for a third of the time."""
    row = answer(Question(ExudynModel(refine=0.5), 0.5, (4.0, 0.0, 0.0), error_bars="drift"), KEEP)
    assert off(row.lambda1, 1.0) < 0.01
    assert off(row.r1, 1.0) < 0.01


@pytest.mark.verify
@pytest.mark.parametrize("method", [SelfSimilarFE(), HermiteFE()], ids=lambda m: m.path)
@pytest.mark.parametrize("kappa", [0.1, 0.3, 0.5, 0.8])
@pytest.mark.parametrize(
    "first",
    [(1, 0, 0), (0, 1, 0), (0, 0, 1), (4, 0, 0), (0, 2, 0), (1, 1, 1), (-1, 0, 0), (-1, -1, 0), (-1, -1, 1)],
)
def test_the_first_order_is_matched_everywhere(method, kappa, first):
    row = answer(Question(method, kappa, tuple(map(float, first))), KEEP)
    limit = 0.03 if kappa == 0.1 else 0.01
    assert off(row.lambda1, 1.0) < limit
    assert off(row.r1, 1.0) < limit


@pytest.mark.verify
@pytest.mark.parametrize("kappa", [0.2, 0.4, 0.65])
@pytest.mark.parametrize("first", [(2, -1, 0.5), (0, -2, 1), (4, 0, 0), (-1, -1, 1)])
def test_the_nonsmooth_solver_matches_the_first_order_in_between(kappa, first):
    row = answer(Question(HermiteFE(), kappa, tuple(map(float, first))), KEEP)
    assert off(row.lambda1, 1.0) < 0.01
    assert off(row.r1, 1.0) < 0.01


@pytest.mark.verify
@pytest.mark.parametrize("kappa", [0.3, 0.4, 0.5, 0.65, 0.8])
@pytest.mark.parametrize("first", [(4.0, 0.0, 0.0), (1.0, 1.0, 1.0), (-1.0, -1.0, 0.0), (2.0, -1.0, 0.5)])
def test_exudyn_matches_the_first_order(kappa, first):
    row = answer(Question(ExudynModel(), kappa, first), KEEP)
    assert off(row.lambda1, 1.0) < 0.03
    assert off(row.r1, 1.0) < 0.03


@pytest.mark.verify
@pytest.mark.parametrize("factor", [0.5, 2.0])
@pytest.mark.parametrize(("kappa", "first"), [(0.5, (4.0, 0.0, 0.0)), (0.5, (1.0, 1.0, 1.0)), (0.8, (-1.0, -1.0, 0.0))])
def test_the_size_of_the_loads_is_within_the_error_bars(monkeypatch, kappa, first, factor):
    """ε → 0 is extrapolated to: with half and twice the ε λ₁ and r₁ are the same."""
    asked = Question(SelfSimilarFE(), kappa, first, error_bars="drift")
    usual = answer(asked, KEEP)
    monkeypatch.setattr(SelfSimilarFE, "perturbation", factor * SelfSimilarFE.perturbation)
    other = answer(asked, KEEP)
    assert other.epsilons[-1] == pytest.approx(factor * usual.epsilons[-1])
    for name in ("lambda1", "r1"):
        one, two = usual.compared()[name], other.compared()[name]
        assert abs(one.value - two.value) < one.error + two.error


@pytest.mark.verify
@pytest.mark.parametrize("kappa", [0.1, 0.15, 0.25, 0.35, 0.5, 0.65, 0.8])
def test_tension_alone_on_the_self_similar_path_within_three_thousandths(kappa):
    """Held by a load (0, 0, 0, 1) and in free flight, where λ₁, r₁ are λ_N, r_N."""
    for first in ((0.0, 0.0, 0.0, 1.0), (-kappa, 0.0, 0.0, 1.0)):
        row = answer(Question(SelfSimilarFE(), kappa, first, error_bars="drift"), KEEP)
        for number in (row.lambda1, row.r1):
            assert abs(number.value - number.theory) < 3e-3 * max(abs(number.theory), 1.0)
        if row.of_tension_alone:
            exact = contact_parameters(kappa)
            assert (row.lambda1.theory, row.r1.theory) == pytest.approx((exact.lambda_axial, exact.r_axial), rel=1e-9)


def test_free_flight_under_tension_has_its_own_acceleration_at_each_curvature(tmp_path):
    asked = questions([SelfSimilarFE()], [0.5, 0.25], [(None, 0.0, 0.0, 2.0), (1.0, 0.0, 0.0)])
    assert [q.first for q in asked] == [(-1.0, 0.0, 0.0, 2.0), (1.0, 0, 0, 0), (-0.5, 0.0, 0.0, 2.0), (1.0, 0, 0, 0)]
    number = Compared(-1.9, 0.01, -1.897)
    base = MatchRow("one", "self_similar", {}, 0.5, -1.0, 0.0, 0.0, 2.0, 1.0, lambda1=number, r1=number)
    rows = [base, replace(base, kappa_over_nu=0.25, alpha=-0.5), replace(base, alpha=1.0, axial=0.0)]
    assert [row.of_tension_alone for row in rows] == [True, True, False]
    assert [file.name for file in draw_first_order(rows, tmp_path)] == ["first-order.png"]


def test_a_sweep_resumes_and_does_not_depend_on_jobs(tmp_path):
    asked = questions(default_methods(["self_similar"]), [0.5, 0.25, 2.0])
    first = match(asked[:2], store=RunStore(tmp_path))
    kept = {f.name: f.read_bytes() for f in tmp_path.iterdir()}
    both = match(asked, store=RunStore(tmp_path), jobs=2)
    assert both[:2] == first  # from the store: seconds and all
    assert {f.name: f.read_bytes() for f in tmp_path.iterdir() if f.name in kept} == kept
    alone = match(asked[2:])
    assert alone[0].r0 == both[2].r0
    assert alone[0].lambda0 == both[2].lambda0


def test_a_torn_or_edited_answer_is_computed_again(tmp_path):
    store, calls = RunStore(tmp_path), []

    def compute():
        calls.append(1)
        return {"value": 1.5}

    for damage in (None, b"", b'{"answer": {"value": 2.5}, "sha256": "0"}'):
        if damage is not None:
            next(tmp_path.iterdir()).write_bytes(damage)
        assert store.answer({"q": 1}, compute) == {"value": 1.5}
    assert len(calls) == 3
    assert store.answer({"q": 1}, compute) == {"value": 1.5}
    assert len(calls) == 3


@dataclass(frozen=True)
class Stub:
    """A method of somebody else's: the self-similar solver under another name, which fails where it is told to."""

    path: ClassVar[str] = "stub"
    trouble: str = ""
    label: str = "Stub"

    def refuses(self, impact):
        return "curvature: not today" if self.trouble == "refuses" else None

    def simulate(self, impact, *, end_time=None, save=200, progress=None):
        if self.trouble == "fails":
            raise SimulationError("no luck", time=1.0, step=3, advice="another day")
        if self.trouble == "hangs":
            while True:
                pass
        return SelfSimilarFE().simulate(impact, end_time=end_time, save=save, progress=progress)


def test_a_method_of_somebody_elses_is_matched_like_any_other():
    row = answer(Question(Stub(), 0.5), KEEP)
    assert row.label == "Stub"
    assert off(row.r0) < 1e-4
    assert "refine" in match([Question(Stub(), 0.5, None, 2.0)])[0].reason


def test_what_fails_is_a_row_with_its_reason(tmp_path):
    methods = [Stub(), *(Stub(trouble, trouble) for trouble in ("fails", "refuses", "hangs"))]
    rows = match(questions(methods, [0.5]), limit=3.0)
    assert [r.label for r in rows] == ["Stub", "fails", "refuses", "hangs"]
    assert [r.r0.value is None for r in rows] == [False, True, True, True]
    assert [r.label for r in failures(rows)] == ["fails", "hangs"]  # what refuses says so before the run
    assert "no luck" in rows[1].reason
    assert rows[3].reason == "time limit: not finished after 3 s"
    assert rows[1].r0.theory == rows[0].r0.theory
    assert all(f.stat().st_size > 100 for f in write_match(rows, tmp_path))
    document = json.loads((tmp_path / "match.json").read_text())
    assert document["rows"][1]["r0"] == {"value": None, "error": None, "theory": rows[0].r0.theory}
    assert [f["label"] for f in document["failures"]] == ["fails", "hangs"]
    assert all(r.reason in match_table(rows) for r in rows if r.reason)


def test_a_row_with_a_time_limit_is_as_fine_as_fits():
    """Work grows fourfold when elements and steps are halved."""
    for limit, factor in ((100.0, 1.0), (2.0, 1.0), (1.2, 0.5), (0.3, 0.25), (1e-9, 0.125)):
        found, expected = affordable_refinement(lambda f: f**2, limit, runs=1.0)
        assert found == factor
        assert expected == pytest.approx(1.0)


def test_a_row_that_would_take_longer_than_its_limit_is_coarser_and_says_so():
    (row,) = match([Question(HermiteFE(), 0.013)], limit=0.3)
    assert row.reason is None and row.refine < 1.0
    assert any("coarser than asked for" in warning for warning in row.warnings)
    assert abs(row.r0.value - row.r0.theory) < row.r0.error


def spin(seconds):
    began = time.perf_counter()
    while time.perf_counter() - began < seconds:
        pass
    return "finished"


@pytest.mark.parametrize("module", ["numba.dispatcher", "importlib._bootstrap"])
def test_the_time_limit_stands_still_while_code_is_compiled_or_imported(module):
    """An alarm in the middle of it left numba with "no compiled object yet" for the rest of the process."""
    preparing = {"__name__": module, "spin": spin}
    exec("def prepare(seconds): return spin(seconds)", preparing)
    assert limited(preparing["prepare"], 0.2, 0.6) == "finished"
    found = limited(lambda: (preparing["prepare"](0.6), spin(0.6)), 0.2)
    assert found == Expired("time limit: not finished after 0.2 s")


def test_an_alarm_after_the_call_is_late(monkeypatch):
    set_timer = signal.setitimer

    def slowly(which, seconds, interval=0.0):
        if seconds == 0.0:
            time.sleep(0.2)  # the alarm rings while it is being taken back
        set_timer(which, seconds, interval)

    monkeypatch.setattr(signal, "setitimer", slowly)
    assert limited(str, 0.05, "answer") == "answer"


def test_a_time_limit_is_the_reason_whatever_the_interrupted_code_makes_of_it():
    """Exudyn's solver says that a user function failed."""

    def solver():
        try:
            spin(1.0)
        except TimeoutError:
            raise SimulationError("a user function failed", time=0.0, step=1, advice="none") from None

    assert limited(solver, 0.2) == Expired("time limit: not finished after 0.2 s")
    with pytest.raises(ZeroDivisionError):
        limited(lambda: 1 // 0, 0.2)


def test_an_unexpected_error_does_not_take_the_others_along(monkeypatch):
    whole = matching.answer

    def sometimes(question, store, limit):
        if question.kappa_over_nu == 0.25:
            raise ArithmeticError("no luck")
        return whole(question, store, limit)

    monkeypatch.setattr(matching, "answer", sometimes)
    rows = match(questions(default_methods(["self_similar"]), [0.5, 0.25, 2.0]))
    assert [r.kappa_over_nu for r in failures(rows)] == [0.25]
    assert "no luck" in rows[1].reason


def test_refinement_gives_a_line_of_work_and_precision(tmp_path):
    rows = match(questions([SelfSimilarFE()], [0.5], refines=[0.5, 1.0]))
    assert rows[0].steps < rows[1].steps
    assert (tmp_path / "work-precision.png") in write_match(rows, tmp_path)
    assert match_document(rows)["rows"][0]["refine"] == 0.5


def test_methods_come_from_a_file_and_from_assignments(tmp_path):
    file = tmp_path / "methods.toml"
    file.write_text(
        '[[method]]\nlabel = "MJ"\npath = "hermite"\nintegrator = {kind = "moreau_jean", theta = 0.6}\n'
        '[[method]]\npath = "self_similar"\n'
    )
    first, second = methods_from_file(file)
    assert (first.label, first.integrator.theta, second.label) == ("MJ", 0.6, "Self-similar")
    with pytest.raises(InputError, match="given twice"):
        methods_of(["hermite", "exudyn", "hermite"])
    (changed,) = methods_of(["hermite"], ["hermite.integrator.kind=moreau_jean"])
    assert changed.label == "Hermite, integrator=moreau_jean"
    assert (
        changed.integrator == replace(method_from_tables("hermite", {"integrator": {"kind": "moreau_jean"}})).integrator
    )


LISTS = Path(__file__).resolve().parents[2] / "cases" / "methods"


@pytest.mark.parametrize("file", sorted(LISTS.glob("*.toml")), ids=lambda file: file.stem)
def test_every_shipped_list_can_be_asked_for(file):
    assert methods_from_file(file)


@pytest.mark.parametrize(("name", "types"), [("all", (HermiteFE, ExudynModel)), ("hermite", (HermiteFE,))])
def test_a_list_of_all_pairs_holds_every_integrator_with_every_contact(name, types):
    methods = methods_from_file(LISTS / f"{name}.toml")
    for kind in types:
        pairs = [(type(m.integrator), type(m.contact)) for m in methods if isinstance(m, kind)]
        parts = (kind.PARTS[part].values() for part in ("integrator", "contact"))
        assert len(pairs) == len(set(pairs)) and set(pairs) == set(product(*parts))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "at least one"),
        ("method = 3", "at least one"),
        ("[[metod]]\npath = 1", "did you mean method"),
        ("[[method]]\nlabel = 1\npath = 'hermite'", "label must be"),
        ("[[method]]\nlabel = 'x'", "path is required"),
        ("[[method]]\npath = 'hermit'", "did you mean hermite"),
        ("[[method]]\npath = 'hermite'\nintegator = {}", "did you mean integrator"),
        ("[[method]]\npath = 'hermite'\n[[method]]\npath = 'hermite'", "given twice"),
    ],
)
def test_a_bad_methods_file_is_refused_in_one_line(tmp_path, text, message):
    file = tmp_path / "methods.toml"
    file.write_text(text)
    with pytest.raises(InputError, match=message):
        methods_from_file(file)


def test_rows_are_the_contract():
    row = answer(Question(SelfSimilarFE(), 0.5), KEEP)
    wanted = {
        "label", "path", "settings", "kappa_over_nu", "alpha", "psi", "chi", "axial", "lambda0", "r0", "lambda1",
        "r1", "lift", "pull", "seconds", "refine", "warnings",
    }  # fmt: skip
    assert isinstance(row, MatchRow)
    assert wanted <= set(match_document([row])["rows"][0])


def test_a_missing_number_is_missing():
    assert Compared().relative() is None
    assert Compared(float("nan"), float("inf"), 2.0) == Compared(None, None, 2.0)
    assert Compared(2.0, 0.1, None).covered is None
    assert str(Compared()) == "-"
    assert Compared(0.5, 0.2, 0.0).relative() == 0.5  # absolute where theory is 0


@pytest.mark.parametrize("bad", [(-1.0, None), (0.5, (float("nan"), 0, 0, 0))])
def test_impossible_questions_are_refused(bad):
    with pytest.raises(ValueError, match=r"kappa_over_nu|alpha"):
        Question(SelfSimilarFE(), *bad)
