"""Same inputs at every `make test`; `make fuzz` draws new ones (tests/reliability). Integrators are compiled before
worker processes start."""

import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, settings

UNHURRIED: dict[str, Any] = {"deadline": None, "database": None, "suppress_health_check": list(HealthCheck)}
settings.register_profile("tests", derandomize="FUZZ" not in os.environ, max_examples=20, **UNHURRIED)
settings.load_profile("tests")
pytest_plugins = ["chromium"]  # its fixture
if "PYTEST_XDIST_WORKER" not in os.environ:  # workers inherit it
    STORE = tempfile.TemporaryDirectory(prefix="bentbeam-tests-")
    os.environ["BENTBEAM_STORE"] = STORE.name


@pytest.fixture
def own_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The working folder is empty, and the store is in the folder in which a command is started."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("BENTBEAM_STORE", "store")
    return tmp_path


def pytest_sessionstart(session: pytest.Session) -> None:
    """Each worker would compile every integrator for itself, at the same time as the other."""
    if hasattr(session.config, "workerinput") or not getattr(session.config.option, "numprocesses", None):
        return
    if subprocess.run([sys.executable, "-m", "tests.compile_integrators"], cwd=Path(__file__).parents[1]).returncode:
        raise pytest.UsageError("the integrators could not be compiled: see above")
