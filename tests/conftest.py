"""Same inputs at every `make test`; `make fuzz` draws new ones (tests/reliability). Kernels are compiled before worker
processes start."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

settings.register_profile(
    "repeatable", derandomize=True, deadline=None, suppress_health_check=[HealthCheck.too_slow], database=None
)
settings.register_profile("fresh", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("fresh" if os.environ.get("FUZZ") else "repeatable")


def pytest_sessionstart(session: pytest.Session) -> None:
    """Each worker would compile every kernel for itself, at the same time as the other."""
    if hasattr(session.config, "workerinput") or not getattr(session.config.option, "numprocesses", None):
        return
    script = Path(__file__).with_name("compile_kernels.py")
    compiling = [subprocess.Popen([sys.executable, str(script), *kinds]) for kinds in ("SP", "VA")]
    for process in compiling:
        process.wait()
