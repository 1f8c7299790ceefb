"""The whole impact of one case for a prediction, and over a plausible range of damping: from the stored map where it
reaches and is sure (a beam without loads, a second wall or rocking), otherwise by a run and its companions on coarse
elements."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from bent_beam.cases import Case
from bent_beam.free_flight import LOWEST_PERIOD
from bent_beam.hysteresis import converges
from bent_beam.impact import Impact
from bent_beam.loads import unmodelled
from bent_beam.measure.measured import Band, Measured
from bent_beam.measure.whole_impact import whole_impact
from bent_beam.method import Method, for_whole_beam, refined, simulate_to_separation
from bent_beam.section import Section
from comparison.bounce import Number, largest_stress, scales
from comparison.companions import companions_of, number_of
from comparison.whole_impact.stored_map import bounce_from_map

__all__ = ["over_damping", "predicted_impact"]

NUMBERS = ("restitution", "last_contact", "peak_moment")
WIDE = 0.05  # error bar of the map's largest moment over its value, beyond which the beam is simulated
COARSE, INSTANTS = 0.5, 1000  # resolution, and saved instants a T*
LONGEST = 3.0  # T*: a loaded beam that is then still at the wall is not followed further
SAME = 1e-6  # relative: dampings that are one
DAMPING_RATIOS = (0.002, 0.01, 0.05)  # of the first mode: of a plain steel bar, of one with joints, of a damped one


def predicted_impact(case: Case, method: Method | None) -> dict[str, Any] | None:
    """Restitution, last contact, largest moment and stress of the whole impact, SI; ``None`` where nothing says them.

    method : to simulate with (``None``: nothing is simulated).
    """
    impact = case.impact
    found, source = _found(impact, method)
    if found is None:
        return None
    return {
        "restitution": found["restitution"].to_dict(),
        "last_contact": found["last_contact"].scaled(impact.slow_time_scale).to_dict(),
        **_peaks(impact, case.section, found["peak_moment"]),
        "peak_force": found["peak_force"].scaled(scales(impact)["force"]).to_dict() if "peak_force" in found else None,
        "source": source,
        "over_damping": over_damping(impact, case.section, method, found["peak_moment"]),
    }


def over_damping(impact: Impact, section: Section | None, method: Method | None, own: Number) -> list[dict[str, Any]]:
    """Largest moment, N m, and stress, Pa, of the whole impact over a plausible range of the damping ratio.

    own : the largest moment of ``impact`` itself over V₀√(μEI), the number at its own damping ratio.
    """
    found = []
    for ratio in DAMPING_RATIOS:
        damping = ratio * LOWEST_PERIOD / math.pi * impact.slow_time_scale
        numbers: Mapping[str, Number] | None = {"peak_moment": own}
        if not math.isclose(damping, impact.damping, rel_tol=SAME):
            numbers, _ = _found(impact.replace(damping=damping, hysteretic_loss=0.0, loss_frequency=None), method)
        if numbers is not None:
            found.append({"damping_ratio": ratio, **_peaks(impact, section, numbers["peak_moment"])})
    return found


def _found(impact: Impact, method: Method | None) -> tuple[Mapping[str, Number] | None, str]:
    """The numbers of the whole impact, and where they come from; ``None`` where nothing says them."""
    found = _from_map(impact)
    if found is None and method is not None and impact.opposite_wall is None:
        return _simulated(impact, method), "simulation"
    return found, "stored map"


def _from_map(impact: Impact) -> Mapping[str, Number] | None:
    if impact.loaded_to_first_order or impact.off_centre or unmodelled(impact, ()) is not None:
        return None
    found = bounce_from_map(impact.kappa_over_nu, impact.relative_damping)
    moment = None if found is None else found["peak_moment"]
    return None if isinstance(moment, Measured) and moment.bar > WIDE * moment.known else found


def _peaks(impact: Impact, section: Section | None, largest: Number) -> dict[str, Any]:
    """Largest moment, N m, and stress, Pa, from the moment over V₀√(μEI)."""
    moment, stress = largest.scaled(scales(impact)["moment"]), largest_stress(largest, impact, section)
    return {"peak_moment": moment.to_dict(), "peak_stress": None if stress is None else stress.to_dict()}


def _simulated(impact: Impact, method: Method) -> dict[str, Number]:
    """The whole impact by one run and its companions; restitution is missing where the beam has not left."""
    chosen, longest = for_whole_beam(refined(method, COARSE) or method, impact), LONGEST * impact.slow_time_scale
    outcomes = [
        whole_impact(simulate_to_separation(one, impact, longest=longest, save=INSTANTS))
        for one in (chosen, *companions_of(chosen, impact, longest))
    ]
    left = all(outcome.left for outcome in outcomes)
    found: dict[str, Number] = {}
    for name in NUMBERS if outcomes[0].peak_force is None else (*NUMBERS, "peak_force"):
        values = [float(getattr(outcome, name)) for outcome in outcomes]
        least = 0.5 * outcomes[0].spacing if name == "last_contact" else 0.0
        number = number_of(values, impact, least) if converges(impact) else Band.of(values)
        found[name] = number if left or name in ("peak_moment", "peak_force") else Measured()
    return found
