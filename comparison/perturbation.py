"""The loads of the runs from which first order is read off, and how large they may be."""

from __future__ import annotations

import math

from bent_beam.checks import between
from bent_beam.impact import Impact
from comparison.rows import First
from measure.estimators import LeadingEstimate

__all__ = ["first_order_epsilon", "loaded"]

EXTREME = 1e30  # of ε: its powers are calculated with


def first_order_epsilon(leading: LeadingEstimate, first: First, perturbation: float, duration: float) -> float:
    """The largest ε of the runs: the loads change the free motion by a small part of V₀t over the contact zone.

    ε τ (|α|/2 + |χ|z²/2 + |ψ|z⁴/24 + |N|/2) = ``perturbation`` at the end, z being the zone measured at ε = 0 and half
    the front's thickness. ε is reduced for a front near the centre, which would move too far.
    """
    front = leading.front
    z = front + 1.0 / math.sqrt(1.0 + front**2)
    alpha, psi, chi, axial = (abs(v) for v in first)
    part = perturbation
    if front > 0.0:
        part *= front / (front + 0.2)
    top = part / (duration * (alpha / 2 + chi * z**2 / 2 + psi * z**4 / 24 + axial / 2))
    return between("first_order: the largest ε of the runs, from alpha, psi, chi and N,", top, 1 / EXTREME, EXTREME)


def loaded(bare: Impact, epsilon: float, first: First) -> Impact:
    """``bare`` with (εα, εψ, εχ, n) = ε·(α, ψ, χ, N)."""
    alpha, psi, chi, axial = (epsilon * value for value in first)
    return bare.replace(acceleration=alpha, fourth_derivative=psi, curvature_rate=chi, axial_force=axial)
