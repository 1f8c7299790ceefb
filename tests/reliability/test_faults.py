"""Killed, torn, dying, lost: a second start finishes with the same rows, and nothing broken is read as good."""

import contextlib
import functools
import io
import json
import math
import os
import random
import re
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import asdict

import pytest

from bent_beam import SimulationError
from comparison import workers
from comparison.command_line.app import run
from comparison.match import Question, failures, match
from comparison.plain import plain
from comparison.store import RunStore, write_atomically
from comparison.workers import run_all
from hermite_fe import HermiteFE

FUZZ = bool(os.environ.get("FUZZ"))
SEED = os.environ.get("FUZZ_SEED", "0")
MAIN = "from comparison.command_line.app import main; main()"
FEW_ROWS = f"""
from dataclasses import replace
import comparison.report.page as page
import comparison.report.rows as rows
questions, studies = rows.report_questions, page.stored_studies
match, show_all, compare_noise = page.match, page.show_all, page.compare_noise

def asked(q):
    cheap = q.first is None or (q.first == rows.FIRST[0] and q.method.path != "exudyn")
    return q.kappa_over_nu == rows.MIDDLE and cheap

def timed(found):
    return replace(found, seconds=1.0)

def shown(*given, **options):
    impacts, lost = show_all(*given, **options)
    return [timed(i) for i in impacts], lost

def noise(**options):
    found, lost = compare_noise(**options)
    return replace(found, before=timed(found.before), after=timed(found.after)), lost

rows.report_questions = lambda *given: [q for q in questions(*given) if asked(q)]
page.match = lambda *given, **options: [timed(row) for row in match(*given, **options)]
page.show_all, page.compare_noise = shown, noise
page.stored_studies = lambda: studies()[:5]
{MAIN}
"""  # and every run took one second, so that pages of different runs can be compared
KAPPAS = {"hermite": ("0.5", "0.3", "2.0"), "exudyn": ("0.3", "2.0")}


def match_on(path):
    return ["match", "--path", path, *(i for kappa in KAPPAS[path] for i in ("--kappa-over-nu", kappa)), "--json"]


MATCH = match_on("hermite")


@pytest.fixture
def numbers(request):
    """Random numbers of the test's own: the same for the same seed, whatever ran before it in this process."""
    return random.Random(f"{SEED} {request.node.name}")


