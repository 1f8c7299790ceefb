"""What was computed is printed: one failure costs one row, whoever caused it."""

import io
import json
import os
import subprocess
import sys
from dataclasses import dataclass
from types import SimpleNamespace
from typing import ClassVar

import pytest
from called import answered, command, refused

from bent_beam import method as methods
from comparison.command_line import __main__ as start
from comparison.command_line import app, histories
from comparison.command_line.options import emit
from comparison.match import PERTURBATION, match
from comparison.rows import Question, first_order_epsilon
from comparison.store import behind
from hermite_fe import HermiteFE

MAIN = "from comparison.command_line.app import main; main()"


@dataclass(frozen=True)
class Theirs:
    """Somebody's method that does what none may do."""

    path: ClassVar[str] = "theirs"
    does: ClassVar[object] = None
    label: str = "theirs"

    def refuses(self, impact):
        return None

    def simulate(self, impact, **how):
        if isinstance(self.does, BaseException):
            raise self.does
        return self.does


def ended():
    raise SystemExit("bye")


@dataclass(frozen=True)
class Unlabelled:
    path: ClassVar[str] = "theirs"

    def refuses(self, impact):
        return None

    simulate = Theirs.simulate


NO_METHODS = {
    "exits when it is loaded": ended,
    "is no dataclass": lambda: SimpleNamespace,
    "is a function": lambda: ended,
    "has no label": lambda: Unlabelled,
}


def install(monkeypatch, load):
    monkeypatch.setattr(methods, "_found", lambda: {"theirs": SimpleNamespace(load=load)})


@pytest.mark.parametrize("does", [SystemExit(3), KeyError("x"), None, 5], ids=repr)
def test_a_method_that_does_what_none_may_do_costs_its_row(does, monkeypatch):
    install(monkeypatch, lambda: Theirs)
    monkeypatch.setattr(Theirs, "does", does)
    code, out, err = command("match", "--path", "theirs", "--kappa-over-nu", "2", "--fresh", "--json")
    (row,) = json.loads(out)["rows"]
    assert code == 3 and "the method failed" in row["reason"] and err.count("\n") == 1
    code, out, err = command("bounce", "--path", "theirs", "--kappa-over-nu", "2", "--damping", "0.1")
    assert code == 2 and err.count("\n") == 1  # it has no choices for the whole beam


@pytest.mark.parametrize("load", NO_METHODS.values(), ids=NO_METHODS)
def test_what_is_no_method_is_refused_by_name_and_ends_no_other_command(load, monkeypatch):
    install(monkeypatch, load)
    assert "'theirs' is installed but" in refused("match", "--path", "theirs", "--kappa-over-nu", "2")
    assert len(answered("settings")) > 20


def test_an_impossible_row_costs_itself():
    (row,) = match([Question(HermiteFE(), 1e300)])
    assert "must not exceed" in row.reason and not row.refused and row.r0.value is None
    leading = SimpleNamespace(front=0.0)
    with pytest.raises(ValueError, match="first_order"):
        first_order_epsilon(leading, (1e-100, 0.0, 0.0, 0.0), PERTURBATION, 0.1)


def test_a_full_disk_under_out_costs_the_files_and_no_answer(monkeypatch, tmp_path):
    def full(*_):
        raise OSError(28, "No space left on device", "out/match.json")

    monkeypatch.setattr("comparison.tables.write_match", full)
    install(monkeypatch, lambda: Theirs)
    code, out, err = command(
        "match", "--path", "theirs", "--kappa-over-nu", "2", "--fresh", "--out", tmp_path, "--json"
    )
    assert code == 2 and len(json.loads(out)["rows"]) == 1 and "No space left" in err


@pytest.mark.parametrize("encoding", ["ascii", "latin-1"])
def test_a_terminal_without_greek_letters_gets_the_answer(encoding, monkeypatch):
    stream = io.BytesIO()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(stream, encoding))
    app._open_closed_streams()
    emit({"a": "λ₀ ü"}, True, str)
    emit({}, False, lambda: "λ₀ = 1")
    sys.stdout.flush()
    document, text = stream.getvalue().decode(encoding).splitlines()
    assert json.loads(document) == {"a": "λ₀ ü"} and text.endswith(" = 1")


