"""Same inputs at every `make test`; `make fuzz` draws new ones (tests/reliability)."""

import os

from hypothesis import HealthCheck, settings

settings.register_profile(
    "repeatable", derandomize=True, deadline=None, suppress_health_check=[HealthCheck.too_slow], database=None
)
settings.register_profile("fresh", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("fresh" if os.environ.get("FUZZ") else "repeatable")
