"""Many calls on cores or a cluster: the same answers in the order of the questions, and one death costs one call."""

import os
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path
from unittest.mock import Mock

import pytest
from processes import ended, until

from comparison import workers
from comparison.workers import run_all


def root(number):
    """√n after a while that grows with it, so that answers come in another order; some calls never answer."""
    if number < 0.0:
        raise ValueError("negative")
    if number == 0.0:
        os._exit(9)
    time.sleep(0.002 * number)
    return number**0.5


def whose(seconds):
    """The process that a call of so many seconds ran in."""
    time.sleep(seconds)
    return os.getpid()


def test_a_second_process_is_taken_once_it_pays(monkeypatch, caplog):
    """Short calls stay here; of long ones all but the first go elsewhere. Who asks for more than pays is told."""
    here = os.getpid()
    monkeypatch.setattr(os, "cpu_count", lambda: 2)
    assert run_all(whose, [(0.01,)] * 5, jobs=None) == [here] * 5
    monkeypatch.setattr(workers, "PAYS", 0.2)
    first, *others = run_all(whose, [(0.3,)] * 3, jobs=None)
    assert first == here and here not in others and not caplog.records
    monkeypatch.setattr(workers, "PAYS", 60.0)
    with caplog.at_level("INFO", logger="bent_beam"):
        assert here not in run_all(whose, [(0.01,)] * 2, jobs=2)
    assert "leave --jobs out" in caplog.text


@pytest.fixture(scope="module")
def cluster():
    """Its scheduler gives a call up that one worker has died of. A worker that dies while its nanny still starts it is
    never started again: were it asked four times, a slow machine could lose both, and who waits would wait for ever."""
    distributed = pytest.importorskip("distributed")
    once = {"n_workers": 2, "threads_per_worker": 1, "scheduler_kwargs": {"allowed_failures": 0}}
    with distributed.LocalCluster(dashboard_address=":0", **once) as started:
        yield started.scheduler_address


@pytest.fixture(autouse=True)
def no_longer_than_two_minutes():
    signal.signal(signal.SIGALRM, lambda *_: pytest.fail("no answer within two minutes"))
    signal.alarm(120)
    yield
    signal.alarm(0)


@pytest.fixture
def where(request):
    if request.param == "cluster":
        return {"scheduler": request.getfixturevalue("cluster")}
    return {"jobs": 1 if request.param == "one process" else 2}


@pytest.mark.parametrize(
    ("where", "deaths"),
    [("one process", 0), ("two processes", 1), ("cluster", 0), pytest.param("cluster", 1, marks=pytest.mark.verify)],
    indirect=["where"],
)
def test_answers_come_in_the_order_of_the_questions_and_a_worker_that_dies_costs_its_call_and_no_other(where, deaths):
    numbers, seen = [*(float(n) for n in range(12, 0, -1)), *[0.0] * deaths, 16.0], []
    asked = [(n,) for n in numbers]
    found = run_all(root, asked, on_death=lambda *death: death, progress=lambda *done: seen.append(done), **where)
    assert found == [n**0.5 if n else (12, "the worker died: out of memory?") for n in numbers]
    assert seen == [(n, len(numbers)) for n in range(1, len(numbers) + 1)]


@pytest.mark.parametrize(
    "where", ["one process", "cluster", pytest.param("two processes", marks=pytest.mark.verify)], indirect=True
)
def test_what_a_call_or_its_caller_raises_is_raised(where):
    with pytest.raises(ValueError, match=r"^negative$"):
        run_all(root, [(4.0,), (-1.0,)], on_death=lambda i, why: pytest.fail(why), **where)
    with pytest.raises(OSError, match=r"^disk full$"):
        run_all(root, [(4.0,), (9.0,)], progress=Mock(side_effect=OSError("disk full")), **where)


def test_a_scheduler_beside_jobs_or_that_does_not_answer_within_ten_seconds_is_bad_input(monkeypatch):
    """The last of them accepts and stays mute."""
    with pytest.raises(ValueError, match="jobs has no effect next to scheduler"):
        run_all(root, [(4.0,)], jobs=2, scheduler="tcp://127.0.0.1:1")
    pytest.importorskip("distributed")
    monkeypatch.setattr(workers, "FIRST_ANSWER", 0.5)
    with socket.create_server(("127.0.0.1", 0)) as mute:
        port = mute.getsockname()[1]
        for address in ("tcp://127.0.0.1:1", "tls://127.0.0.1:1", "nothing://1", "", f"tcp://127.0.0.1:{port}"):
            with pytest.raises(ValueError, match=rf"scheduler: none answers at {address} "):
                run_all(root, [(4.0,)], scheduler=address)


BUSY = """
import sys, time
sys.path[:0] = {tests!r}
from test_workers import root, wait
from comparison.workers import run_all
run_all(wait, [(60.0,), (60.0,), (60.0,)], jobs=2)
"""


def wait(seconds):
    Path(f"{os.getpid()}.worker").touch()
    time.sleep(seconds)


def test_workers_end_within_ten_seconds_of_a_parent_that_was_killed_and_run_nothing_from_its_folder(tmp_path):
    (tmp_path / "numpy.py").write_text("open('executed', 'w')")
    code = BUSY.format(tests=[str(folder) for folder in Path(__file__).parents[:2]])
    parent = subprocess.Popen([sys.executable, "-P", "-c", code], cwd=tmp_path, start_new_session=True)
    while len(list(tmp_path.glob("*.worker"))) < 2:
        assert parent.poll() is None
        time.sleep(0.05)
    parent.kill()
    parent.wait()
    until(lambda: ended(parent.pid))
    assert not (tmp_path / "executed").exists()


def test_workers_that_are_missing_or_have_other_sources_are_told_before_the_work(cluster, monkeypatch):
    assert workers.FIRST_ANSWER + 2.0 * workers.FIRST_WORKER < 40.0
    monkeypatch.setattr("comparison.store.versions", lambda: {"numpy": "of tomorrow"})
    with pytest.raises(ValueError, match="other sources or versions"):
        run_all(root, [(4.0,)], scheduler=cluster)
    monkeypatch.undo()
    monkeypatch.setattr(workers, "FIRST_WORKER", 0.3)
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(n_workers=0, processes=False, dashboard_address=":0") as empty:
        with pytest.raises(ValueError, match="missing, frozen or busy"):
            run_all(root, [(4.0,)], scheduler=empty.scheduler_address)
