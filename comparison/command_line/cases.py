"""The commands on case files: ``bentbeam new``, ``settings``, ``predict``, ``simulate``."""

from itertools import chain, count
from pathlib import Path
from typing import Annotated

import typer

from bent_beam.errors import InputError, SimulationError
from comparison.command_line import options
from comparison.command_line.options import check_out, emit, folder_for, names_of, of_path, progress

section_kinds = names_of("bent_beam.section:SECTIONS")
example_names = names_of("bent_beam.new_case:examples")


def new(
    out: Annotated[Path, typer.Argument(metavar="FILE.toml", help="Where to write the case.")] = Path("my_beam.toml"),
    section: Annotated[
        str | None, typer.Option(help="pipe (default), round_bar, rectangle or general.", autocompletion=section_kinds)
    ] = None,
    like: Annotated[
        str | None, typer.Option(help="An example to start from: tube, rail, …", autocompletion=example_names)
    ] = None,
    damping_ratio: Annotated[
        float | None, typer.Option(min=0.0, help="Of the first bending mode; otherwise state it in the file.")
    ] = None,
    overwrite: options.Overwrite = False,
    as_json: options.Json = False,
) -> None:
    """Write a commented case file for a beam of your own.

    Example: bentbeam new my_tube.toml --like tube
    """
    from bent_beam.files import write_atomically
    from bent_beam.new_case import example, new_case

    if like is not None and not (section is None and damping_ratio is None):
        raise InputError(
            f"--like {like}: the example states its section and whether it is damped: change that in {out}"
        )
    text = new_case(section or "pipe", damping_ratio) if like is None else example(like)
    check_out(out, overwrite)
    write_atomically(out, text)
    made = {"section": section or "pipe"} if like is None else {"like": like}
    hint = f"{out}: change every number or delete its line, then bentbeam predict {out}"
    emit({"file": str(out)} | made, as_json, lambda: hint)


def settings(
    word: Annotated[str, typer.Argument(help="Only those with this in table, name or text.")] = "",
    markdown: Annotated[bool, typer.Option("--markdown", help="As the page of the documentation.")] = False,
    as_json: options.Json = False,
) -> None:
    """List the settings of a case file with unit, default and range.

    Example: bentbeam settings damping
    """
    from bent_beam.settings import about
    from comparison.settings_text import settings_markdown, settings_text

    if markdown and (word or as_json):
        raise InputError(f"--markdown writes the whole page: leave {word or '--json'!r} out")
    emit(about(word), as_json, settings_markdown if markdown else lambda: settings_text(word))


def predict(
    case: options.CaseFile,
    time: Annotated[
        list[float] | None, typer.Option(help="Time after first contact, s, in place of end_time; repeatable.")
    ] = None,
    theory_only: Annotated[bool, typer.Option("--theory-only", help="Closed forms only, without simulation.")] = False,
    assignments: options.Set = None,
    out: Annotated[Path | None, folder_for("document and picture")] = None,
    fresh: options.Fresh = False,
    as_json: options.Json = False,
    quiet: options.Quiet = False,
) -> None:
    """Predict contact and stress: theory beside a simulation.

    Prints contact, force, impulse, moment, stress and rebound. For plates, stops and supports: simulate.

    Example: bentbeam predict cases/drill_pipe.toml --time 0.005 --time 0.01
    """
    from bent_beam.cases import load_case
    from comparison.methods import check_effect
    from comparison.store import RunStore, check_writable

    loaded = load_case(case, assignments or ())
    if loaded.tables or loaded.mesh is not None:  # looked at also where nothing is simulated
        loaded.method("hermite")
    times = time or [loaded.end_time]
    simulates = not theory_only and max(times) > 0.0
    unused = {"run": "--time says when"} if time else {}
    unused |= {} if simulates else {"mesh": "nothing is simulated"}
    check_effect(assignments or (), ["hermite"] if simulates else [], unused, "--set")
    for one in times:
        try:
            loaded.impact.checked_time("time", one)
        except ValueError as error:
            raise InputError(f"--time: {error}") from None
    if out is not None and not simulates:
        raise InputError(f"--out {out}: nothing is simulated, so that there is nothing to be drawn")
    if fresh and not simulates:
        raise InputError("--fresh has no effect: nothing is simulated")
    check_writable(out, folder=True)
    from comparison.predicting import predict_case  # SciPy: no refusal above waits for it

    with progress(f"the whole beam: {case.name}", quiet or as_json or theory_only) as bar:
        found = predict_case(loaded, times, theory_only=theory_only, store=RunStore.usual(fresh), progress=bar.fraction)
    options.emit_with_files(found.to_dict(), as_json, lambda: str(found), out, found.write)


def simulate(
    case: options.CaseFile,
    path: Annotated[str, of_path("hermite, self_similar, exudyn or an installed one.")] = "hermite",
    assignments: options.Set = None,
    until: Annotated[
        str | None, typer.Option(help='"separation": until the beam has left the wall; overrides [run].')
    ] = None,
    error_bars: options.ErrorBars = "quick",
    out: Annotated[Path | None, typer.Option(metavar="FILE.nc", help="Keep the history as netCDF.")] = None,
    overwrite: options.Overwrite = False,
    save: Annotated[
        int | None, typer.Option(min=8, max=20000, help="Saved instants; until separation, a T*. Default: 200; 2000.")
    ] = None,
    verbose: options.Verbose = False,
    as_json: options.Json = False,
    quiet: options.Quiet = False,
) -> None:
    """Simulate one case with one method.

    Example: bentbeam simulate cases/thesis_K10.toml --path exudyn --set exudyn.integrator.kind=newmark
    """
    from bent_beam.cases import load_case
    from comparison.methods import check_effect

    loaded = load_case(case, assignments or ())
    loaded.method(path)
    if until not in (None, "separation"):
        raise InputError(f'--until takes "separation" (got {until!r}); an end time is run.end_time')
    unused = {} if until is None else {"run": "--until separation says how long"}
    check_effect(assignments or (), [path], unused, "--set")
    check_out(out, overwrite, ".nc")
    from comparison.simulating import simulate_case  # SciPy: no refusal above waits for it
    from comparison.texts import run_text

    end = loaded.end_time if until is None else None
    try:
        with progress(f"{path}: {case.name}", quiet) as bar:
            found = simulate_case(loaded, path, until=end, save=save, error_bars=error_bars, progress=bar.fraction)
    except SimulationError as error:
        raise _kept(error, out) from None
    problem = None
    if out is not None:
        try:
            found.history.described(loaded.title, loaded.section).save(out)
        except OSError as error:  # the run's answer is worth more than its file
            problem, out = f"--out: {out} could not be written: {error.strerror or error}", None
    document = found.to_dict(out)
    emit(document, as_json, lambda: run_text(document, verbose))
    if problem:
        raise InputError(problem)


def _kept(error: SimulationError, out: Path | None) -> SimulationError:
    """The same error, saying where the partial history was kept."""
    if error.history is None:
        return error
    place, name = (Path(), "partial") if out is None else (out.parent, f"{out.stem}.partial")
    names = chain([name], (f"{name}-{number}" for number in count(2)))
    target = next(file for file in (place / f"{one}.nc" for one in names) if not file.exists())
    where = f"is in {target}"
    try:
        error.history.save(target)
    except OSError as problem:
        where = f"could not be kept in {target} ({problem.strerror})"
    error.args = (f"{error.args[0]}; the partial history {where}",)
    return error
