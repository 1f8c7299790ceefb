"""What is asked of one beam, the run that answers it, and the runs that say how well.

    question ─► run, and companions: one more for each cause of error ─► readings ─► numbers  (:mod:`comparison.runs`)

- early (before :data:`EARLY` T*; of a beam that does not converge before waves return from its ends): on elements that
  resolve the front, with the damping at grid scale that this takes;
- later, and for the whole impact: of the whole beam, strictly unilateral, with no damping but the beam's own.

Companions, by cause of error:

    mesh_and_step      half as many elements and steps
    finer              twice as many: asked for, or late, without damping, on a soft wall (coarser ones agree by chance)
    contact_law, …     late, on a rigid wall: another contact law, as no refinement of a scheme shows what it does
    contact_law_coarser  a rebound, where the path asks for it: the same on half of the elements, as laws may agree by
                       chance; the larger change counts
    waves_absorbed     early, stated η < 3e-5 T*: no grid viscosity, on even elements
    fit_of_the_loss    of a material with hysteretic loss: more of it
    drawn_0, …         late, without damping, not on a soft wall, where motion does not converge: in place of all these,
                       elements, steps and contact laws drawn from a seed

With hardly any damping a beam keeps the short waves that its ends send back at once. Grid viscosity absorbs them in a
run and in its coarser companion alike: ``waves_absorbed`` shows what that does. The same question gets the same
numbers, from runs that are kept. An error that no companion shows is a known size (CONTRIBUTING.md says where).
"""

from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from bent_beam import ImpactHistory, InputError
from bent_beam.checks import one_of, positive, whole
from bent_beam.hysteresis import branches_of, converges, is_damped
from bent_beam.impact import BEFORE_WAVES_RETURN, Impact
from bent_beam.loads import beyond_first_order
from bent_beam.measure.instant import BEYOND
from bent_beam.method import Method, Progress, for_whole_beam, refined, simulate_to_separation, simulated

EARLY = 0.003  # T*
COARSER, FINER = 0.5, 2.0
OF_REBOUND = "contact_law_coarser"  # the companion that is compared with ``mesh_and_step``, not with the run
DRAWN, SEED = 5, 15  # runs of an ensemble at a time, without damping
WEAK = 3e-5  # η/T*: with less a beam keeps waves that grid viscosity absorbs
RESOLVES = 0.05  # a whole beam's elements refined by RESOLVES/√(t/T*) are a tenth of √(ct) long
EARLIEST = 1e-5  # T*: before, those waves carry less than 0.1 ‰ of the impulse
OF_SHORT, SHORT = 2.0, 0.05  # to SHORT, T*, a run has OF_SHORT times the elements of a whole impact; to later, fewer
FINEST, SOON = 4.0, 0.025  # before SOON, T*, it has more, FINEST times at most, to resolve what the first instants left
FEWEST = 4  # elements of a half beam, and steps
LONGEST_STEP = 0.05  # T*: twenty in a period of a whole beam's first mode, ten of a coarser companion
INSTANTS, OF_UNIT = 200, 2000  # saved: up to the time asked, evenly in √t; of a whole impact, a T*
ERROR_BARS = {"drift": (), "quick": (COARSER,), "thorough": (COARSER, FINER)}
"""Resolutions of the companion runs that error bars come from, by name."""


