import pytest


@pytest.fixture
def alone(monkeypatch):
    """Adapters without modules of their own beside them: to look for those takes longer than to run the adapter."""
    monkeypatch.setattr("bent_beam_programs.open_benchmark.adapter.behind", lambda files, folder: [])
