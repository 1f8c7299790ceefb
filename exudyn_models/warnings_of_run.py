"""What the reader of a run should know: steps, mesh and ends that it could not do with, and how far contact and slopes
are beyond what is modelled."""

import math
from collections.abc import Iterator

import numpy as np

from bent_beam import Impact, ImpactHistory
from exudyn_models.assembly import Layout
from exudyn_models.geometry import Array, Scaling, supports_or_plate
from exudyn_models.recording import Recorder
from exudyn_models.resolution import far_field
from exudyn_models.settling import Settling
from exudyn_models.stepping import Stepping

LARGEST_STEP = 0.05  # of the end time: the front then moves by a fortieth of the contact length in one
MOST_CYCLES = 0.05  # of the steps
DEEPEST = 0.01  # of V₀t
MOST_GIVEN = 1e-3  # of the initial energy, by the contact
MOST_PULLED = 1.0  # of the total impulse
NEEDED = 3.0  # elements over the front's bending length
STEEPEST_GROWTH = 1.021  # of neighbouring elements
STEEPEST_SLOPE = 0.1  # slope


def warnings_of_run(stepping: Stepping, history: ImpactHistory) -> list[str]:
    """Sentences about one run."""
    run, layout, scaling = stepping.run, stepping.layout, stepping.layout.scaling
    found = [*_of_steps(stepping.segments[-1].length, stepping.settling), *_of_contact(run, history)]
    if not supports_or_plate(scaling.impact):
        if len(run.record["time"]) > 1:
            found += _of_front(layout.places, scaling)
        found += [*_of_mesh(layout, scaling.impact, stepping.chosen.mesh_given), *_of_depth(run)]
    return [*found, *_of_slopes(run)]


def _of_steps(last_step: float, settling: Settling | None) -> Iterator[str]:
    if last_step > LARGEST_STEP:
        yield f"time steps of {last_step:.2g} end_time cannot follow the front; {LARGEST_STEP:g} is the most"
    if settling is not None and settling.unsettled:
        yield f"in {settling.unsettled} of {settling.steps} steps the contact state had not settled"
    if settling is not None and settling.cycles > MOST_CYCLES * settling.steps:
        yield (
            f"in {settling.cycles} of {settling.steps} steps no contact state was consistent; take smaller steps or "
            "less contact damping"
        )


def _of_mesh(layout: Layout, impact: Impact, given: bool) -> Iterator[str]:
    lengths, reach = np.diff(layout.places), layout.half_length / layout.scaling.length
    growth = float((lengths[1:] / lengths[:-1]).max())
    if given and growth > STEEPEST_GROWTH and not impact.forces:  # a node is moved to each
        yield f"the mesh grows by {growth - 1:.0%} an element: above 2 % it reflects waves back"
    cut = layout.half_length < impact.half_length * (1.0 - 1e-9)  # the beam's own ends reflect rightly
    if cut and reach < 0.5 * far_field(layout.scaling):
        yield f"the end lies at {reach:.3g} sqrt(sqrt(EI/mu) T): waves reflected there come back before the end time"


def _of_contact(run: Recorder, history: ImpactHistory) -> Iterator[str]:
    penetration = run.deepest / run.scaling.amplitude
    if penetration > DEEPEST and run.scaling.impact.wall_stiffness is None:
        yield f"the beam enters the wall by up to {penetration:.2%} of V0 t; take a stiffer penalty or smaller steps"
    lost, held = history.array("loss_impact"), float(run.sums["held_impulse"])
    given_back = float((np.maximum.accumulate(lost) - lost).max())
    initial = float(history.array("kinetic_energy")[0] + history.array("strain_energy")[0])
    if given_back > MOST_GIVEN * initial:
        yield (
            f"the contact gave {given_back / initial:.2g} of the initial energy: steps too long for it; take steps of "
            "0.5 dx^2 sqrt(mu/EI) at most, or longer elements"
        )
    if -held > MOST_PULLED * abs(run.total):
        yield (
            f"contact points were pulled by {-held / abs(run.total):.2g} times the total impulse while held: their "
            "reactions mean nothing one by one"
        )


def _of_front(places: Array, scaling: Scaling) -> list[str]:
    """The first of two times at which the bending ahead of the front has too few elements."""
    for part, when in ((1.0, "the end time"), (0.1, "0.1 of the end time")):
        k = min(int(np.searchsorted(places, scaling.front * math.sqrt(part))), places.size - 2)
        held = 2.0 / scaling.front * math.sqrt(part) / (places[k + 1] - places[k])
        if held < NEEDED:
            shown = math.floor(100.0 * held) / 100.0
            return [f"under-resolved front: its bending length holds {shown:g} elements at {when}, needs {NEEDED:g}"]
    return []


def _of_depth(run: Recorder) -> Iterator[str]:
    record, shape, near = run.record, run.beam.shape, run.contact.nodes
    untouchable = np.ones(shape.s.size, bool)
    untouchable[max(0, near.min() - 1) : near.max() + 2] = False
    free = shape.y + record["time"][-1] * shape.velocity_y - shape.wall_y  # what enters so is let through
    if (record["y"][-1][untouchable & (free <= 0.0)] > 0.0).any():
        yield "the beam enters the wall outside the zone given contact points"


def _of_slopes(run: Recorder) -> Iterator[str]:
    record, shape = run.record, run.beam.shape
    slope = max(float(np.abs(s + shape.wall_slope).max()) for s in record["slope"])
    if slope > STEEPEST_SLOPE and shape.slender:
        yield f"slopes up to {slope:.2g}: linear theory no longer describes this beam, only its first instants"
    elif slope > STEEPEST_SLOPE:
        yield (
            f"the model's slopes reach {slope:.2g}, beyond its elements' linear range (κ/ν = {run.scaling.kappa:.3g}); "
            'set a smaller "amplitude" in [exudyn.geometry]'
        )
