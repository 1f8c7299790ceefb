"""Killed, torn, dying: a second start finishes with the same rows, and nothing broken is read as good."""

import json
import math
import os
import random
import signal
import subprocess
import sys
import time

import pytest
from called import command

from bent_beam import InputError, SimulationError
from bent_beam.files import write_atomically
from comparison.store import RunStore, check_writable, source_of
from hermite_fe import HermiteFE

FUZZ = bool(os.environ.get("FUZZ"))
SEED = os.environ.get("FUZZ_SEED", "0")
MAIN = "from comparison.command_line.app import main; main()"
KAPPAS = {"hermite": (0.5, 0.3, 2.0), "exudyn": (0.3, 2.0)}


def match_on(path):
    return ["match", "--path", path, *(i for kappa in KAPPAS[path] for i in ("--kappa-over-nu", str(kappa))), "--json"]


def start(arguments, store):
    """The command in a session of its own, so that a kill takes its workers too, as a power cut would."""
    environment = os.environ | {"BENTBEAM_STORE": str(store), "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    return subprocess.Popen(
        [sys.executable, "-c", MAIN, *map(str, arguments)],
        env=environment,
        start_new_session=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def killed_as_soon_as(happened, process):
    """Kill -9 when ``happened()``, however fast the machine; True when it was still at work."""
    while process.poll() is None and not happened():
        time.sleep(0.005)
    working = process.poll() is None
    if working:
        os.killpg(process.pid, signal.SIGKILL)
    process.communicate()
    return working


def rows_of(text):
    return [{key: value for key, value in row.items() if key != "seconds"} for row in json.loads(text)["rows"]]


def whole_runs_in(store):
    files = [f for f in store.glob("*.json") if not f.name.startswith(".")]
    assert all(RunStore._read(file) is not None for file in files)
    return {file: file.stat().st_mtime_ns for file in files}


@pytest.mark.parametrize(
    ("path", "kills"),
    [
        pytest.param("hermite", 6 if FUZZ else 1, marks=pytest.mark.verify),
        pytest.param("exudyn", 2, marks=pytest.mark.skipif(not FUZZ, reason="half a minute: FUZZ=1")),
    ],
)
def test_a_killed_match_starts_again_and_ends_with_the_same_rows(path, kills, tmp_path):
    """Killed with one more run in the store each time; then a run that was kept is torn as well."""
    rows = rows_of(start(match_on(path), tmp_path / "whole").communicate(timeout=590)[0])
    runs = len(whole_runs_in(tmp_path / "whole"))
    numbers, command = random.Random(f"{SEED} {path}"), match_on(path)
    for killed in range(kills):
        store = tmp_path / f"store-{killed}"
        jobs = ["--jobs", numbers.choice("12")] if FUZZ else []
        for kept in sorted(numbers.sample(range(1, runs), 3 if FUZZ else 1)):
            killed_as_soon_as(lambda: len(list(store.glob("*.json"))) >= kept, start([*command, *jobs], store))  # noqa: B023
        before = whole_runs_in(store)
        assert rows_of(start(command, store).communicate(timeout=590)[0]) == rows
        after = whole_runs_in(store)
        assert before.items() <= after.items() and len(after) == runs  # none that was kept is computed again
    torn = numbers.choice(sorted(after))
    torn.write_bytes(torn.read_bytes()[: numbers.randrange(torn.stat().st_size)])
    assert rows_of(start(command, store).communicate(timeout=590)[0]) == rows
    assert len(whole_runs_in(store)) == runs


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
    code, out, err = command(*match_on("hermite"))
    found = json.loads(out)
    assert code == 3 and "Traceback" not in err
    assert [(r["kappa_over_nu"], r["r0"]["value"] is None) for r in found["rows"]] == [
        (0.5, False),
        (0.3, True),
        (2.0, False),
    ]
    (failure,) = found["failures"]
    assert failure["kappa_over_nu"] == 0.3 and failure["reason"]
    assert "0.3" in err and failure["reason"] in err
    if problem == "failed":
        assert "it diverged" in failure["reason"] and "smaller steps" in failure["reason"]


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


def test_a_full_disk_leaves_what_was_there_and_costs_the_store_no_answer(tmp_path, monkeypatch):
    file = tmp_path / "a.json"
    write_atomically(file, "old")
    monkeypatch.setattr(os, "replace", lambda *_: (_ for _ in ()).throw(OSError(28, "No space left on device")))
    with pytest.raises(OSError, match=r"No space left on device: .*a\.json"):
        write_atomically(file, "new")
    assert RunStore(tmp_path).answer({"question": 1}, lambda: {"value": 1.5}) == {"value": 1.5}
    assert file.read_text() == "old" and [f.name for f in tmp_path.iterdir()] == ["a.json"]


def test_a_stored_run_is_stale_when_any_module_of_its_method_changes(tmp_path, monkeypatch):
    package = tmp_path / "theirs"
    package.mkdir()
    (package / "__init__.py").write_text("")
    (package / "method.py").write_text("class Method:\n    pass\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    from theirs.method import Method

    before = source_of(Method)
    (package / "kernel.py").write_text("h = 0.1\n")
    source_of.cache_clear()  # of this process, which runs what it has imported
    assert source_of(Method) != before


def test_a_file_has_the_rights_that_the_user_gives_and_takes_no_device_s_place(tmp_path):
    mask = os.umask(0o027)
    try:
        write_atomically(tmp_path / "a.json", "text")
    finally:
        os.umask(mask)
    assert (tmp_path / "a.json").stat().st_mode & 0o777 == 0o640
    os.mkfifo(tmp_path / "pipe")
    for out in ("/dev/null", tmp_path / "pipe"):
        with pytest.raises(InputError, match="no regular file"):
            check_writable(type(tmp_path)(out), folder=False)
