"""The ``bentbeam`` command: a thin door to the packages. ``--json`` prints one JSON document on standard output, no
more.

Exit codes: 0 done; 2 bad input (one line naming field and value); 3 a solver could not finish; 130 interrupted.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from typer._click.exceptions import ClickException

from bent_beam.cases import load_case
from bent_beam.history import ImpactHistory, SimulationError
from bent_beam.parts import InputError
from comparison.command_line.console import Console
from comparison.store import check_writable

__all__ = ["app", "main"]

app = typer.Typer(
    help="A naturally bent beam hits a rigid wall: theory, two simulations, and how well they agree.",
    no_args_is_help=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    context_settings={"max_content_width": 110},
)

Json = Annotated[bool, typer.Option("--json", help="Print one JSON document on standard output and nothing else.")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="No progress on standard error.")]
CaseFile = Annotated[Path, typer.Argument(metavar="CASE.toml", help="Case file (see cases/).")]
Jobs = Annotated[int, typer.Option("--jobs", "-j", min=1, help="Processes on this machine.")]
Scheduler = Annotated[
    str | None, typer.Option(help="Address of a dask.distributed scheduler, e.g. tcp://127.0.0.1:8786.")
]
Set = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="TABLE.KEY=VALUE", help="Lay a setting over the case file; repeatable."),
]
Overwrite = Annotated[bool, typer.Option("--overwrite", help="Replace what is there.")]


def _emit(document: Any, as_json: bool, text: Callable[[], str]) -> None:
    if as_json:
        print(json.dumps(document, allow_nan=False))
    else:
        print(text())


@app.command()
def theory(
    kappa_over_nu: Annotated[float, typer.Option(help="κ/ν = K √(EI/μ)/V₀, the one parameter of the leading order.")],
    alpha: Annotated[float, typer.Option(help="First-order acceleration α, ν = 1.")] = 0.0,
    psi: Annotated[float, typer.Option(help="First-order fourth derivative ψ.")] = 0.0,
    chi: Annotated[float, typer.Option(help="First-order rate of curvature χ.")] = 0.0,
    as_json: Json = False,
) -> None:
    """λ₀, r₀, λ₁, r₁ of the semi-analytic theory.

    Example: bentbeam theory --kappa-over-nu 0.5 --alpha 4
    """
    from theory import contact_parameters

    found = contact_parameters(kappa_over_nu, alpha, psi, chi)
    names = ("kappa_over_nu", "alpha", "psi", "chi", "regime", "lambda0", "r0", "lambda1", "r1")
    document = {n: str(found.regime) if n == "regime" else float(getattr(found, n)) for n in names}
    _emit(document, as_json, lambda: "\n".join(f"{n:>14} = {document[n]}" for n in names))


@app.command()
def predict(
    case: CaseFile,
    time: Annotated[list[float] | None, typer.Option(help="Time after first contact, s; repeatable.")] = None,
    assignments: Set = None,
    as_json: Json = False,
) -> None:
    """Contact length, reaction and impulse in SI units, and whether the theory holds there.

    Example: bentbeam predict cases/drill_pipe.toml --time 0.005 --time 0.01
    """
    from comparison.validity import add_measured_errors
    from theory import predict as predict_impact

    loaded = load_case(case, assignments or ())
    prediction = predict_impact(loaded.impact, time or [loaded.end_time])
    document = prediction.to_dict()
    notes = add_measured_errors(document)
    _emit(document, as_json, lambda: "\n".join([prediction.summary(), *notes]))


@app.command()
def simulate(
    case: CaseFile,
    path: Annotated[str, typer.Option(help="hermite or exudyn.")] = "hermite",
    assignments: Set = None,
    out: Annotated[Path | None, typer.Option(metavar="FILE.nc", help="Keep the history as netCDF.")] = None,
    overwrite: Overwrite = False,
    save: Annotated[int, typer.Option(min=8, max=20000, help="Number of saved instants.")] = 200,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Simulate one case on one path.

    Example: bentbeam simulate cases/thesis_K10.toml --path exudyn --set exudyn.integrator.kind=newmark
    """
    from comparison.runs import simulate_case, summary
    from comparison.tables import run_table

    loaded = load_case(case, assignments or ())
    _check_out(out, overwrite)
    console = Console(quiet)
    try:
        with console.progress(f"{path}: {case.name}") as bar:
            history = simulate_case(loaded, path, save=save, progress=bar.fraction)
    except SimulationError as error:
        raise _kept(error, out) from None
    problem = None
    if out is not None:
        try:
            history.save(out)
        except OSError as error:  # the run's answer is worth more than its file
            problem, out = f"out: {out} could not be written: {error.strerror or error}", None
    found = summary(history, out)
    _emit(found, as_json, lambda: run_table(found))
    if problem:
        raise InputError(problem)


