"""Killed, torn, dying, lost: a second start finishes with the same rows, and nothing broken is read as good."""

import contextlib
import io
import json
import math
import os
import random
import signal
import subprocess
import sys
import time

import pytest

from comparison.command_line import run
from comparison.matching import Question, match
from comparison.store import RunStore, write_atomically
from comparison.workers import run_all

FUZZ = bool(os.environ.get("FUZZ"))
RANDOM = random.Random(int(os.environ.get("FUZZ_SEED", "0")))
MAIN = "from comparison.command_line import main; main()"
KAPPAS = [item for kappa in ("0.5", "0.3", "2.0") for item in ("--kappa-over-nu", kappa)]
MATCH = ["match", "--path", "hermite", *KAPPAS, "--json"]


def start(arguments, store, **options):
    """The command in a session of its own, so that a kill takes its workers too, as a power cut would."""
    environment = os.environ | {"BENTBEAM_STORE": str(store), "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    return subprocess.Popen(
        [sys.executable, "-c", MAIN, *map(str, arguments)],
        env=environment,
        start_new_session=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        **options,
    )


def killed(process, after):
    """Kill -9 ``after`` s; True when it was still at work."""
    try:
        process.communicate(timeout=after)
        return False
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return True


def killed_after_its_first_run(process, store):
    """Kill -9 as soon as one run is kept, however fast the machine; True when it was still at work."""
    while process.poll() is None and not any(store.glob("*.json")):
        time.sleep(0.005)
    working = process.poll() is None
    if working:
        os.killpg(process.pid, signal.SIGKILL)
    process.communicate()
    return working


def finished(arguments, store, limit=590):
    out, err = start(arguments, store).communicate(timeout=limit)
    return out, err


def rows_of(text):
    rows = json.loads(text)["rows"]
    return [{key: value for key, value in row.items() if key != "seconds"} for row in rows]


def every_kept_run_is_whole(store):
    files = [f for f in store.glob("*.json") if not f.name.startswith(".")] if store.exists() else []
    for file in files:
        assert RunStore._read(file) is not None, file
    return len(files)


@pytest.fixture(scope="module")
def reference(tmp_path_factory):
    began = time.perf_counter()
    out, _ = finished(MATCH, tmp_path_factory.mktemp("reference"))
    return rows_of(out), time.perf_counter() - began


def test_a_killed_match_starts_again_and_ends_with_the_same_rows(reference, tmp_path):
    rows, duration = reference
    kills, wanted = 0, 42 if FUZZ else 2
    for series in range(200):
        store = tmp_path / f"store-{series}"
        jobs = ["--jobs", RANDOM.choice(["1", "2"])] if FUZZ else []
        kills += killed_after_its_first_run(start([*MATCH, *jobs], store), store)
        for _ in range(2):
            kills += killed(start([*MATCH, *jobs], store), RANDOM.uniform(0.3, 0.9) * duration)
            every_kept_run_is_whole(store)
        if kills >= wanted or not FUZZ or series % 5 == 0:
            assert rows_of(finished(MATCH, store)[0]) == rows
            assert every_kept_run_is_whole(store) >= 3
        if kills >= wanted or not FUZZ:
            break
    print(f"match: {kills} kills")
    assert kills >= (wanted if FUZZ else 1)


@pytest.mark.skipif(not FUZZ, reason="minutes: FUZZ=1")
def test_a_killed_gallery_starts_again_and_ends_with_the_same_figures(tmp_path):
    items = ["fig-2.5", "fig-2.7a", "fig-2.7b", "fig-2.9"]
    listed = {e["id"] for e in json.loads(finished(["gallery", "--list", "--json"], tmp_path / "s")[0])}
    items = [i for i in items if i in listed] or sorted(listed)[:4]
    began = time.perf_counter()
    finished(["gallery", *items, "--out", tmp_path / "whole", "--json"], tmp_path / "s")
    duration = time.perf_counter() - began
    kills = 0
    out = tmp_path / "killed"
    for _ in range(20):
        kills += killed(start(["gallery", *items, "--out", out], tmp_path / "s"), RANDOM.uniform(0.2, 0.95) * duration)
        if kills == 5:
            break
    drawn = json.loads(finished(["gallery", *items, "--out", out, "--json"], tmp_path / "s")[0])
    assert {d["id"] for d in drawn["drawn"]} == set(items) and not drawn["failures"]
    tables = sorted(f.relative_to(tmp_path / "whole") for f in (tmp_path / "whole").rglob("*.csv"))
    assert tables
    for table in tables:
        assert (out / table).read_bytes() == (tmp_path / "whole" / table).read_bytes()
    print(f"gallery: {kills} kills")


@pytest.mark.skipif(not FUZZ, reason="minutes: FUZZ=1")
def test_a_killed_report_leaves_no_page_and_no_broken_run(tmp_path):
    """What is in the store goes into the next start; a page is there whole or not at all."""
    out, store, kills = tmp_path / "report", tmp_path / "store", 0
    for _ in range(5):
        kills += killed(start(["report", "--out", out, "--overwrite"], store), RANDOM.uniform(3.0, 25.0))
        every_kept_run_is_whole(store)
        page = out / "index.html"
        assert not page.exists() or page.read_text().rstrip().endswith("</html>")
    assert kills >= 3
    print(f"report: {kills} kills, {every_kept_run_is_whole(store)} runs kept")


