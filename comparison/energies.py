"""The energies of a run at its end, and what they say of it: one account for every door."""

from __future__ import annotations

from collections.abc import Mapping

from bent_beam.history import LOSSES, ImpactHistory

__all__ = ["energy_at_end", "energy_residual", "loss_warnings", "numerical_loss"]

Energies = Mapping[str, float | None]
NOTABLE_LOSS = 0.02  # of the initial energy


def energy_at_end(history: ImpactHistory) -> dict[str, float | None]:
    """The energies at the end, J, what was lost on the way, by cause, and the defect: what these do not explain."""
    budget = history.energy_budget()
    names = ("work_of_loads", *LOSSES)
    return {
        "initial": budget["initial_energy"],
        "kinetic": float(history.array("kinetic_energy")[-1]),
        "strain": float(history.array("strain_energy")[-1]),
        "wall": budget.get("contact_energy"),
        **{name: budget.get(name) for name in names},
        "defect": budget["defect"],
    }


def numerical_loss(energy: Energies) -> float:
    """Share of the initial energy that the scheme, the mesh and its viscosity took: what is booked for them, and what
    is missing without being booked at all."""
    booked = sum(energy[name] or 0.0 for name in ("loss_algorithmic", "loss_viscous"))
    return (booked + max(-(energy["defect"] or 0.0), 0.0)) / (energy["initial"] or 1.0)


def energy_residual(energy: Energies) -> float:
    """What the terms of the budget leave, over the initial energy and the work of the loads."""
    return abs(energy["defect"] or 0.0) / ((energy["initial"] or 1.0) + abs(energy["work_of_loads"] or 0.0))


def loss_warnings(share: float) -> list[str]:
    """A warning where :func:`numerical_loss` is notable."""
    if share < NOTABLE_LOSS:
        return []
    return [f"steps, mesh and grid viscosity took {100.0 * share:.2g} % of the initial energy"]