@app.command()
def rerun(
    file: Annotated[Path, typer.Argument(metavar="FILE.nc", help="A history written by simulate --out.")],
    out: Annotated[Path | None, typer.Option(metavar="FILE.nc", help="Keep the new history.")] = None,
    overwrite: Overwrite = False,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Run a stored history's case again with its settings, and say whether it came out the same.

    Example: bentbeam rerun out/K10.nc
    """
    from comparison.rerun import rerun_history

    if not file.exists():
        raise InputError(f"history {file}: no such file")
    _check_out(out, overwrite)
    with Console(quiet).progress(f"again: {file.name}") as bar:
        found = rerun_history(ImpactHistory.load(file), out, bar.fraction)
    _emit(found, as_json, lambda: "\n".join(f"{k}: {v}" for k, v in found.items()))


def _check_out(out: Path | None, overwrite: bool) -> None:
    if out is None:
        return
    if out.exists() and not overwrite:
        raise InputError(f"out: {out} exists already (give another name, or --overwrite)")
    check_writable(out, folder=False)


def _first_order(values: Sequence[str]) -> list[tuple[float, float, float]]:
    found = []
    for value in values:
        try:
            alpha, psi, chi = (float(v) for v in value.split(","))
        except ValueError:
            raise InputError(f"--first-order takes alpha,psi,chi (got {value!r})") from None
        found.append((alpha, psi, chi))
    return found


@app.command()
def match(
    path: Annotated[list[str], typer.Option(help="hermite or exudyn; repeatable.")] = ["hermite", "exudyn"],  # noqa: B006
    kappa_over_nu: Annotated[
        list[float] | None, typer.Option(help="κ/ν; repeatable. Default: the thesis's Table 3.4.")
    ] = None,
    first_order: Annotated[
        list[str] | None, typer.Option(metavar="A,P,C", help="α,ψ,χ of a first-order match; repeatable.")
    ] = None,
    jobs: Jobs = 1,
    scheduler: Scheduler = None,
    out: Annotated[Path | None, typer.Option(help="Folder for the table and the matching plots.")] = None,
    fresh: Annotated[bool, typer.Option("--fresh", help="Do not use runs kept from before.")] = False,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Simulate on both paths and hold λ₀, r₀ (and λ₁, r₁) against the theory.

    Example: bentbeam match --kappa-over-nu 0.5 --first-order 4,0,0
    """
    from comparison.matching import THESIS_KAPPAS, questions
    from comparison.matching import match as match_all
    from comparison.store import RunStore, default_store
    from comparison.tables import match_document, match_table, write_match

    asked = questions(path, kappa_over_nu or THESIS_KAPPAS, _first_order(first_order or ()))
    store = RunStore(None if fresh else default_store())
    if out is not None:
        check_writable(out, folder=True)
    with Console(quiet).progress(f"{len(asked)} rows") as bar:
        rows, failures = match_all(asked, store=store, jobs=jobs, scheduler=scheduler, progress=bar.count)
    document = match_document(rows, failures)
    if out is not None:
        write_match(rows, failures, out)
    _emit(document, as_json, lambda: match_table(rows, failures))
    if failures:
        for f in failures:
            print(f"error: {f.reason}; to ask again: {f.rerun}", file=sys.stderr)
        raise typer.Exit(3)


@app.command()
def study(
    name: Annotated[str, typer.Argument(help="Name of the study (bentbeam study list CASE shows them).")],
    case: Annotated[Path | None, typer.Argument(metavar="CASE.toml", help="Case file.")] = None,
    assignments: Set = None,
    out: Annotated[Path | None, typer.Option(help="Folder for figure, table and conclusion.")] = None,
    jobs: Jobs = 1,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """What a numerical parameter does to geometry, contact length, reaction and energy.

    Example: bentbeam study mesh cases/thesis_K10.toml --out out/mesh
    """
    from comparison.studies import STUDIES, run_study

    if name == "list":
        _emit(
            [{"name": n, "title": s.title} for n, s in STUDIES.items()],
            as_json,
            lambda: "\n".join(f"{n:>16}  {s.title}" for n, s in STUDIES.items()),
        )
        return
    if name not in STUDIES:
        from bent_beam.parts import nearest

        raise InputError(f"study {name!r} is not known{nearest(name, STUDIES)}")
    if case is None:
        raise InputError("a case file is required: bentbeam study NAME CASE.toml")
    loaded = load_case(case, assignments or ())
    if out is not None:
        check_writable(out, folder=True)
    with Console(quiet).progress(f"study {name}") as bar:
        found = run_study(name, loaded, out=out, jobs=jobs, progress=bar.count)
    _emit(found.to_dict(), as_json, found.text)


@app.command()
def gallery(
    ids: Annotated[
        list[str] | None, typer.Argument(help='Figures and tables by number, e.g. "fig-3.29". Default: all.')
    ] = None,
    list_only: Annotated[bool, typer.Option("--list", help="List what there is.")] = False,
    out: Annotated[Path, typer.Option(help="Folder to write into.")] = Path("gallery"),
    format: Annotated[list[str], typer.Option(help="png, pdf or svg; repeatable.")] = ["png"],  # noqa: B006
    jobs: Jobs = 1,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Every figure and table of the thesis, regenerated, each with its data as CSV.

    Example: bentbeam gallery fig-2.7a fig-3.29 --out out/gallery
    """
    from comparison.gallery import ITEMS, draw_all, listing

    if list_only:
        entries = listing()
        _emit(entries, as_json, lambda: "\n".join(f"{e['id']:>10}  {e['title']}" for e in entries))
        return
    from bent_beam.parts import nearest

    for wanted in ids or ():
        if wanted not in ITEMS:
            raise InputError(f"gallery {wanted!r} is not known{nearest(wanted, ITEMS)}")
    check_writable(out, folder=True)
    with Console(quiet).progress("gallery") as bar:
        drawn, failures = draw_all(ids or list(ITEMS), out, formats=format, jobs=jobs, progress=bar.count)
    _emit(
        {"drawn": drawn, "failures": failures},
        as_json,
        lambda: "\n".join(f"{d['id']:>10}  {d['files'][0]}" for d in drawn),
    )
    if failures:
        for f in failures:
            print(f"error: {f['id']}: {f['reason']}", file=sys.stderr)
        raise typer.Exit(3)


@app.command()
def report(
    out: Annotated[Path, typer.Option(help="Folder to write into.")] = Path("report"),
    jobs: Annotated[int, typer.Option("--jobs", "-j", min=1, help="Processes on this machine.")] = max(
        1, os.cpu_count() or 1
    ),
    scheduler: Scheduler = None,
    fresh: Annotated[bool, typer.Option("--fresh", help="Do not use runs kept from before.")] = False,
    overwrite: Overwrite = False,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """The main job: match both paths with the theory and write one HTML page about it.

    Example: bentbeam report --out report
    """
    from comparison.report.page import write_report
    from comparison.store import RunStore, default_store

    page = out / "index.html"
    if page.exists() and not overwrite:
        raise InputError(f"out: {page} exists already (give another folder, or --overwrite)")
    check_writable(out, folder=True)
    store = RunStore(None if fresh else default_store())
    with Console(quiet).progress("report") as bar:
        found = write_report(out, store=store, jobs=jobs, scheduler=scheduler, progress=bar.count)
    _emit(found, as_json, lambda: f"{found['headline']}\nReport: {page}")
    if found["failures"]:
        raise typer.Exit(3)


def _kept(error: SimulationError, out: Path | None) -> SimulationError:
    """The same error, saying where the partial history was kept."""
    if error.history is None:
        return error
    target = Path("partial.nc") if out is None else out.with_name(out.stem + ".partial.nc")
    number = 1
    while target.exists():
        number += 1
        target = target.with_name(f"{target.name.split('.')[0]}.partial-{number}.nc")
    try:
        error.history.save(target)
    except OSError as problem:
        error.args = (f"{error.args[0]}; the partial history could not be kept in {target} ({problem.strerror})",)
    else:
        error.args = (f"{error.args[0]}; the partial history is in {target}",)
    return error


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command and leave with its exit code."""
    code = run(arguments)
    try:
        sys.stdout.flush()
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # what is left in the buffer has nowhere to go
        if not isinstance(error, BrokenPipeError):
            code = _refuse(f"standard output cannot be written: {error.strerror}", 2)
    sys.exit(code)


def run(arguments: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code, prints one line on standard error when it is not 0."""
    np.seterr(all="ignore")  # every result is checked to be finite; NumPy's remarks on the way are not for users
    try:
        code = app(args=None if arguments is None else list(arguments), prog_name="bentbeam", standalone_mode=False)
        return int(code or 0)
    except ClickException as error:
        return _refuse(error.format_message(), 2)
    except SimulationError as error:
        return _refuse(str(error), 3)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        return 0
    except (ValueError, OSError) as error:  # InputError among them
        return _refuse(str(error), 2)
    except MemoryError:
        return _refuse("not enough memory; fewer nodes, steps or saved instants need less", 3)
    except (KeyboardInterrupt, typer.Abort):
        return _refuse("interrupted; what was finished is kept and will not be computed again", 130)


def _refuse(message: str, code: int) -> int:
    print("error: " + " ".join(message.split()), file=sys.stderr)
    return code
