"""What was computed is printed: one failure costs one row, whoever caused it; streams and names cost nothing."""

import importlib
import io
import json
import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from unittest.mock import Mock

import pytest
from called import MAIN, answered, command, refused, started
from strangers import Plain, Unlabelled

from bent_beam import method as methods
from bent_beam.measure.reduction import peak_moment
from comparison.command_line import __main__ as start
from comparison.command_line import app, histories
from comparison.command_line.options import emit, emit_with_files
from comparison.matching import PERTURBATION, match
from comparison.rows import MatchQuestion, first_order_epsilon
from comparison.store import RunStore, code_of, source_digest, source_of
from hermite_fe import HermiteFE
from hermite_fe.contacts import NodeContact

NO_METHODS = [lambda: sys.exit("bye"), lambda: SimpleNamespace, lambda: Unlabelled]
MATCH = ("match", "--path", "theirs", "--kappa-over-nu", "2")


@pytest.mark.parametrize("load", NO_METHODS, ids=["exits when loaded", "is no dataclass", "has no label"])
def test_what_is_no_method_is_refused_by_name_and_ends_no_other_command(load, monkeypatch):
    monkeypatch.setattr(methods, "_found", lambda: {"theirs": SimpleNamespace(load=load)})
    assert "'theirs' is installed but" in refused(*MATCH)
    assert len(answered("settings")) > 20


def test_an_impossible_row_costs_itself():
    (row,) = match([MatchQuestion(HermiteFE(), 1e300)])
    assert "must not exceed" in row.reason and not row.refused and row.r0.value is None
    with pytest.raises(ValueError, match="first_order"):
        first_order_epsilon(SimpleNamespace(front=0.0), (1e-100, 0.0, 0.0, 0.0), PERTURBATION, 0.1)


def test_a_full_disk_under_out_costs_the_files_and_no_answer(monkeypatch):
    full = Mock(side_effect=OSError(28, "No space left on device", "out/match.json"))
    monkeypatch.setattr("comparison.figures.matching.write_match", full)
    monkeypatch.setattr(methods, "_found", lambda: {"theirs": SimpleNamespace(load=lambda: Plain)})
    code, out, err = command(*MATCH, "--out", "out", "--json")
    assert code == 2 and len(json.loads(out)["rows"]) == 1 and "No space left" in err


def test_files_are_written_before_an_answer_that_nobody_reads_on(tmp_path):
    written = Mock()
    with pytest.raises(BrokenPipeError):
        emit_with_files({}, False, Mock(side_effect=BrokenPipeError), tmp_path, written)
    written.assert_called_once_with(tmp_path)


def test_a_terminal_without_greek_letters_gets_the_answer(monkeypatch):
    stream = io.BytesIO()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(stream, "ascii"))
    app._open_closed_streams()
    emit({"a": "λ₀ ü"}, True, str)
    emit({}, False, lambda: "λ₀ = 1")
    sys.stdout.flush()
    document, text = stream.getvalue().decode("ascii").splitlines()
    assert json.loads(document) == {"a": "λ₀ ü"} and text.endswith(" = 1")


def test_a_reader_that_has_read_enough_is_no_failure_and_a_full_disk_is_one():
    reader, writer = os.pipe()
    os.close(reader)
    for stream, code, lines in ((writer, 0, 0), (os.open("/dev/full", os.O_WRONLY), 2, 1)):
        process = started("new", f"{code}.toml", stdout=stream, env=os.environ | {"PYTHONUNBUFFERED": ""})
        os.close(stream)
        said = process.communicate(timeout=60)[1]
        assert (process.returncode, said.count("\n")) == (code, lines), said


@pytest.mark.parametrize("number", [2, *(pytest.param(number, marks=pytest.mark.verify) for number in (0, 1))])
def test_a_closed_standard_stream_is_no_file_that_is_opened_later(number):
    """As cron jobs and daemons are started: nothing is said there, and nothing of it lands anywhere else."""
    assert command("new", "good.toml")[0] == 0
    closed = "<&-" if number == 0 else f"{number}>&-"
    line = ["sh", "-c", f'exec "$0" -c "$1" new beam.toml {closed}', sys.executable, MAIN]
    for code in (0, 2):  # the second time it is there already
        done = subprocess.run(line, capture_output=True, text=True)
        assert done.returncode == code, done.stderr
        assert bool(done.stdout) == (code == 0 and number != 1)
        assert done.stderr.count("\n") == (code == 2 and number != 2)
        assert Path("beam.toml").read_text() == Path("good.toml").read_text()


