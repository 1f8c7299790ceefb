"""Error bars of one beam's run from other runs of it: which to make, and what they say.

- early (before :data:`EARLY` T*; without damping before waves return from the ends): elements and steps twice as long;
- later, with damping: half as many elements, and another contact law on the same ones: no refinement of one scheme
  shows what the scheme does;
- later, without damping, where motion does not converge: other elements, steps and contact laws, drawn at random from a
  seed. Numbers are the means of all with two standard deviations.
"""

from __future__ import annotations

import math
import statistics
from collections.abc import Sequence

import numpy as np

from bent_beam.hysteresis import converges
from bent_beam.impact import BEFORE_WAVES_RETURN, Impact
from bent_beam.measure.measured import Measured
from bent_beam.method import Method, for_whole_beam, refined

__all__ = ["companions_of", "is_late", "number_of", "suited"]

EARLY = 0.003  # T*
BAR = 1.5  # times what another run changes: elements are of first order
LEAST = 2e-3  # of a value: what two codes differ by where both resolve everything
COARSER = 0.5
DRAWN, SEED = 5, 15  # runs without damping


def is_late(impact: Impact, end: float) -> bool:
    """Whether a run to ``end``, s, is one of the whole beam."""
    return end > (EARLY if converges(impact) else BEFORE_WAVES_RETURN) * impact.slow_time_scale


def suited(method: Method, impact: Impact, end: float) -> Method:
    """``method`` with what it leaves open chosen for a run to ``end``, s: a whole beam's choices lose no energy."""
    return for_whole_beam(method, impact) if is_late(impact, end) else method


def companions_of(
    method: Method, impact: Impact, end: float, refine: float = 1.0, *, stated: bool = False
) -> list[Method]:
    """Runs to compare one to ``end``, s, with.

    refine : how much finer ``method`` is than a whole beam's choice. stated : its mesh is the user's own, so that
    without damping it is coarsened at random, and no other parts are drawn.
    """
    coarser = refined(method, COARSER)
    others = [] if coarser is None else [coarser]
    if not is_late(impact, end):
        return others
    random = np.random.default_rng(SEED)
    if not converges(impact) and stated:
        return [one for _ in range(DRAWN) if (one := refined(method, 2.0 ** random.uniform(-1.0, 0.0))) is not None]
    if not converges(impact) and hasattr(method, "varied"):
        drawn = [method.varied(impact, random) for _ in range(DRAWN)]
        return [refined(one, refine) or one for one in drawn]
    checks = method.cross_checks(impact) if hasattr(method, "cross_checks") else {}
    return [*others, *(other for cause, other in checks.items() if cause == "contact_law")]


def number_of(values: Sequence[float], impact: Impact, least: float = 0.0) -> Measured:
    """A number from the run's own value and its companions'; its error bar is at least ``least``."""
    first, *others = values
    if not others:
        return Measured(first)
    if not converges(impact) and len(others) > 1:
        return Measured(statistics.fmean(values), max(2.0 * statistics.stdev(values), least, LEAST * abs(first)))
    return Measured(first, max(BAR * math.hypot(*(v - first for v in others)), least, LEAST * abs(first)))
