"""The parameter studies' conclusions for the report, as far as this installation has studies."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from bent_beam.cases import Case, case_from_tables
from comparison.store import RunStore
from comparison.workers import run_all

__all__ = ["StudyNote", "common_ending", "known_studies", "study_notes"]

BEAM = {"bending_stiffness": 1.0, "mass_per_length": 1.0}
USUAL: dict[str, Any] = {
    "title": "thesis, K = 10 1/m, V₀ = 20 m/s (κ/ν = 0.5)",
    "beam": {**BEAM, "length": 50.0, "curvature": 10.0},
    "impact": {"velocity": 20.0},
    "run": {"duration": 0.1},
}
FIRST_ORDER: dict[str, Any] = {
    "title": "thesis, V₀ = 3.5 m/s, K = 0.35 1/m, L = 2 m (κ/ν = 0.1)",
    "beam": {**BEAM, "length": 2.0, "curvature": 0.35},
    "impact": {"velocity": 3.5, "acceleration": 700.0},
    "run": {"duration": 0.05},
}
OWN_CASES = {"first-order-case": FIRST_ORDER}


@dataclass(frozen=True)
class StudyNote:
    """A study's title, its case and its conclusion in words, or why it is left out."""

    name: str
    title: str
    conclusion: str
    case: str = ""
    failed: bool = False


def known_studies() -> dict[str, str]:
    """Name → title of the studies that there are; none when they cannot be imported."""
    try:
        from comparison.studies import STUDIES
    except ImportError:
        return {}
    return {name: study.title for name, study in STUDIES.items()}


def case_of(name: str) -> Case:
    """The thesis's case that a study is shown on."""
    return case_from_tables(OWN_CASES.get(name, USUAL))


def study_notes(
    names: Sequence[str],
    *,
    store: RunStore,
    jobs: int = 1,
    progress: Callable[[int, int], None] | None = None,
) -> list[StudyNote]:
    """Conclusions of the studies, ``jobs`` at a time; one that fails says why and how to run it alone."""
    titles = known_studies()
    folder = None if store.folder is None else str(store.folder)
    wanted = [(name, titles.get(name, name), folder) for name in names]

    def died(place: int, why: str) -> StudyNote:
        return lost(*wanted[place][:2], why)

    return list(run_all(_note, wanted, jobs=jobs, progress=progress, on_death=died))


def _note(name: str, title: str, folder: str | None) -> StudyNote:
    """One study in a worker."""
    case = case_of(name)

    def compute() -> dict[str, Any]:
        from comparison.studies import run_study

        return {"conclusion": run_study(name, case).conclusion}

    try:
        question = {"study": name, "case": OWN_CASES.get(name, USUAL)}
        found = RunStore(Path(folder) if folder else None).answer(question, compute)
    except Exception as error:  # a study is an extra: whatever is wrong with it, the report goes on
        return lost(name, title, f"{type(error).__name__}: {' '.join(str(error).split())}")
    return StudyNote(name, title, str(found["conclusion"]), case.title)


def lost(name: str, title: str, why: str) -> StudyNote:
    """The note of a study that could not be run."""
    return StudyNote(
        name,
        title,
        f"Left out ({why}). To run it alone: bentbeam study {name} cases/thesis_K10.toml",
        failed=True,
    )


def common_ending(notes: Sequence[StudyNote]) -> str:
    """The last sentence, where several conclusions share it: to be said once."""
    endings = Counter(ending_of(n.conclusion) for n in notes if not n.failed)
    text, times = endings.most_common(1)[0] if endings else ("", 0)
    return text if times >= 3 else ""


def ending_of(conclusion: str) -> str:
    """The last sentence of a text (a full stop followed by a capital starts a new one)."""
    start = 0
    for place in range(len(conclusion) - 2):
        if conclusion[place : place + 2] == ". " and conclusion[place + 2].isupper():
            start = place + 2
    return conclusion[start:]
