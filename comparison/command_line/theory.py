"""``bentbeam theory``."""

from __future__ import annotations

from typing import Annotated

import typer

from comparison.command_line import options
from comparison.command_line.options import emit

__all__ = ["theory"]


def theory(
    kappa_over_nu: Annotated[float, typer.Option(help="κ/ν = K √(EI/μ)/V₀.")],
    alpha: Annotated[float, typer.Option(help="First-order acceleration α of the free motion, ν = 1.")] = 0.0,
    psi: Annotated[float, typer.Option(help="First-order fourth derivative ψ.")] = 0.0,
    chi: Annotated[float, typer.Option(help="First-order rate of curvature χ.")] = 0.0,
    axial: Annotated[float, typer.Option(help="First-order axial force N, tension positive.")] = 0.0,
    wall_damping: Annotated[
        float | None, typer.Option(help="Damping ratio ζ = c/(2√(kμ)) of an elastic wall; adds the largest force.")
    ] = None,
    as_json: options.Json = False,
) -> None:
    """Print λ₀, r₀, λ₁, r₁ and the largest moment of theory.

    With --wall-damping also the largest force on an elastic wall, in V₀√μ(EI k)^{1/4}, its time in √(μ/k), and the
    zone's offset in (EI/k)^{1/4}; k is the wall's stiffness per length.

    Example: bentbeam theory --kappa-over-nu 0.5 --wall-damping 0.1
    """
    from theory.contact import contact_parameters
    from theory.similarity import peak_moment

    found = contact_parameters(kappa_over_nu, alpha, psi, chi, axial=axial)
    names = ("kappa_over_nu", "alpha", "psi", "chi", "axial", "regime", "lambda0", "r0", "lambda1", "r1")
    document = {n: getattr(found, n) for n in (*names, "lambda_axial", "r_axial")}
    document["peak_moment"] = peak_moment(kappa_over_nu).largest
    if wall_damping is not None:
        from theory.elastic_wall import peak_force
        from theory.wall_prediction import zone_offset

        force = peak_force(kappa_over_nu, wall_damping)
        document |= {
            "peak_force": force.value,
            "peak_force_error": force.error,
            "peak_force_time": force.time,
            "zone_offset": zone_offset(kappa_over_nu),
        }
    width = max(14, *map(len, document))
    emit(document, as_json, lambda: "\n".join(f"{n:>{width}} = {value}" for n, value in document.items()))
