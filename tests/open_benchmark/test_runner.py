"""An adapter that misbehaves is a row with a reason; the others go on, and what was done is not done again."""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

import pytest

from open_benchmark.adapter import Adapter, chosen_adapters, shipped_adapters
from open_benchmark.campaign import campaign
from open_benchmark.page import write_page
from open_benchmark.problem import problem
from open_benchmark.running import Limits, run_adapter

GOOD = """
import sys, numpy as np
from pathlib import Path
tau = np.linspace(0, 0.1, 300)
Path({log!r}).open("a").write(sys.argv[3] + chr(10))
np.savez(sys.argv[2], outcome="completed", problem="point-2", metadata='{{"seconds": 0.5}}',
         tau=tau, J=4 * np.sqrt(2 / np.pi) * np.sqrt(tau), Jm=0 * tau)
"""


def adapter(tmp_path: Path, name: str, source: str) -> Adapter:
    file = tmp_path / f"{name}.py"
    file.write_text(source)
    return Adapter(name, file)


def outcome(tmp_path: Path, source: str, **limits: float) -> tuple[str, str]:
    one = adapter(tmp_path, "one", source)
    given = Limits(seconds=limits.get("seconds", 30.0), output_bytes=int(limits.get("output_bytes", 20_000_000)))
    run = run_adapter(one, problem("point-2"), "coarse", tmp_path / "kept" / "r.npz", given)
    assert not list((tmp_path / "kept").glob(".run-*")), "the run's folder is gone"
    return run.outcome, run.reason


def test_a_crash_is_told_by_the_last_line_of_standard_error(tmp_path: Path) -> None:
    assert outcome(tmp_path, "raise RuntimeError('no licence')") == ("crashed", "RuntimeError: no licence")
    assert outcome(tmp_path, "import os, signal; os.kill(os.getpid(), signal.SIGSEGV)")[1].startswith("signal SIGSEGV")
    assert outcome(tmp_path, "")[1] == "left no result.npz or result.json"


def test_a_hang_is_a_timeout_and_takes_its_children_along(tmp_path: Path) -> None:
    pid = tmp_path / "child.pid"
    source = f"""
import subprocess, sys, time
child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"], start_new_session=True)
open({str(pid)!r}, "w").write(str(child.pid))
time.sleep(60)
"""
    assert outcome(tmp_path, source, seconds=3.0)[0] == "timeout"
    number = int(pid.read_text())
    for _ in range(50):
        if not _alive(number):
            break
        time.sleep(0.05)
    assert not _alive(number)


def _alive(number: int) -> bool:
    try:
        state = Path(f"/proc/{number}/stat").read_text().rsplit(")", 1)[1].split()[0]
    except OSError:
        return False
    return state != "Z"


@pytest.mark.parametrize(
    "source",
    [
        "f = open('big', 'wb')\nwhile True: f.write(bytes(1000000)); f.flush()",
        "import itertools\nfor k in itertools.count(): open(f'f{k}', 'wb').write(bytes(1000000))",
        "import sys\nwhile True: print('x' * 100000)",
    ],
)
def test_filling_the_disk_ends_the_run(tmp_path: Path, source: str) -> None:
    found, reason = outcome(tmp_path, source, output_bytes=5_000_000)
    assert found == "crashed" and reason


def test_rubbish_and_a_wrong_problem_are_invalid(tmp_path: Path) -> None:
    assert outcome(tmp_path, "import sys; open(sys.argv[2], 'wb').write(b'rubbish')")[0] == "invalid"
    other = GOOD.format(log=str(tmp_path / "log")).replace("point-2", "point-3")
    assert outcome(tmp_path, other) == ("invalid", "problem is point-3, asked was point-2")
    link = "import sys, os; os.symlink('/etc/passwd', sys.argv[2])"
    assert outcome(tmp_path, link)[0] == "crashed"


def test_a_result_counts_whatever_the_exit_status_says(tmp_path: Path) -> None:
    source = GOOD.format(log=str(tmp_path / "log")) + "sys.exit(7)"
    assert outcome(tmp_path, source) == ("", "")


def test_one_bad_adapter_is_a_row_and_finished_runs_are_kept(tmp_path: Path) -> None:
    log = tmp_path / "log"
    good = adapter(tmp_path, "good", GOOD.format(log=str(log)))
    bad = adapter(tmp_path, "bad", "raise SystemExit('cannot')")
    none = Adapter("none", good.file, install=("nothing==1",), environment="not-there", module="nothing")
    rows = [campaign([bad, none, good], ["point-2"], tmp_path / "out") for _ in range(2)][-1]
    assert log.read_text().split() == ["coarse", "medium", "fine"], "the second campaign ran nothing again"
    assert [r.score.outcome for r in rows] == ["crashed"] * 3 + ["not_installed"] * 3 + ["completed"] * 3
    assert rows[3].score.reason == "bentbeam benchmark --install none"
    assert abs(rows[-1].score.error("r0") or 1.0) < 1e-9
    page = write_page(rows, [bad, none, good], tmp_path / "out").read_text()
    assert page.count("<svg") == 1 and "cannot" in page and "not installed" in page


def test_a_folder_that_is_given_relative_to_where_one_stands(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    good = adapter(tmp_path, "good", GOOD.format(log=str(tmp_path / "log")))
    rows = campaign([good], ["point-2"], Path("out"), resolutions=["coarse"])
    assert [row.score.outcome for row in rows] == ["completed"], rows[0].score.reason


def test_a_changed_adapter_runs_again(tmp_path: Path) -> None:
    log = tmp_path / "log"
    for comment in ("", "# better"):
        good = adapter(tmp_path, "good", GOOD.format(log=str(log)) + comment)
        campaign([good], ["point-2"], tmp_path / "out", resolutions=["coarse"])
    assert log.read_text().split() == ["coarse", "coarse"]


@pytest.mark.parametrize("name", ["source_digest", "versions"])
def test_a_changed_solver_of_this_project_runs_again_and_no_foreign_one(
    monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    shipped = shipped_adapters()
    before = {key: one.digest() for key, one in shipped.items()}
    monkeypatch.setattr(f"open_benchmark.adapter.{name}", lambda: "of tomorrow")
    assert {key for key, one in shipped.items() if one.digest() != before[key]} == {"hermite", "exudyn"}


def test_foreign_adapters_import_nothing_of_this_project() -> None:
    for one in shipped_adapters().values():
        if one.install or one.debian:
            source = one.file.read_text()
            assert not any(name in source for name in ("bent_beam", "hermite_fe", "theory import", "open_benchmark")), (
                one.name
            )


def test_an_executable_in_any_language_is_an_adapter(tmp_path: Path) -> None:
    file = tmp_path / "mine"
    file.write_text(f"#!{sys.executable}\n" + GOOD.format(log=str(tmp_path / "log")))
    assert chosen_adapters(own=[file])[0].missing() == f"{file} is not executable"
    os.chmod(file, 0o755)
    rows = campaign(chosen_adapters(own=[file]), ["point-2"], tmp_path / "out", resolutions=["coarse"])
    assert rows[0].score.outcome == "completed"
