"""``bentbeam study``."""

from pathlib import Path
from typing import Annotated

import typer

from comparison.command_line import options

study_names = options.names_of("bent_beam_programs.thesis.studies:STUDIES", "list")


def study(
    context: typer.Context,
    name: Annotated[
        str, typer.Argument(help="Name of the study (`bentbeam study list` shows them).", autocompletion=study_names)
    ],
    case: Annotated[Path | None, typer.Argument(metavar="CASE.toml", help="Case file.")] = None,
    path: Annotated[
        list[str] | None,
        options.of_path(
            "hermite, self_similar, exudyn or an installed one; repeatable. Without any of --path, --methods, --refine "
            "and --set of a path: the thesis's settings."
        ),
    ] = None,
    assignments: options.Set = None,
    methods: options.Methods = None,
    refine: options.Refine = None,
    out: Annotated[Path | None, options.folder_for("figure, table and conclusion")] = None,
    jobs: options.Jobs = 1,
    as_json: options.Json = False,
    quiet: options.Quiet = False,
) -> None:
    """Vary one numerical parameter and tabulate its effect.

    With the thesis's settings, or with those of any methods (--path, --methods, --refine), each of which it varies.

    Example: bentbeam study mesh cases/thesis_K10.toml --path exudyn --refine 1,2 --out out/mesh
    """
    from bent_beam.cases import load_case
    from bent_beam.errors import InputError, nearest
    from bent_beam.method import paths
    from bent_beam_programs.thesis.studies import STUDIES, run_study
    from comparison.methods import check_effect, chosen_methods
    from comparison.store import check_writable

    if name == "list":
        if options.stated(context, "case", "path", "assignments", "methods", "refine", "out", "jobs", "quiet"):
            raise InputError("study list takes --json alone")
        titles = [{"name": n, "title": s.title} for n, s in STUDIES.items()]
        options.emit(titles, as_json, lambda: "\n".join(f"{one['name']:>16}  {one['title']}" for one in titles))
        return
    if name not in STUDIES:
        raise InputError(f"study {name!r} is not known{nearest(name, STUDIES)}")
    if case is None:
        raise InputError("a case file is required: bentbeam study NAME CASE.toml")
    of_paths = [one for one in assignments or () if one.partition("=")[0].partition(".")[0].strip() in paths()]
    loaded = load_case(case, assignments or ())
    asked = path or of_paths or methods or refine is not None
    if not asked:
        check_effect(assignments or (), paths(), {"mesh": "the thesis's settings have their own"}, "--set")
    varied = chosen_methods(path or (), of_paths, methods or (), loaded) if asked else []
    refines = options.factors(refine)
    if out is not None:
        check_writable(out, folder=True)
    with options.progress(f"study {name}", quiet) as bar:
        found = run_study(name, loaded, methods=varied, refines=refines, out=out, jobs=jobs, progress=bar.count)
    options.emit(found.to_dict(), as_json, found.text)
    if found.problem:
        raise InputError(found.problem)
