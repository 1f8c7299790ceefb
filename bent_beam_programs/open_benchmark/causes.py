"""Causes of symptoms: named only where the first symptom has one cause alone.

A wall on springs pushes where it is penetrated, and by as much. A thin first front throws the zone off the wall as a
whole. Sums are wrong where momentum alone is violated. Everything else has several causes, and none is named.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from bent_beam_programs.open_benchmark.judgement import PART, Finding, Score
from bent_beam_programs.open_benchmark.result import Result
from bent_beam_programs.open_benchmark.symptoms import last_push

SUSPECT = 0.2  # κ/ν below which the first instants may throw the zone off the wall
EVEN = 0.08  # unevenness of a zone that was laid down point after point, without rebounds
PROPORTIONAL = 0.8  # cosine between pushes and penetrations of a wall on springs; 1 where no dashpot helps


def _on_springs(result: Result, found: Score) -> bool:
    """Whether the wall pushes where it is penetrated, and by as much: the law of springs."""
    if result.node_x is None:
        return False
    last = [last_push(result, *snapshot) for snapshot in result.snapshots()]
    depth, force = (np.hstack(parts) for parts in zip(*[(np.maximum(-gap, 0.0), push / t) for push, gap, t in last]))
    size = float(np.linalg.norm(depth) * np.linalg.norm(force))
    return size > 0.0 and float(depth @ force) / size > PROPORTIONAL


def _thrown_off(result: Result, found: Score) -> bool:
    """Whether a zone of a thin first front is lifted, the less so the later (V₀τ outgrows what was thrown up), and was
    laid down evenly: not by points that rebound one by one."""
    zone = 0.5 * np.sqrt(2.0 / result.problem.kappa_over_nu)
    heights = [gap[np.abs(x) <= zone * np.sqrt(when)].max() / when for when, x, gap in result.snapshots()]
    thin = result.problem.kappa_over_nu < SUSPECT and (found.figure("noise_in_space") or 0.0) < EVEN
    return thin and len(heights) > 1 and bool(np.all(np.diff(heights) < 0.0))


def _in_the_books(result: Result, found: Score) -> bool:
    """Whether momentum alone is violated, and contact, motion and energy are sound: then sums or masses are wrong."""
    return not {one.name for one in found.symptoms} & {"energy", "penetration", "lift", "far_end", "motion"}


def _settled(result: Result, found: Score) -> bool:
    """Whether a pull is declared, or read off impulses that are smooth: those that jitter fall, too."""
    return not result.pull_is_read_off or (found.figure("noise_in_time") or 0.0) < PART / 2.0


BOOKS = ("momentum", _in_the_books, "every step's impulse of every point, once; the beam's own mass")
CAUSES: dict[str, tuple[str, Callable[[Result, Score], bool], str]] = {
    "energy": ("energy_gained", lambda result, found: True, "steps, contact and loads: find what does work"),
    "pull": ("adhesion", _settled, "clip the contact's force at zero, or release held points sooner"),
    "momentum": BOOKS,
    "displacement": BOOKS,
    "penetration": ("soft_penalty", _on_springs, "a stiffer contact: as stiff as an element's bending, 12 EI/Δx³"),
    "lift": ("start_unresolved", _thrown_off, "smaller elements at the first touch, or closed points held at first"),
}


def causes(result: Result, found: Score) -> tuple[Finding, ...]:
    """The cause that the first symptom has alone, else whether a number is off, or that the result is clean."""
    if found.symptoms and (known := CAUSES.get(found.symptoms[0].name)) and known[1](result, found):
        return (Finding(known[0], str(found.symptoms[0]), known[2]),)
    if found.off:
        return (Finding("off", found.reason or "", "the problem's numbers, then mesh and steps"),)
    compared = any(number.difference is not None for number in found.measured.values())
    return (Finding("clean"),) if compared and not found.symptoms else ()
