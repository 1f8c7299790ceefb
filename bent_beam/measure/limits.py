"""Limits of what the checks of a run may leave (:mod:`bent_beam.measure.balance`), path by path."""

from typing import Any

from bent_beam.history import ImpactHistory

LIMITS = {
    "hermite": {"penetration": 1e-3, "pull": 1e-3, "energy": 4e-7, "middle_slope": 1e-9},
    "self_similar": {"penetration": 1e-5, "pull": 0.1, "energy": 0.06, "middle_slope": 3e-8},
    "exudyn": {"penetration": 2e-3, "pull": 1e-6, "energy": 4e-7, "middle_slope": 1e-9, "law": 4e-5},
    "exudyn, axial force": {"penetration": 2e-3, "pull": 1e-6, "energy": 1e-4, "middle_slope": 1e-9, "law": 4e-5},
    "exudyn, explicit or ρ∞ > ½": {
        "penetration": 4e-3,
        "pull": 4e-3,
        "energy": 2e-3,
        "middle_slope": 1e-9,
        "law": 0.04,
    },
}
WIDER = {"shear": {"penetration": 0.05, "pull": 1e-4}, "segments": {"pull": 0.01, "law": 4e-4}}
LIMITS |= {
    f"{path}, {what}": {name: max(limit, wider.get(name, 0.0)) for name, limit in limits.items()}
    for what, wider in WIDER.items()
    for path, limits in LIMITS.items()
}
"""Four to a hundred times the worst of sixty sound default runs of a path, which ``make coverage`` prints
(``benchmarks.balances``); ``ELSEWHERE`` for others. Not meant for contact at velocity level, which drifts (penetration,
pull), and for the energy of other whole impacts. Means of generalised-α with ρ∞ > ½ swing about their force, explicit
steps close the energy to their own order alone and have forces within them: theirs are ten times the worst of
κ/ν = 0.25 and 1.5. An axial force works on the stretch of all of the beam: 3e-5 at N = 20 EI/ℓ². A beam that shears
is deeper in the wall: Hermite's contact is then at velocity level (0.014 under a load), Exudyn's penalty soft
(0.02 of a flat beam with a damping ratio of 5 %, and a pull of 1e-6); that limit is two and a half times the worst.
Chords of ``segment_friction`` open and close by forces within its contact_tolerance. Its limits are two and three times
the worst: ten runs pulled by 0.003 at most, ``law`` was 2e-4.
``law``: one step with which the solver keeps a wrong state of the contact may have 4e-3."""
IMPLICIT = ("GeneralizedAlpha", "Newmark", "Trapezoidal")
"""Integrators of Exudyn with the limits of "exudyn"; one that is not named has those of the explicit ones."""
ELSEWHERE = {"penetration": 1e-2, "pull": 0.1, "energy": 1e-2, "middle_slope": 1e-6, "law": 0.04}
OF_ALL = {"momentum": 3e-3, "second_moment": 5e-3, "points": 1e-8, "initial_energy": 1e-8}
"""Limits whatever the path: 16 elements a half beam leave 1e-3 of the impulse and its second moment, default runs 1e-5;
the others are round-off."""
SAYS = {
    "momentum": "momentum, impulse and loads do not balance: the residual is {percent:.2g} % of the impulse",
    "second_moment": "the impulses act elsewhere than the motion says: their second moment is off by {percent:.2g} %",
    "points": "the impulses of the contact points add up to the total and {percent:+.2g} % of it",
    "law": "the forces at the wall and the momentum do not agree: the impulse of the contact law is the total and "
    "{percent:+.2g} % of it",
    "initial_energy": "the initial kinetic energy is off by {percent:.2g} %: mass is missing",
    "penetration": "the beam is in the wall by {share:.2g} of how far it has fallen; sound runs stay below {limit:.2g}",
    "pull": "the wall pulls by {share:.2g} of its largest push; sound runs stay below {limit:.2g}",
    "energy": "{share:.2g} of the energy is not accounted for; sound runs stay below {limit:.2g}",
    "middle_slope": "the middle of a symmetric beam turns by {share:.2g} of its largest slope; sound runs stay below "
    "{limit:.2g}",
}


def limited_as(history: ImpactHistory) -> str:
    """The key of ``LIMITS`` for a run: its path or a kind of its runs, and what makes the limits wider."""
    path, contact, integrator = history.path, history.settings.get("contact"), history.settings.get("integrator")
    if path == "exudyn" and isinstance(integrator, dict):
        if integrator.get("kind") not in IMPLICIT or integrator.get("spectral_radius", 0.5) > 0.5:
            path = "exudyn, explicit or ρ∞ > ½"
        elif history.impact.axial_force:
            path = "exudyn, axial force"
    if isinstance(contact, dict) and contact.get("kind") == "SegmentFriction":
        return f"{path}, segments"
    return path if history.impact.shear_stiffness is None else f"{path}, shear"


def beyond_limits(path: str, checks: Any) -> list[str]:
    """A sentence for each of the ``checks``, attributes by the names of the limits, that exceeds its limit."""
    return [
        SAYS[name].format(share=share, percent=100.0 * share, limit=limit)
        for name, limit in (OF_ALL | LIMITS.get(path, ELSEWHERE)).items()
        if (share := getattr(checks, name)) is not None and abs(share) > limit
    ]
