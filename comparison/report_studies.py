"""The parameter studies' conclusions for the report, where :mod:`comparison.studies` has cheap ones."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["StudyNote", "cheap_studies"]


@dataclass(frozen=True)
class StudyNote:
    """A study's title and its conclusion in words, or why it is left out."""

    name: str
    title: str
    conclusion: str
    failed: bool = False


def cheap_studies(jobs: int) -> list[StudyNote]:
    """Conclusions of the cheap studies; none when this installation has no studies."""
    return []