def start(arguments, store, main=MAIN):
    """The command in a session of its own, so that a kill takes its workers too, as a power cut would."""
    environment = os.environ | {"BENTBEAM_STORE": str(store), "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    return subprocess.Popen(
        [sys.executable, "-c", main, *map(str, arguments)],
        env=environment,
        start_new_session=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
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


def killed_as_soon_as(happened, process):
    """Kill -9 when ``happened()``, however fast the machine; True when it was still at work."""
    while process.poll() is None and not happened():
        time.sleep(0.005)
    working = process.poll() is None
    if working:
        os.killpg(process.pid, signal.SIGKILL)
    process.communicate()
    return working


def finished(arguments, store, limit=590, main=MAIN):
    out, err = start(arguments, store, main).communicate(timeout=limit)
    return out, err


def rows_of(text):
    rows = json.loads(text)["rows"]
    return [{key: value for key, value in row.items() if key != "seconds"} for row in rows]


def kept_in(store):
    return sorted(f for f in store.glob("*.json") if not f.name.startswith("."))


def every_kept_run_is_whole(store):
    files = kept_in(store)
    for file in files:
        assert RunStore._read(file) is not None, file
    return len(files)


@contextlib.contextmanager
def none_kept_is_computed_again(store):
    kept = {file: file.stat().st_mtime_ns for file in kept_in(store)}
    yield
    assert kept == {file: file.stat().st_mtime_ns for file in kept}


def torn(file, numbers):
    """Cut the file somewhere, as a disk that lost its last blocks would."""
    good = file.read_bytes()
    file.write_bytes(good[: numbers.randrange(len(good))])
    assert RunStore._read(file) is None


@pytest.fixture(scope="module")
def reference(tmp_path_factory):
    """Rows of an uninterrupted match on a path, the runs that it kept and the seconds that it took; once a path."""

    @functools.cache
    def of(path):
        began, store = time.perf_counter(), tmp_path_factory.mktemp("reference")
        out, _ = finished(match_on(path), store)
        return rows_of(out), every_kept_run_is_whole(store), time.perf_counter() - began

    return of


@pytest.mark.parametrize(
    ("path", "wanted"),
    [
        pytest.param("hermite", 42 if FUZZ else 2, marks=pytest.mark.verify),
        pytest.param("exudyn", 6, marks=pytest.mark.skipif(not FUZZ, reason="half a minute: FUZZ=1")),
    ],
)
def test_a_killed_match_starts_again_and_ends_with_the_same_rows(path, wanted, reference, numbers, tmp_path):
    rows, runs, duration = reference(path)
    command, kills = match_on(path), 0
    for series in range(200):
        store = tmp_path / f"store-{series}"
        jobs = ["--jobs", numbers.choice(["1", "2"])] if FUZZ else []
        kills += killed_as_soon_as(lambda: kept_in(store), start([*command, *jobs], store))  # noqa: B023
        for _ in range(2):
            kills += killed(start([*command, *jobs], store), numbers.uniform(0.3, 0.9) * duration)
            every_kept_run_is_whole(store)
        if kills >= wanted or not FUZZ or series % 5 == 0:
            with none_kept_is_computed_again(store):
                assert rows_of(finished(command, store)[0]) == rows
            assert every_kept_run_is_whole(store) == runs
        if kills >= wanted or not FUZZ:
            break
    torn(numbers.choice(kept_in(store)), numbers)
    assert rows_of(finished(command, store)[0]) == rows
    assert every_kept_run_is_whole(store) == runs
    print(f"match on the {path} path: {kills} kills")
    assert kills >= (wanted if FUZZ else 1)


@pytest.mark.skipif(not FUZZ, reason="minutes: FUZZ=1")
def test_a_killed_gallery_starts_again_and_ends_with_the_same_figures(numbers, tmp_path):
    items = ["fig-2.5", "fig-2.7a", "fig-2.7b", "fig-2.9"]
    listed = {e["id"] for e in json.loads(finished(["gallery", "--list", "--json"], tmp_path / "s")[0])}
    items = [i for i in items if i in listed] or sorted(listed)[:4]
    began = time.perf_counter()
    finished(["gallery", *items, "--out", tmp_path / "whole", "--json"], tmp_path / "s")
    duration = time.perf_counter() - began
    kills = 0
    out = tmp_path / "killed"
    for _ in range(20):
        kills += killed(start(["gallery", *items, "--out", out], tmp_path / "s"), numbers.uniform(0.2, 0.95) * duration)
        if kills == 5:
            break
    drawn = json.loads(finished(["gallery", *items, "--out", out, "--json"], tmp_path / "s")[0])
    assert {d["id"] for d in drawn["drawn"]} == set(items) and not drawn["failures"]
    tables = sorted(f.relative_to(tmp_path / "whole") for f in (tmp_path / "whole").rglob("*.csv"))
    assert tables
    for table in tables:
        assert (out / table).read_bytes() == (tmp_path / "whole" / table).read_bytes()
    print(f"gallery: {kills} kills")


def shown_by(answer, out):
    """All that a report of `FEW_ROWS` says, by name, but for the time, the date and the folder: its answer, files,
    page, plots."""
    found = json.loads(answer)
    assert found["rows"] == 8 and not found["failures"]
    shown = {"files": {os.path.relpath(f, out) for f in found["files"]}, "headline": found["headline"]}
    shown |= {f.name: f.read_bytes() for f in (out / "data").glob("[!.]*")}
    page = (out / "index.html").read_text()
    before, mark, rest = page.partition('<script type="application/json" id="data">')
    embedded, end, after = rest.partition("</script>")
    assert mark and end
    clock = r'(<th scope="row">(?:written|time for this report)</th><td>)[^<]*'
    shown["page"], times = re.subn(clock, r"\1", before + after)
    assert times == 2
    data = json.loads(embedded)
    shown |= {f"plot {name}": plot for name, plot in data.pop("plots").items()}
    return shown | {f"data of {name}": value for name, value in data.items()}


@pytest.mark.skipif(not FUZZ, reason="minutes: FUZZ=1")
def test_a_killed_report_starts_again_and_ends_with_the_same_page(numbers, tmp_path):
    """Few of its rows and studies, on both paths and of both orders; no page before the end, then the whole page."""
    command = ["report", "--jobs", "2", "--overwrite", "--json", "--out"]

    def report(out, store):
        return shown_by(finished([*command, out], store, main=FEW_ROWS)[0], out)

    whole = report(tmp_path / "whole", tmp_path / "whole-store")
    total = every_kept_run_is_whole(tmp_path / "whole-store")
    out, store, kills = tmp_path / "killed", tmp_path / "killed-store", 0

    def kill_as_soon_as(happened):
        with none_kept_is_computed_again(store):
            working = killed_as_soon_as(happened, start([*command, out], store, main=FEW_ROWS))
        every_kept_run_is_whole(store)
        return working

    for _ in range(4):
        kept = len(kept_in(store))
        enough = kept + numbers.randint(1, max(1, (total - kept) // 3))
        kills += kill_as_soon_as(lambda: len(kept_in(store)) >= enough)  # noqa: B023
        assert not (out / "index.html").exists()
    kills += kill_as_soon_as((out / "data" / "match.json").exists)  # at work on the pictures and the page
    page = out / "index.html"
    assert not page.exists() or page.read_text().rstrip().endswith("</html>")
    with none_kept_is_computed_again(store):
        again = report(out, store)
    assert again.keys() == whole.keys()
    assert [name for name in whole if again[name] != whole[name]] == []
    assert kills >= 4 and len(kept_in(store)) == total
    print(f"report: {kills} kills, {total} runs kept, {len(whole)} things on the page compared")


@pytest.mark.skipif(not FUZZ, reason="minutes: FUZZ=1")
def test_two_reports_at_once_in_one_store_and_disks_that_fill_during_a_third(tmp_path):
    """Both pages show the same; where files may not grow beyond some size, one line says so and no half is left."""
    store, command = tmp_path / "store", ["report", "--overwrite", "--json", "--out"]
    both = [start([*command, tmp_path / name], store, main=FEW_ROWS) for name in ("one", "two")]
    answers = [process.communicate(timeout=590) for process in both]
    assert [process.returncode for process in both] == [0, 0], answers
    one, two = (shown_by(out, tmp_path / name) for (out, _), name in zip(answers, ("one", "two")))
    assert [name for name in one if one[name] != two[name]] == []
    every_kept_run_is_whole(store)
    full = tmp_path / "full"
    for most in (1_000, 20_000, 1_000_000):  # bytes; a semaphore takes 32
        limited = f"import resource; resource.setrlimit(resource.RLIMIT_FSIZE, ({most}, {most}))\n" + FEW_ROWS
        process = start([*command, full], store, main=limited)
        out, err = process.communicate(timeout=590)
        assert process.returncode == 2 and out == "" and err.count("\n") == 1, (most, err)
        assert str(full) in err and "large" in err, (most, err)
        left = [f for f in full.rglob("*") if f.is_file()]
        assert not (full / "index.html").exists() and not [f for f in left if f.suffix == ".part"]
        assert all(f.stat().st_size for f in left)
    with none_kept_is_computed_again(store):
        answer, _ = finished([*command, full], store, main=FEW_ROWS)
    third = shown_by(answer, full)
    assert [name for name in one if one[name] != third[name]] == []


@pytest.mark.verify
def test_a_clock_that_jumps_changes_nothing(reference, monkeypatch, tmp_path):
    jumps = iter(random.Random(3).choices([0.0, 1e9, 4e9, -1e9], k=100_000))
    monkeypatch.setattr(time, "time", lambda: next(jumps))
    asked = [Question(HermiteFE(), kappa) for kappa in (0.5, 0.3, 2.0)]
    rows = match(asked, store=RunStore(tmp_path), limit=500.0)
    assert without_seconds(rows) == reference("hermite")[0]
    assert all(row.seconds is not None and 0.0 < row.seconds < 500.0 for row in rows)


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
    with pytest.raises(OSError, match=r"No space left on device: .*a\.json"):
        write_atomically(file, "new")
    assert file.read_text() == "old" and [f.name for f in tmp_path.iterdir()] == ["a.json"]


# --- workers that die, and runs that fail ------------------------------------------------------------


def survives(number):
    if number == 3:
        os._exit(9)
    return number * number


@pytest.mark.verify
def test_a_worker_that_dies_takes_no_other_call_with_it():
    dead = []
    found = run_all(survives, [(n,) for n in range(6)], jobs=2, on_death=lambda i, why: dead.append((i, why)) or "dead")
    assert found == [0, 1, 4, "dead", 16, 25]
    assert [i for i, _ in dead] == [3] and "died" in dead[0][1]
    with pytest.raises(RuntimeError, match="call 1: its worker process died"):
        run_all(survives, [(1,), (3,)], jobs=2)


@pytest.mark.verify
def test_the_calls_after_one_that_dies_share_a_pool_again():
    """A sweep of ten thousand rows must not start a process for each row that follows a death."""
    started = []
    together = workers._together

    def counted(*arguments):
        started.append(1)
        return together(*arguments)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(workers, "_together", counted)
        found = run_all(survives, [(n,) for n in range(60)], jobs=2, on_death=lambda i, why: "dead")
    assert found == [n * n if n != 3 else "dead" for n in range(60)] and len(started) == 2


class Watched(Sequence):
    """Arguments of calls, and how many have been asked for at most before their answers came."""

    def __init__(self, count):
        self.count, self.asked, self.answered, self.ahead = count, 0, 0, 0

    def __len__(self):
        return self.count

    def __getitem__(self, i):
        if i >= self.count:
            raise IndexError(i)
        self.asked += 1
        self.ahead = max(self.ahead, self.asked - self.answered)
        return (i,)

    def progress(self, done, total):
        self.answered = done


def test_a_long_sweep_keeps_few_calls_waiting():
    calls = Watched(500)
    assert run_all(abs, calls, jobs=2, progress=calls.progress, on_death=pytest.fail) == list(range(500))
    assert calls.ahead <= 2 * workers.AHEAD + 1


@pytest.mark.parametrize("problem", ["NaN", "failed", "Exudyn"])
def test_a_run_that_fails_is_reported_with_how_to_ask_again_and_the_rest_goes_on(problem, monkeypatch, tmp_path):
    monkeypatch.setenv("BENTBEAM_STORE", str(tmp_path))
    simulate = HermiteFE.simulate

    def broken(method, impact, **options):
        if impact.kappa_over_nu != 0.3:
            return simulate(method, impact, **options)
        if problem == "failed":
            raise SimulationError("it diverged", time=0.01, step=7, advice="smaller steps")
        if problem == "Exudyn":
            raise RuntimeError("Exudyn: singular Jacobian")
        history = simulate(method, impact, **options)
        history.dataset["impulse"].values[5:] = math.nan
        return history

    monkeypatch.setattr(HermiteFE, "simulate", broken)
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = run(MATCH)
    found = json.loads(out.getvalue())
    assert code == 3 and "Traceback" not in err.getvalue()
    assert [(row["kappa_over_nu"], row["r0"]["value"] is None) for row in found["rows"]] == [
        (0.5, False),
        (0.3, True),
        (2.0, False),
    ]
    (failure,) = found["failures"]
    assert failure["kappa_over_nu"] == 0.3 and failure["reason"]
    assert "0.3" in err.getvalue() and failure["reason"] in err.getvalue()
    if problem == "failed":
        assert "it diverged" in failure["reason"] and "smaller steps" in failure["reason"]


# --- any number of jobs, and a cluster ------------------------------------------------------------


def without_seconds(rows):
    return [{k: v for k, v in plain(asdict(row)).items() if k != "seconds"} for row in rows]


@pytest.mark.verify
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
        asked = [Question(HermiteFE(), kappa) for kappa in (0.5, 0.3, 2.0)]
        rows = match(asked, scheduler=address)
        assert not failures(rows)
        assert without_seconds(rows) == reference("hermite")[0]
        if FUZZ:
            assert without_seconds(match(asked, jobs=2)) == reference("hermite")[0]
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