def test_an_interrupt_before_anything_has_begun_is_one_line(monkeypatch, capsys):
    with pytest.raises(SystemExit, match="130"), monkeypatch.context() as interrupted:
        interrupted.setattr("builtins.__import__", Mock(side_effect=KeyboardInterrupt))
        start.main()
    assert capsys.readouterr().err == "error: interrupted; nothing had begun\n"


DIGITS = ["theory --kappa-over-nu 1_0", "theory --kappa-over-nu=９", "theory --kappa-over-nu 2 --alpha ٣"]
FILES = ["predict 2026_11", "bounce 2026_11.toml --out 2026_11", "bounce c.toml --out=1_0"]


@pytest.mark.parametrize("words", DIGITS + FILES)
def test_a_number_is_written_with_digits_and_a_file_may_be_called_like_one(words):
    assert ("plain number" if words in DIGITS else "no such file") in refused(*words.split())


def test_two_histories_of_one_name_are_two_pictures(monkeypatch):
    drawn = []
    monkeypatch.setattr("bent_beam.history.ImpactHistory.load", lambda file: file)
    monkeypatch.setattr("comparison.figures.history.draw_history", lambda _, out, name, kinds: drawn.append(name) or [])
    histories.plot([Path(name) for name in ("a/run.nc", "b/run.nc", "run-2.nc")])
    assert drawn == ["run", "run-2", "run-2-2"]


def test_runs_with_parts_that_neither_the_project_nor_a_package_brought_are_not_kept(tmp_path, monkeypatch):
    """Which files they depend on nobody knows: helpers without a package, or named like a standard module."""
    law = "from hermite_fe.contacts import NodeContact\nclass Soft(NodeContact):\n    pass\n"
    (tmp_path / "own_law.py").write_text(law)
    monkeypatch.syspath_prepend(tmp_path)
    soft = importlib.import_module("own_law").Soft()
    assert source_of(HermiteFE()) == source_of(HermiteFE(contact=NodeContact())) == "hermite_fe.method.HermiteFE"
    assert source_of(HermiteFE(contact=soft)) is None
    store, count = RunStore(tmp_path / "store"), iter(range(9))
    answers = [store.answer({"source": None}, lambda: {"n": next(count)})["n"] for _ in range(2)]
    assert answers == [0, 1] and not list(tmp_path.rglob("*.json"))
    monkeypatch.setattr("comparison.store.installed", lambda: (tmp_path.resolve(),))
    assert source_of(HermiteFE(contact=soft)).startswith("hermite_fe.method.HermiteFE ")


def test_sources_edited_while_a_process_is_open_are_nobody_elses(monkeypatch):
    today, *_ = source_digest().split()
    monkeypatch.setattr("comparison.store.LOADED", 0.0)
    found = source_digest.__wrapped__()
    assert found.startswith(today) and str(os.getpid()) in found


def test_a_program_that_does_not_load_costs_its_own_command(monkeypatch, capsys):
    broken = SimpleNamespace(name="theirs", load=lambda: importlib.import_module("no_such_module"))
    monkeypatch.setattr(app.metadata, "entry_points", lambda group: [broken])
    app.add_programs.__wrapped__()
    assert "'theirs' is installed but does not load (ModuleNotFoundError" in capsys.readouterr().err


def test_a_reading_of_somebody_s_own_is_kept_with_its_code(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(tmp_path)
    (tmp_path / "own_reading.py").write_text("def read(history):\n    return {}\n")
    read = importlib.import_module("own_reading").read
    before = code_of(read)
    (tmp_path / "own_reading.py").write_text("def read(history):\n    return {'energy': 1}\n")
    assert before.startswith("own_reading.read ") and code_of(read) != before
    assert code_of(peak_moment) == "bent_beam.measure.reduction.peak_moment"
