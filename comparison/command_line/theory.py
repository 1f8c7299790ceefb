"""``bentbeam theory``, and ``match``, which holds methods against it."""

from pathlib import Path
from typing import Annotated

import typer

from comparison.command_line import options
from comparison.command_line.options import emit, end_of_rows, factors, folder_for, numbers, of_path, progress


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
        document |= {"peak_force": force.value, "peak_force_error": force.error, "peak_force_time": force.time}
        document["zone_offset"] = zone_offset(kappa_over_nu)
    width = max(14, *map(len, document))
    emit(document, as_json, lambda: "\n".join(f"{n:>{width}} = {value}" for n, value in document.items()))


def match(
    path: Annotated[
        list[str] | None,
        of_path("hermite, self_similar, exudyn or an installed one; repeatable. Default: hermite and exudyn."),
    ] = None,
    assignments: options.Set = None,
    methods: options.Methods = None,
    kappa_over_nu: Annotated[
        list[float] | None, typer.Option(help="κ/ν; repeatable. Default: the thesis's Table 3.4.")
    ] = None,
    first_order: Annotated[
        list[str] | None,
        typer.Option(
            metavar="A,P,C[,N]",
            help="α,ψ,χ[,N] of a first-order match (α = free: −κN, a stress-free bow in free flight); repeatable.",
        ),
    ] = None,
    wall: Annotated[
        str | None,
        typer.Option(metavar="K[,ZETA]", help="Elastic wall: stiffness per length over μ/t*², and damping ratio."),
    ] = None,
    refine: options.Refine = "1",
    error_bars: options.ErrorBars = "quick",
    duration: Annotated[float, typer.Option(help="End of the runs, t*.")] = 0.1,
    limit: Annotated[float | None, typer.Option(help="Time limit of a row, s.")] = None,
    jobs: options.ManyJobs = None,
    scheduler: options.Scheduler = None,
    out: Annotated[Path | None, folder_for("the table and the plots")] = None,
    fresh: options.Fresh = False,
    as_json: options.Json = False,
    quiet: options.Quiet = False,
) -> None:
    """Match simulations with the theory: λ₀, r₀, λ₁, r₁.

    Example: bentbeam match --path hermite --set hermite.integrator.kind=moreau_jean --kappa-over-nu 0.5 --refine 1,2
    """
    from comparison.matching import match as match_all
    from comparison.methods import chosen_methods
    from comparison.rows import THESIS_KAPPAS, questions
    from comparison.store import RunStore, check_writable

    compared = chosen_methods(path or (), assignments or (), methods or ())
    loads = [_load(text) for text in first_order or ()]
    kappas = kappa_over_nu or THESIS_KAPPAS
    asked = questions(compared, kappas, loads, factors(refine), error_bars, duration, _wall(wall))
    check_writable(out, folder=True)
    with progress(f"{len(asked)} rows", quiet) as bar:
        store, told = RunStore.usual(fresh), bar.count
        rows = match_all(asked, store=store, jobs=jobs, scheduler=scheduler, limit=limit, progress=told)

    def write(folder: Path) -> None:
        from comparison.figures.matching import write_match

        write_match(rows, folder)

    options.emit_with_files(rows.to_dict(), as_json, lambda: str(rows), out, write)
    end_of_rows(rows)


def _wall(text: str | None) -> tuple[float, float] | None:
    """(stiffness, damping ratio) of ``--wall``."""
    if text is None:
        return None
    stiffness, *ratio = numbers("--wall", text, (1, 2), "stiffness[,damping ratio]")
    return stiffness, ratio[0] if ratio else 0.0


def _load(text: str) -> tuple[float | None, ...]:
    """(α, ψ, χ[, N]) of ``--first-order``; α = ``None`` where it says ``free``."""
    word, _, others = text.partition(",")
    if word.strip() == "free":
        return (None, *numbers("--first-order", others, (3,), "after free: psi,chi,N"))
    return numbers("--first-order", text, (3, 4), "alpha,psi,chi[,N] or free,psi,chi,N")
