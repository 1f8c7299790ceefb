"""The point of the project: theory, Hermite and Exudyn agree at leading and first order, and stay so."""

import json

import pytest

from comparison.matching import MatchFailure, MatchRow, Question, answer, match, questions
from comparison.store import RunStore
from comparison.tables import match_document, match_table, relative_error, write_match

KEEP = RunStore(None)


@pytest.mark.parametrize("kappa", [0.05, 0.25, 0.5, 0.9])
def test_hermite_matches_the_leading_order(kappa):
    row = answer(Question("hermite", kappa), KEEP)
    assert row.lambda0 == pytest.approx(row.lambda0_theory, rel=2e-4)
    assert row.r0 == pytest.approx(row.r0_theory, rel=1e-4)
    assert row.flatness < (1e-5 if kappa >= 0.25 else 5e-4)
    assert row.warnings == []


@pytest.mark.parametrize("kappa", [0.25, 0.5])
def test_exudyn_matches_the_leading_order(kappa):
    row = answer(Question("exudyn", kappa), KEEP)
    assert row.lambda0 == pytest.approx(row.lambda0_theory, rel=5e-4)
    assert row.r0 == pytest.approx(row.r0_theory, rel=2e-4)


def test_discrete_contact_on_both_paths():
    """κ/ν ≥ 1: λ₀ = 0, r₀ = ν, r₁ = 2α."""
    row = answer(Question("hermite", 1.25, (1.0, 0.0, 0.0)), KEEP)
    assert row.regime == "discrete"
    assert row.lambda0 == 0.0
    assert row.r0 == pytest.approx(1.0, rel=1e-4)
    assert row.r1 == pytest.approx(2.0, rel=5e-3)
    assert answer(Question("exudyn", 1.25), KEEP).r0 == pytest.approx(1.0, rel=1e-3)


@pytest.mark.parametrize(
    ("kappa", "first"),
    [(0.5, (4.0, 0.0, 0.0)), (0.5, (-1.0, -1.0, 0.0)), (0.3, (-1.0, -1.0, 1.0)), (0.8, (0.0, 0.0, 1.0))],
)
def test_hermite_matches_the_first_order(kappa, first):
    row = answer(Question("hermite", kappa, first), KEEP)
    assert abs(relative_error(row.lambda1, row.lambda1_theory)) < 0.01
    assert abs(relative_error(row.r1, row.r1_theory)) < 0.01
    assert abs(row.lambda1 - row.lambda1_theory) <= row.lambda1_error
    assert abs(row.r1 - row.r1_theory) <= row.r1_error


@pytest.mark.verify
@pytest.mark.parametrize("kappa", [0.1, 0.3, 0.5, 0.8])
@pytest.mark.parametrize(
    "first",
    [(1, 0, 0), (0, 1, 0), (0, 0, 1), (4, 0, 0), (0, 2, 0), (1, 1, 1), (-1, 0, 0), (-1, -1, 0), (-1, -1, 1)],
)
def test_hermite_matches_the_first_order_everywhere(kappa, first):
    row = answer(Question("hermite", kappa, tuple(map(float, first))), KEEP)
    limit = 0.03 if kappa == 0.1 else 0.01
    assert abs(relative_error(row.lambda1, row.lambda1_theory)) < limit
    assert abs(relative_error(row.r1, row.r1_theory)) < limit


@pytest.mark.verify
@pytest.mark.parametrize("first", [(4.0, 0.0, 0.0), (1.0, 1.0, 1.0), (-1.0, -1.0, 0.0)])
def test_exudyn_matches_the_first_order(first):
    row = answer(Question("exudyn", 0.5, first), KEEP)
    assert abs(relative_error(row.lambda1, row.lambda1_theory)) < 0.04
    assert abs(relative_error(row.r1, row.r1_theory)) < 0.03


@pytest.mark.verify
@pytest.mark.parametrize("kappa", [0.05, 0.1, 0.8, 0.9])
def test_exudyn_matches_the_leading_order_everywhere(kappa):
    row = answer(Question("exudyn", kappa), KEEP)
    assert row.lambda0 == pytest.approx(row.lambda0_theory, rel=5e-3)
    assert row.r0 == pytest.approx(row.r0_theory, rel=5e-3)


def test_a_sweep_resumes_and_does_not_depend_on_jobs(tmp_path):
    asked = questions(["hermite"], [0.5, 0.25, 2.0])
    first, _ = match(asked[:2], store=RunStore(tmp_path))
    kept = {f.name: f.read_bytes() for f in tmp_path.iterdir()}
    both, _ = match(asked, store=RunStore(tmp_path), jobs=2)
    assert both[:2] == first  # from the store: seconds and all
    assert {f.name: f.read_bytes() for f in tmp_path.iterdir() if f.name in kept} == kept
    alone, _ = match(asked[2:])
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


def test_a_failed_run_does_not_take_the_others_along(monkeypatch, tmp_path):
    import comparison.matching as matching

    whole = matching.answer

    def sometimes(question, store):
        if question.kappa_over_nu == 0.25:
            raise ArithmeticError("no luck")
        return whole(question, store)

    monkeypatch.setattr(matching, "answer", sometimes)
    rows, failures = match(questions(["hermite"], [0.5, 0.25, 2.0]))
    assert [r.kappa_over_nu for r in rows] == [0.5, 2.0]
    assert isinstance(failures[0], MatchFailure)
    assert "no luck" in failures[0].reason
    assert failures[0].rerun == "bentbeam match --path hermite --kappa-over-nu 0.25"
    files = write_match(rows, failures, tmp_path)
    assert all(f.stat().st_size > 100 for f in files)
    document = json.loads((tmp_path / "match.json").read_text())
    assert document == json.loads(json.dumps(match_document(rows, failures)))
    assert "no luck" in match_table(rows, failures)


def test_rows_are_the_contract():
    row = answer(Question("hermite", 0.5), KEEP)
    assert isinstance(row, MatchRow)
    wanted = {
        "path",
        "kappa_over_nu",
        "alpha",
        "psi",
        "chi",
        "lambda0",
        "lambda0_theory",
        "r0",
        "r0_theory",
        "lambda1",
        "lambda1_theory",
        "r1",
        "r1_theory",
        "flatness",
        "seconds",
    }
    assert wanted <= set(vars(row))


@pytest.mark.parametrize("bad", [("fem", 0.5, None), ("hermite", -1.0, None), ("hermite", 0.5, (float("nan"), 0, 0))])
def test_impossible_questions_are_refused(bad):
    with pytest.raises(ValueError, match=r"path|kappa_over_nu|alpha"):
        Question(*bad)