# --- the store ------------------------------------------------------------


def test_a_flipped_or_cut_file_is_never_read_as_good(tmp_path):
    store, asked = RunStore(tmp_path), {"question": 1}
    answer = {"numbers": [1.5, 2.25, -3e-7], "words": ["a", "b"]}
    assert store.answer(asked, lambda: answer) == answer
    (file,) = tmp_path.glob("*.json")
    good, numbers = file.read_bytes(), random.Random(5)
    damages = [good[:n] for n in range(0, len(good), 7)]
    for _ in range(300):
        place = numbers.randrange(len(good))
        damages.append(good[:place] + bytes([good[place] ^ (1 << numbers.randrange(8))]) + good[place + 1 :])
    damages += [b"[" * 100_000, b"null", b'{"answer": NaN, "sha256": ""}', os.urandom(200)]
    for damage in damages:
        file.write_bytes(damage)
        read = RunStore._read(file)
        assert read is None or read == answer
    file.write_bytes(damages[3])
    assert store.answer(asked, lambda: answer) == answer and file.read_bytes() == good


def test_a_write_that_fails_leaves_what_was_there(tmp_path, monkeypatch):
    file = tmp_path / "a.json"
    write_atomically(file, "old")
    monkeypatch.setattr(os, "replace", lambda *_: (_ for _ in ()).throw(OSError(28, "No space left on device")))
    with pytest.raises(OSError):
        write_atomically(file, "new")
    assert file.read_text() == "old" and [f.name for f in tmp_path.iterdir()] == ["a.json"]


# --- workers that die, and runs that fail ------------------------------------------------------------


def survives(number):
    if number == 3:
        os._exit(9)
    return number * number


def test_a_worker_that_dies_takes_no_other_call_with_it():
    dead = []
    found = run_all(survives, [(n,) for n in range(6)], jobs=2, on_death=lambda i, why: dead.append((i, why)) or "dead")
    assert found == [0, 1, 4, "dead", 16, 25]
    assert [i for i, _ in dead] == [3] and "died" in dead[0][1]


@pytest.mark.parametrize("problem", ["NaN", "failed", "Exudyn"])
def test_a_run_that_fails_is_reported_with_how_to_ask_again_and_the_rest_goes_on(problem, monkeypatch, tmp_path):
    import comparison.matching as matching
    from bent_beam import SimulationError

    monkeypatch.setenv("BENTBEAM_STORE", str(tmp_path))
    measured = matching._simulate

    def broken(path, impact, *rest):
        if impact.kappa_over_nu != 0.3:
            return measured(path, impact, *rest)
        if problem == "failed":
            raise SimulationError("it diverged", time=0.01, step=7, advice="smaller steps")
        if problem == "Exudyn":
            raise RuntimeError("Exudyn: singular Jacobian")
        history = measured(path, impact, *rest)
        history.dataset["total_impulse"].values[5:] = math.nan
        return history

    monkeypatch.setattr(matching, "_simulate", broken)
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = run(MATCH)
    found = json.loads(out.getvalue())
    assert code == 3 and "Traceback" not in err.getvalue()
    assert [row["kappa_over_nu"] for row in found["rows"]] == [0.5, 2.0]
    (failure,) = found["failures"]
    assert failure["kappa_over_nu"] == 0.3 and failure["reason"]
    assert (
        failure["rerun"] == "bentbeam match --path hermite --kappa-over-nu 0.3" and failure["rerun"] in err.getvalue()
    )
    if problem == "failed":
        assert "it diverged" in failure["reason"] and "smaller steps" in failure["reason"]


# --- any number of jobs, and a cluster ------------------------------------------------------------


def without_seconds(rows):
    return [{k: v for k, v in vars(row).items() if k != "seconds"} for row in rows]


def test_rows_do_not_depend_on_jobs_or_on_a_cluster(reference):
    pytest.importorskip("distributed")
    environment = os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE, "text": True, "env": environment}
    scheduler = subprocess.Popen(
        [
            sys.executable,
            "-m",
            "distributed.cli.dask_scheduler",
            "--host",
            "127.0.0.1",
            "--port",
            "0",
            "--no-dashboard",
        ],
        **quiet,
    )
    started = [scheduler]
    try:
        address = None
        for line in scheduler.stderr:
            if "Scheduler at:" in line:
                address = line.split("Scheduler at:")[1].strip()
                break
        assert address is not None
        worker = [sys.executable, "-m", "distributed.cli.dask_worker", address, "--nthreads", "1", "--no-dashboard"]
        for _ in range(2):
            started.append(subprocess.Popen(worker, **(quiet | {"stderr": subprocess.DEVNULL})))
        asked = [Question("hermite", kappa) for kappa in (0.5, 0.3, 2.0)]
        rows, failures = match(asked, scheduler=address)
        assert not failures
        assert without_seconds(rows) == reference[0]
        if FUZZ:
            assert without_seconds(match(asked, jobs=2)[0]) == reference[0]
    finally:
        for process in reversed(started):
            process.terminate()
        for process in started:
            process.wait(timeout=30)


def test_a_scheduler_that_is_not_there_is_bad_input():
    err = io.StringIO()
    with contextlib.redirect_stderr(err):
        code = run([*MATCH, "--scheduler", "nonsense://1"])
    assert code == 2 and "scheduler" in err.getvalue() and err.getvalue().count("\n") == 1
