"""A sweep on a dask cluster whose workers and scheduler are killed: every row answered once, the same bits."""

import math
import os
import random
import resource
import signal
import subprocess
import sys
import threading
import time

import cloudpickle
import pytest

from comparison.store import RunStore
from comparison.workers import run_all

FUZZ = bool(os.environ.get("FUZZ"))
SEED = os.environ.get("FUZZ_SEED", "0")
ROWS, KILLS, PAUSE = 2000, 30, 0.15


def value_of(number):
    return math.sin(number) * 1e-7 + number / 3.0


def row(number, folder):
    """A cheap row through the store, as a row of ``match`` goes; a line in a log for each time it was computed."""
    from pathlib import Path

    def compute():
        time.sleep(PAUSE)
        with open(Path(folder) / "computed.log", "a") as log:
            log.write(f"{number}\n")
        return {"value": value_of(number)}

    return RunStore(Path(folder) / "store").answer({"row": number}, compute)


class Cluster:
    """A scheduler at one address and four workers in processes of their own, each started again after it is killed."""

    def __init__(self, folder):
        self.folder, self.address = folder, None
        self.scheduler, self.workers = None, []
        self.start_scheduler(0)
        for _ in range(4):
            self.workers.append(self.start_worker())

    def start(self, module, *arguments, **more):
        environment = os.environ | {
            "PYTHONPATH": os.pathsep.join(p for p in sys.path if p),
            "DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "50",
            "OMP_NUM_THREADS": "1",
        }
        command = [sys.executable, "-m", f"distributed.cli.dask_{module}", *map(str, arguments), "--no-dashboard"]
        return subprocess.Popen(command, env=environment, cwd=self.folder, stdout=subprocess.DEVNULL, **more)

    def start_scheduler(self, port):
        self.scheduler = self.start(
            "scheduler", "--host", "127.0.0.1", "--port", port, stderr=subprocess.PIPE, text=True
        )
        for line in self.scheduler.stderr:
            if "Scheduler at:" in line:
                self.address = line.split("Scheduler at:")[1].strip()
                break
        threading.Thread(target=self.scheduler.stderr.read, daemon=True).start()

    def start_worker(self):
        return self.start("worker", self.address, "--nthreads", 1, "--no-nanny", stderr=subprocess.DEVNULL)

    def kill_a_worker(self, numbers):
        which = numbers.randrange(len(self.workers))
        self.workers[which].send_signal(signal.SIGKILL)
        self.workers[which].wait()
        self.workers[which] = self.start_worker()

    def kill_the_scheduler(self):
        port = self.address.rpartition(":")[2]
        self.scheduler.send_signal(signal.SIGKILL)
        self.scheduler.wait()
        self.start_scheduler(port)
        for number, worker in enumerate(self.workers):  # they leave by themselves, or wait for ever
            worker.kill()
            worker.wait()
            self.workers[number] = self.start_worker()

    def close(self):
        for process in (*self.workers, self.scheduler):
            process.kill()
            process.wait()


@pytest.mark.skipif(not FUZZ, reason="minutes: FUZZ=1")
def test_a_sweep_outlives_its_workers_and_its_scheduler(tmp_path):
    pytest.importorskip("distributed")
    cloudpickle.register_pickle_by_value(sys.modules[__name__])  # workers cannot import this file
    numbers, kills, stop = random.Random(f"{SEED} cluster"), {"worker": 0, "scheduler": 0}, threading.Event()
    cluster = Cluster(tmp_path)

    def harass():
        while not stop.wait(numbers.uniform(0.5, 3.0)) and sum(kills.values()) < KILLS + 5:
            if sum(kills.values()) % 10 == 9:
                cluster.kill_the_scheduler()
                kills["scheduler"] += 1
            else:
                cluster.kill_a_worker(numbers)
                kills["worker"] += 1

    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    thread = threading.Thread(target=harass)
    thread.start()
    lost = []
    try:
        found = run_all(
            row,
            [(n, str(tmp_path)) for n in range(ROWS)],
            scheduler=cluster.address,
            on_death=lambda i, why: lost.append((i, why)),
        )
    finally:
        stop.set()
        thread.join()
        cluster.close()
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 - before
    computed = (tmp_path / "computed.log").read_text().split()
    assert not lost, lost[:3]
    assert found == [{"value": value_of(n)} for n in range(ROWS)]  # bit for bit
    print(f"{ROWS} rows, kills {kills}, {len(computed)} computed, memory +{grown / 1e6:.0f} MB")
    assert sum(kills.values()) >= KILLS
    assert set(map(int, computed)) == set(range(ROWS))
    assert len(computed) <= ROWS + 2 * 4 * sum(kills.values())  # only what was at work is computed again
    assert grown < 200e6