def test_a_reader_that_has_read_enough_is_no_failure():
    reader, writer = os.pipe()
    os.close(reader)
    line = [sys.executable, "-c", MAIN, "theory", "--kappa-over-nu", "2"]
    done = subprocess.run(line, stdout=writer, stderr=subprocess.PIPE)
    os.close(writer)
    assert (done.returncode, done.stderr) == (0, b"")


def test_an_interrupt_before_anything_has_begun_is_one_line(monkeypatch, capsys):
    class Interrupted:
        def find_spec(self, name, *_):
            if name == "comparison.command_line.app":
                raise KeyboardInterrupt

    monkeypatch.delitem(sys.modules, "comparison.command_line.app")
    monkeypatch.delattr("comparison.command_line.app")
    monkeypatch.setattr(sys, "meta_path", [Interrupted(), *sys.meta_path])
    with pytest.raises(SystemExit, match="130"):
        start.main()
    assert capsys.readouterr().err == "error: interrupted; nothing had begun\n"


SWALLOWED = """
import os, signal, time
from comparison.command_line import app

def simulate(**_):
    try:
        os.kill(os.getpid(), signal.SIGINT)
    except KeyboardInterrupt:
        time.sleep(60)

app.app, app.PATIENCE = simulate, 0.2
app.main(["simulate"])
"""


def test_an_interrupt_that_a_solver_swallows_comes_again():
    done = subprocess.run([sys.executable, "-c", SWALLOWED], capture_output=True, text=True, timeout=30)
    assert done.returncode == 130 and done.stderr.count("\n") == 1, done.stderr


@pytest.mark.parametrize("words", ["--kappa-over-nu 1_0", "--kappa-over-nu=９", "--kappa-over-nu 2 --alpha ٣"])
def test_a_number_is_written_with_digits(words):
    assert "plain number" in refused("theory", *words.split())


def test_two_histories_of_one_name_are_two_pictures(monkeypatch):
    drawn = []
    monkeypatch.setattr("bent_beam.history.ImpactHistory.load", lambda file: file)
    monkeypatch.setattr(
        "comparison.figures.history.draw_history", lambda history, out, name, kinds: drawn.append(name) or []
    )
    histories.plot([histories.Path(name) for name in ("a/run.nc", "b/run.nc", "run-2.nc")])
    assert drawn == ["run", "run-2", "run-2-2"]


def test_a_stored_run_is_stale_when_what_its_method_imports_changes(tmp_path):
    (tmp_path / "method.py").write_text("import json, numpy, helper\n")
    (tmp_path / "helper.py").write_text("from deeper import h\n")
    (tmp_path / "deeper.py").write_text("h = 1\n")
    before = behind([tmp_path / "method.py"], tmp_path)
    (tmp_path / "deeper.py").write_text("h = 2\n")
    after = behind([tmp_path / "method.py"], tmp_path)
    assert before != after and before[1:] == after[1:] and before[-1].startswith("numpy ")


SIZES = (
    "section.outer_diameter=1e154 section.density=5e-324 section.density=1e-70 section.fluid_density=1.7e308 "
    "section.inner_diameter=1e200 section.yield_stress=5e-324 section.outer_diameter=1e55 beam.length=1e200 "
    "beam.sagitta_length=1e200 beam.dogleg=1e300 beam.damping=1e308"
).split()


@pytest.mark.parametrize("size", SIZES)
def test_sizes_that_cannot_be_calculated_with_are_refused_by_name(size, tmp_path):
    case = tmp_path / "case.toml"
    case.write_text(
        '[section]\nkind = "pipe"\nouter_diameter = 0.1\ninner_diameter = 0.09\nyoungs_modulus = 2e11\ndensity = 7850\n'
        "[beam]\nlength = 30\nsagitta = 0.1\nsagitta_length = 9\n[impact]\nvelocity = 1\n"
    )
    assert size.partition(".")[0] in refused("predict", case, "--theory-only", "--set", size)
