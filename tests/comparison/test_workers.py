"""Calls on a cluster: whose fault it is when one does not answer."""

from types import SimpleNamespace
from typing import Any

import pytest

from comparison.workers import run_all

distributed = pytest.importorskip("distributed")
LOST = SimpleNamespace(address="there")


class Answered:
    """A call that has ended."""

    def __init__(self, function: Any, *arguments: Any, pure: bool) -> None:
        self.status, self.given = "finished", None
        try:
            self.given = function(*arguments)
        except Exception as error:
            self.status, self.given = "error", error

    def result(self, timeout: float) -> Any:
        return self.given

    def exception(self, timeout: float) -> Any:
        return self.given


class Client:
    """A cluster that answers at once."""

    status, loop, submit = "running", None, Answered

    def __init__(self, address: str, timeout: float, set_as_default: bool) -> None:
        pass

    def __enter__(self) -> "Client":
        return self

    def __exit__(self, *_: Any) -> None:
        pass


class Finished(list):
    """Calls as they are completed."""

    def __init__(self, loop: None) -> None:
        super().__init__()

    add = list.append

    def __iter__(self) -> Any:
        while self:
            yield self.pop(0)


@pytest.fixture(autouse=True)
def cluster(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(distributed, "Client", Client)
    monkeypatch.setattr(distributed, "as_completed", Finished)


def root(number: float) -> float:
    if number < 0.0:
        raise ValueError("negative")
    if number == 0.0:
        raise distributed.KilledWorker("root", LOST, 3)
    return number**0.5


def test_a_call_that_raised_raises_as_it_does_on_cores() -> None:
    for scheduler in (None, "here"):
        with pytest.raises(ValueError, match=r"^negative$"):
            run_all(root, [(4.0,), (-1.0,)], scheduler=scheduler, on_death=lambda i, why: pytest.fail(why))


def test_a_call_whose_worker_died_has_its_stand_in() -> None:
    found = run_all(root, [(4.0,), (0.0,), (9.0,)], scheduler="here", on_death=lambda i, why: (i, "died" in why))
    assert found == [2.0, (1, True), 3.0]


@pytest.mark.parametrize("error", [OSError("disk full"), ValueError("bad")])
def test_what_a_caller_raises_is_not_laid_to_the_scheduler(error: Exception) -> None:
    def fail(*_: Any) -> None:
        raise error

    with pytest.raises(type(error), match=f"^{error}$"):
        run_all(root, [(4.0,)], scheduler="here", progress=fail)
    with pytest.raises(type(error), match=f"^{error}$"):
        run_all(root, [(0.0,)], scheduler="here", on_death=fail)


@pytest.mark.parametrize("error", [OSError("disk full"), ValueError("cannot be pickled")])
def test_what_cannot_be_sent_is_not_laid_to_the_scheduler(error: Exception, monkeypatch: pytest.MonkeyPatch) -> None:
    def submit(*_: Any, **__: Any) -> None:
        raise error

    monkeypatch.setattr(Client, "submit", submit)
    with pytest.raises(type(error), match=f"^{error}$"):
        run_all(root, [(4.0,)], scheduler="here")


@pytest.mark.parametrize("lost", [TimeoutError("it is gone"), None])
def test_an_error_that_went_with_the_scheduler_is_asked_for_again(
    lost: Exception | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked = []

    def gone_at_first(call: Answered, timeout: float) -> Any:
        asked.append(call)
        if len(asked) > 1:
            return call.given
        if lost is not None:
            raise lost
        return None

    monkeypatch.setattr(Answered, "exception", gone_at_first)
    with pytest.raises(ValueError, match=r"^negative$"):
        run_all(root, [(-1.0,)], scheduler="here")
    assert len(asked) == 2


def test_a_scheduler_that_stays_away_gives_up_what_is_left_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    def goes_away(client: Client, address: str, timeout: float, set_as_default: bool) -> None:
        if Client.status == "closed":
            raise OSError("connection refused")
        monkeypatch.setattr(Client, "status", "closed")

    monkeypatch.setattr(Client, "__init__", goes_away)
    monkeypatch.setattr("comparison.workers.AHEAD_ON_CLUSTER", 1)
    found = run_all(root, [(4.0,), (9.0,)], scheduler="here", on_death=lambda i, why: (i, "went away" in why))
    assert found == [2.0, (1, True)]
    with pytest.raises(ValueError, match="none answers at here"):
        run_all(root, [(4.0,)], scheduler="here")