@dataclass(frozen=True)
class Question:
    """One beam by one method. until : s; ``None``: the whole impact, to its last separation. save : saved instants,
    see :data:`INSTANTS`. error_bars : a key of :data:`ERROR_BARS`. damping_stated : whether ``impact`` has the damping
    of the beam. A beam of which none is stated is taken to have enough to absorb short waves: no companion is run for
    them. band : (runs, seed) of an ensemble in place of run and companions.

    A run to a time t goes on to 1.1 t: means over a tenth of the time are read around t.
    """

    impact: Impact
    method: Method
    until: float | None = None
    save: int | None = None
    error_bars: str = "quick"
    damping_stated: bool = True
    band: tuple[int, int] | None = None

    def __post_init__(self) -> None:
        one_of("error_bars", self.error_bars, ERROR_BARS)
        if self.until is not None:
            positive("until", self.until)
        if self.save is not None:
            whole("save", self.save, 2)
        if self.error_bars == "thorough" and self.late and not converges(self.impact):
            raise InputError("error_bars: 'thorough' has no effect without damping: bars are those of an ensemble")

    @property
    def late(self) -> bool:
        """Whether it is about the whole beam and not about the first spread of its contact."""
        first = EARLY if converges(self.impact) else BEFORE_WAVES_RETURN
        return self.until is None or self.until > first * self.impact.slow_time_scale

    @property
    def first_spread(self) -> bool:
        """Whether the zone spreads for the first time, from the middle of a beam before a rigid wall, under no loads
        but those that theory knows to first order. It pushes at its rim; where the beam shears, behind the rim."""
        lossless = self.impact.replace(hysteretic_loss=0.0, loss_frequency=None)
        return beyond_first_order(lossless) is None and not self.impact.off_centre and not self.late

    @property
    def run_by(self) -> Method:
        """The method with all its open settings chosen; of a band the first method drawn."""
        return self._own() if self.band is None else self._drawn(*self.band)[0]

    def _own(self) -> Method:
        """The method as this question takes it. Raises :class:`InputError` for elements or steps so long that a run
        with longer ones, from which the bar comes, is the same or means nothing."""
        chosen = self._chosen(self.method)
        if self.late:
            check_lengths(chosen, self.impact, LONGEST_STEP * self.impact.slow_time_scale, "for the whole beam")
        elif self.until is not None and ERROR_BARS[self.error_bars]:
            check_lengths(chosen, self.impact, self.until / FEWEST, f"until {self.until:.6g} s")
        return chosen

    def _chosen(self, method: Method) -> Method:
        """``method`` as this question takes it: a whole beam's elements are the finer the sooner a run ends."""
        if not self.late:
            return method
        mesh, step = getattr(method, "mesh", None), getattr(getattr(method, "integrator", None), "time_step", None)
        finer = 1.0
        if self.until is not None and mesh is None and step is None:
            end = self.until / self.impact.slow_time_scale
            finer = max(1.0, OF_SHORT * min(1.0, SHORT / end) ** (1.0 / 3.0))
            finer = min(finer * max(1.0, SOON / end) ** 0.5, FINEST)
        return for_whole_beam(refined(method, finer) or method, self.impact)

    def companions(self) -> dict[str, tuple[Impact, Method]]:
        """Cause of error → what is run for it."""
        if self.error_bars == "drift":
            return {}
        if self.late and not converges(self.impact):
            drawn = self._drawn(DRAWN, SEED) if self.band is None else self._drawn(*self.band)[1:]
            return {f"drawn_{i}": (self.impact, one) for i, one in enumerate(drawn)}
        chosen, others = self.run_by, dict[str, Method]()
        # without damping, before a soft wall, a coarser run may agree by chance
        factors = ERROR_BARS["thorough" if self.late and not is_damped(self.impact) else self.error_bars]
        for name, factor in (("mesh_and_step", COARSER), ("finer", FINER)):
            if factor in factors and (other := refined(chosen, factor)) is not None:
                others[name] = other
        if (inviscid := self._without_viscosity()) is not None:
            others["waves_absorbed"] = inviscid
        if self.late and hasattr(chosen, "cross_checks"):
            checks = chosen.cross_checks(self.impact)
            others |= {cause: one for cause, one in checks.items() if self.until is None or cause != OF_REBOUND}
        found = {cause: (self.impact, other) for cause, other in others.items()}
        branches = branches_of(self.impact)
        if branches is not None:  # what a fit of the material leaves
            loss = min(1.0, self.impact.hysteretic_loss * (1.0 + branches.deviation))
            found["fit_of_the_loss"] = (self.impact.replace(hysteretic_loss=loss), chosen)
        return found

    def _without_viscosity(self) -> Method | None:
        """For an early question about a beam of hardly any damping: a whole beam's method."""
        impact, until = self.impact, self.until
        undamped = self.damping_stated and not impact.hysteretic_loss and impact.relative_damping < WEAK
        if self.late or until is None or not undamped or getattr(self.method, "mesh", None) is not None:
            return None
        share = until / impact.slow_time_scale
        if share < EARLIEST or not hasattr(self.method, "for_whole_beam"):
            return None
        whole: Any = self.method
        if getattr(whole, "domain", None) is not None:  # of the run, not of this companion
            whole = replace(whole, domain=None)
        finer = refined(whole, max(1.0, RESOLVES / share**0.5))
        return None if finer is None else for_whole_beam(finer, impact)

    def _drawn(self, runs: int, seed: int) -> list[Method]:
        """An ensemble of a beam without damping: elements, steps and contact laws drawn at random; with a mesh,
        contact or integrator that the user has stated, and of a path that draws nothing itself, coarser ones. Raises
        ``ValueError`` where the path varies neither elements nor steps."""
        random, found = np.random.default_rng(seed), list[Method]()
        stated = any(getattr(self.method, part, None) is not None for part in ("mesh", "contact", "integrator"))
        for _ in range(runs):
            if hasattr(self.method, "varied") and not stated:
                one: Method | None = self._chosen(self.method.varied(self.impact, random))
            else:
                one = refined(self._own(), 2.0 ** random.uniform(-1.5, -0.5))
            if one is None:
                raise InputError(
                    f"damping: without damping of the beam a whole impact is a band, and {self.method.path} varies "
                    "neither elements nor steps; state a damping"
                )
            found.append(one)
        return found

    def run(self, method: Method, impact: Impact | None = None, progress: Progress | None = None) -> ImpactHistory:
        """The run of ``method``, as chosen; of another ``impact`` for a companion."""
        beam = self.impact if impact is None else impact
        if self.until is None:
            return simulate_to_separation(method, beam, save=self.save or OF_UNIT, progress=progress)
        number = self.save or INSTANTS
        within = max(number, round(number * BEYOND**0.5) - 1)  # the time asked is one of them
        times = self.until * np.append(np.arange(1, within + 1) / number, BEYOND**0.5) ** 2
        return simulated(method.simulate, beam, end_time=float(times[-1]), save=times, progress=progress)

    def key(self, impact: Impact) -> dict[str, Any]:
        """What a run of it depends on next to its method, JSON-ready. A new field that changes runs belongs here."""
        return {"impact": asdict(impact), "until": self.until, "save": self.save}


def check_lengths(method: Method, impact: Impact, longest: float, why: str) -> None:
    """Raises :class:`InputError` for given elements or steps so long that a run with half as many is the same or means
    nothing. longest : of the steps, s, in words ``why``."""
    given: list[Any] = [getattr(method, name, None) for name in ("mesh", "integrator", "refine")]
    mesh, steps, refine = *given[:2], given[2] or 1.0
    if hasattr(mesh, "nodes") and (count := mesh.refined(refine).nodes(impact.half_length).size - 1) < FEWEST:
        raise InputError(
            f"{method.path}.mesh has {count} elements in a half beam of {impact.half_length:.6g} m, and "
            f"{FEWEST} are the fewest: the error bar comes from a run with half as many"
        )
    for name in ("time_step", "flight_step"):
        value = getattr(steps, name, None) or 0.0
        if value > refine * longest * (1.0 + 1e-5):
            key = f"{method.path}.integrator.{name}"
            raise InputError(f"{key} must be at most {refine * longest:.6g} s {why} (got {value:.6g})")
