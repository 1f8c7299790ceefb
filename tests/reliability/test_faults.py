"""Killed, torn, dying: a second start finishes with the same rows, and nothing broken is read as good."""

import json
import math
import os
import random
import signal

import pytest
from called import command, refused, started
from here import CASES, FUZZ, SEED
from histories import rod
from processes import until

from bent_beam.files import write_atomically
from comparison.store import RunStore
from hermite_fe import HermiteFE


def match_on(path, *ratios):
    return ["match", "--path", path, *(word for ratio in ratios for word in ("--kappa-over-nu", ratio)), "--json"]


def rows(words, folder):
    """Rows of the command in ``folder``, which holds its store, but for how long they took."""
    out, _ = started(*words, cwd=folder).communicate(timeout=590)
    return [{key: value for key, value in row.items() if key != "seconds"} for row in json.loads(out)["rows"]]


def kept(folder):
    return [file for file in (folder / "store").glob("*.json") if not file.name.startswith(".")]


def whole_runs_in(folder):
    files = kept(folder)
    assert all(RunStore._read(file) is not None for file in files)
    return {file: file.stat().st_mtime_ns for file in files}


SWEEP = ["sweep", "rod.toml", "--vary", "impact.velocity=0.5:2:8", "--vary", "beam.damping_ratio=0.01:0.05:5", "--json"]
KILLED = {"match": match_on("hermite", 0.5, 0.3, 2.0), "sweep": [*SWEEP, "--jobs", 2]}


@pytest.mark.verify
@pytest.mark.parametrize("name", KILLED)
def test_a_killed_command_starts_again_and_ends_with_the_same_rows(name, tmp_path):
    """Killed twice, with more runs in the store each time; then a run that was kept is torn as well."""
    words, numbers = KILLED[name], random.Random(f"{SEED} {name}")
    folders = [tmp_path / str(number) for number in range(7 if FUZZ and name == "match" else 2)]
    for folder in folders:
        folder.mkdir()
        rod(folder, element=0.1)
    whole, *killed = folders
    expected, runs = rows(words, whole), len(whole_runs_in(whole))
    assert len(expected) == {"match": 3, "sweep": 40}[name] and not any(row.get("reason") for row in expected)
    for folder in killed:
        jobs = ["--jobs", numbers.choice("12")] if FUZZ and name == "match" else []
        for count in sorted(numbers.sample(range(1, runs), 2)):
            process = started(*words, *jobs, cwd=folder)
            until(lambda: len(kept(folder)) >= count or process.poll() is not None, 590.0, 0.005)  # noqa: B023
            if process.poll() is None:  # its workers too, as a power cut would
                os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
        before = whole_runs_in(folder)
        assert rows(words, folder) == expected
        after = whole_runs_in(folder)
        assert before.items() <= after.items() and len(after) == runs  # none that was kept is computed again
    torn = numbers.choice(sorted(after))
    torn.write_bytes(torn.read_bytes()[: numbers.randrange(torn.stat().st_size)])
    assert rows(words, folder) == expected
    assert len(whole_runs_in(folder)) == runs


def test_runs_that_fail_are_reported_with_how_to_ask_again_and_the_rest_goes_on(monkeypatch):
    simulate, here = HermiteFE.simulate, os.getcwd()
    reasons = {0.3: "exit", 0.5: "", 0.8: "the method failed"}

    def broken(method, impact, **options):
        ratio = round(impact.kappa_over_nu, 3)
        if ratio == 0.3:
            os._exit(9)
        if ratio == 0.8:
            return None
        os.chdir("/")
        history = simulate(method, impact, **options)
        if ratio == 0.5:
            history.dataset["impulse"].values[5:] = math.nan
        return history

    monkeypatch.setattr(HermiteFE, "simulate", broken)
    code, out, err = command(*match_on("hermite", *reasons, 2.0), "--refine", 0.5, "--error-bars", "drift")
    assert os.getcwd() == here
    found = json.loads(out)
    assert code == 3 and "Traceback" not in err
    lost = {row["kappa_over_nu"]: row["r0"]["value"] is None for row in found["rows"]}
    assert lost == dict.fromkeys(reasons, True) | {2.0: False}
    for failure, (ratio, why) in zip(found["failures"], reasons.items(), strict=True):
        assert failure["kappa_over_nu"] == ratio and failure["reason"] and why in failure["reason"]
        assert str(ratio) in err and failure["reason"] in err


def test_a_flipped_or_cut_file_is_never_read_as_good(tmp_path):
    store, asked, answer = RunStore(tmp_path), {"question": 1}, {"numbers": [1.5, 2.25, -3e-7], "words": ["a", "b"]}
    assert store.answer(asked, lambda: answer) == answer
    (file,) = tmp_path.glob("*.json")
    good, numbers = file.read_bytes(), random.Random(5)
    damages = [good[:n] for n in range(0, len(good), 7)]
    for _ in range(300):
        flipped = bytearray(good)
        flipped[numbers.randrange(len(good))] ^= 1 << numbers.randrange(8)
        damages.append(flipped)
    damages += [b"[" * 100_000, b"null", b'{"answer": NaN, "sha256": ""}', os.urandom(200)]
    for damage in damages:
        file.write_bytes(damage)
        assert RunStore._read(file) in (None, answer)
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


def test_a_file_follows_a_link_has_the_rights_that_the_user_gives_and_loses_no_text_to_a_surrogate(tmp_path):
    (tmp_path / "link").symlink_to(tmp_path / "there")
    mask = os.umask(0o027)
    try:
        write_atomically(tmp_path / "link", "a\udc80b")
    finally:
        os.umask(mask)
    assert (tmp_path / "link").is_symlink() and (tmp_path / "there").read_text() == "a\\udc80b"
    assert (tmp_path / "there").stat().st_mode & 0o777 == 0o640


@pytest.mark.parametrize("out", ["/proc/history.nc", "/dev/null/x/history.nc", "/dev/null", "/dev"])
def test_a_place_that_cannot_be_written_is_refused_before_the_run(out, monkeypatch):
    """A device would be replaced by the file."""
    monkeypatch.setattr(HermiteFE, "simulate", lambda *a, **k: pytest.fail("it ran"))
    assert "out:" in refused("simulate", CASES / "ruler.toml", "--out", out, "--json", "--overwrite")
