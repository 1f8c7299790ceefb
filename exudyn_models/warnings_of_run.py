"""What a reader of a result should know: the warnings of a run."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from exudyn_models.recording import Recorder
from exudyn_models.resolution import far_field
from exudyn_models.scaling import Scaling, front_bound
from exudyn_models.settling import Settling

__all__ = ["warnings_of_run"]

Array = NDArray[np.float64]


LARGEST_STEP = 0.05  # of the end time: the front then moves by a fortieth of the contact length in one
MOST_CYCLES = 0.05  # of the steps
MOST_GIVEN = 1e-3  # of the initial energy, by the contact
MOST_PULLED = 1.0  # of the total impulse


def warnings_of_run(
    run: Recorder,
    places: Array,
    half_length: float,
    scaling: Scaling,
    given: bool,
    last_step: float,
    settling: Settling | None,
) -> list[str]:
    """Sentences about one run; ``places`` (nodes of the half beam), ``last_step`` in model units, ``half_length`` in m,
    ``given``: the mesh was asked for."""
    found = []
    if last_step > LARGEST_STEP:
        found.append(f"time steps of {last_step:.2g} end_time cannot follow the front; {LARGEST_STEP:g} is the most")
    if settling is not None and settling.unsettled:
        found.append(f"in {settling.unsettled} of {settling.steps} steps the contact state had not settled")
    if settling is not None and settling.cycles > MOST_CYCLES * settling.steps:
        found.append(
            f"in {settling.cycles} of {settling.steps} steps no contact state was consistent; take smaller steps or "
            "less contact damping"
        )
    amplitude = scaling.amplitude
    penetration = run.deepest / amplitude
    if penetration > 0.01:
        found.append(
            f"the beam enters the wall by up to {penetration:.2%} of V0 t; take a stiffer penalty or smaller steps"
        )
    lost = np.asarray(run.record.contact_loss)
    given_back = float((np.maximum.accumulate(lost) - lost).max(initial=0.0))
    initial = run.record.kinetic[0] + run.record.strain[0] if lost.size else 0.0
    if given_back > MOST_GIVEN * initial:
        found.append(
            f"the contact gave {given_back / initial:.2g} of the initial energy: steps too long for it; take steps of "
            "0.5 dx^2 sqrt(mu/EI) at most, or longer elements"
        )
    if -run.held > MOST_PULLED * abs(run.total):
        found.append(
            f"contact points were pulled by {-run.held / abs(run.total):.2g} times the total impulse while held: their "
            "reactions mean nothing one by one"
        )
    front = front_bound(scaling.kappa)
    if len(run.record.time) > 1:
        bending = 2.0 / front
        for part in (1.0, 0.1):
            at = front * math.sqrt(part)
            k = min(int(np.searchsorted(places, at)), places.size - 2)
            per = bending * math.sqrt(part) / (places[k + 1] - places[k])
            if per < 3.0:
                when = "the end time" if part == 1.0 else f"{part:g} of the end time"
                found.append(f"under-resolved front: its bending length holds {per:.1f} elements at {when}, needs 3")
                break
    if given:
        growth = places[2:] - places[1:-1]
        growth = growth / (places[1:-1] - places[:-2])
        if growth.max() > 1.021:
            found.append(f"the mesh grows by {growth.max() - 1:.0%} an element: above 2 % it reflects waves back")
    reach = half_length / scaling.length
    if reach < 0.5 * far_field(scaling):
        found.append(
            f"the end lies at {reach:.3g} sqrt(sqrt(EI/mu) T): waves reflected there come back before the end time"
        )
    if run.record.y:
        untouchable = np.ones(run.beam.shape.s.size, bool)
        near = np.searchsorted(run.beam.shape.s, run.contact.contact_s)
        untouchable[max(0, near.min() - 1) : near.max() + 2] = False
        if (run.record.y[-1][untouchable] > 0.0).any():
            found.append("the beam enters the wall outside the zone given contact points")
    wall = run.beam.shape.wall_slope
    slope = max((float(np.abs(s + wall).max()) for s in run.record.slope), default=0.0)
    if run.beam.shape.slender and slope > 0.1:
        found.append(f"slopes up to {slope:.2g}: linear theory no longer describes this beam, only its first instants")
    elif slope > 0.1:
        found.append(
            f"the model's slopes reach {slope:.2g}, beyond its elements' linear range (κ/ν = {scaling.kappa:.3g}); "
            'set a smaller "amplitude" in [exudyn.geometry]'
        )
    return found
