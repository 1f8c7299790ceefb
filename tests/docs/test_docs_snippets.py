"""Every command and snippet of README and docs runs, the tutorial and examples in docstrings too; links lead somewhere.

A fence whose info line says "not run" (with the reason) or ``no-run`` is only read, "make verify" that it runs there.
TOML with a file's name as its title is a case, which is read and written to the folder for the commands below it.
"""

import doctest
import importlib
import pkgutil
import re
import shlex
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from fences import FENCE, blocks
from here import CASES, ROOT

from bent_beam import load_case
from comparison.command_line.app import run
from hermite_fe import HermiteFE

GENERATED = re.compile(r"(?:^|/)(?:settings|api/\w+)\.md")  # by docs/tools/generated.py
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
NOT_RUN = re.compile("not run|no-run")


def name_of(page: Path) -> str:
    return page.relative_to(ROOT).as_posix()


@pytest.fixture(autouse=True)
def registries() -> Iterator[None]:
    """As they were, afterwards: snippets may add to them."""
    kept = {name: dict(kinds) for name, kinds in HermiteFE.PARTS.items()}
    yield
    for name, kinds in kept.items():
        HermiteFE.PARTS[name].clear()
        HermiteFE.PARTS[name].update(kinds)


# two seconds and more of default runs, the commands and calls of README and of the tests of both paths, or of compiling
RUNS = ("docs/guide/run.md", "docs/guide/swap.md", "docs/guide/figure.md", "docs/guide/add-integrator.md")
QUICK = [pytest.param(page, False, id=name_of(page)) for page in PAGES if name_of(page) not in RUNS]
LONG = [page for page in PAGES if name_of(page) in RUNS or any(block.is_long for block in blocks(page))]
LONG = [pytest.param(page, True, marks=pytest.mark.verify, id=f"{name_of(page)}, all") for page in LONG]


@pytest.mark.parametrize(("page", "all_of_it"), [*QUICK, *LONG])
def test_commands_and_snippets_run(page, all_of_it, own_folder, capsys):
    """One after the other, the names of snippets shared. What stands in README too is run there."""
    (own_folder / "cases").symlink_to(CASES)
    space: dict[str, object] = {"__name__": "__docs__"}
    elsewhere = [] if page == PAGES[0] else [block.body for block in blocks(PAGES[0])]
    for block in blocks(page):
        assert block.language in ("bash", "python", "toml", "text", ""), block.language
        if (block.is_long and not all_of_it) or block.body in elsewhere:
            continue
        if block.language == "text" and "printed by" in block.options:  # by the block before
            hold_alike(capsys.readouterr().out, block.body)
        elif block.language == "toml" and (title := re.search(r'title="(\w+\.toml)"', block.options)):
            Path(title[1]).write_text(block.body, encoding="utf-8")
            load_case(title[1]).method("hermite")
        elif block.language == "python" and not NOT_RUN.search(block.options):
            exec(compile(block.body, name_of(page), "exec", dont_inherit=True), space)
        elif block.language == "bash" and not NOT_RUN.search(block.options):
            capsys.readouterr()
            for line in block.body.replace("\\\n", " ").splitlines():
                if words := shlex.split(line, comments=True):
                    run_command(words)


def run_command(words: list[str]) -> None:
    if words[0] == "make":
        makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
        assert all(re.search(rf"^{re.escape(target)}\s*:", makefile, re.M) for target in words[1:]), words
    else:
        assert words[0] == "bentbeam", f"only bentbeam and make can be run; say 'not run' and why in its title: {words}"
        assert run(words[1:]) == 0, words


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_links_between_pages_lead_somewhere(page: Path) -> None:
    for target in re.findall(r"\]\(([^)\s]+)\)", FENCE.sub("", page.read_text(encoding="utf-8"))):
        if not target.startswith(("http", "#", "mailto:")) and not GENERATED.search(target):
            assert (page.parent / target.partition("#")[0]).exists(), f"{name_of(page)}: {target}"


def hold_alike(today: str, stated: str) -> None:
    """The same words; numbers with bars within half of them, bars within a fifth and a rounding. Other numbers may
    change, with round-off and steps, and so may the width of columns."""
    words, words_then = (re.sub(r"[-+]?\d[\d.]*(?:e[-+]?\d+)?|─+", "#", text).split() for text in (today, stated))
    assert words == words_then
    for now, then in zip(*(re.findall(r"([-\d.]+) ± ([\d.]+)", text) for text in (today, stated)), strict=True):
        (value, bar), (known, wide) = map(float, now), map(float, then)
        assert abs(value - known) <= 0.5 * wide and max(bar, wide) <= 1.25 * min(bar, wide), (now, then)


def printed(cell: Any) -> str:
    streams = (output for output in cell.get("outputs", []) if output.output_type == "stream")
    return "".join(stream.text for stream in streams if stream.name == "stdout")


@pytest.mark.verify
def test_tutorial_runs() -> None:
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    notebook = nbformat.read(ROOT / "docs/tutorial.ipynb", as_version=4)
    nbformat.validate(notebook)
    stored = [printed(cell) for cell in notebook.cells]
    assert sum(map(bool, stored)) >= 5
    nbclient.execute(notebook, cwd=str(ROOT / "docs"), timeout=240, kernel_name="python3")
    for cell, known in zip(notebook.cells, stored):
        hold_alike(printed(cell), known)


def test_the_files_that_hold_the_facts_exist() -> None:
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    for line in text[text.index("## Facts that the tests hold") : text.index("## Habits")].splitlines():
        room = ""
        for name in re.findall(r"`([\w/]+\.py)`", line.rpartition(" | ")[2]):
            room = name.rpartition("/")[0] or room
            assert (ROOT / "tests" / room / name.rpartition("/")[2]).is_file(), line


ROOMS = ("bent_beam", "theory", "hermite_fe", "self_similar_fe", "exudyn_models", "comparison", "bent_beam_programs")
LONG_EXAMPLE = "hermite_fe.method.HermiteFE"
SHOWN = {
    "bent_beam.cases.load_case", "bent_beam.history.ImpactHistory", "bent_beam.impact.Impact",
    "bent_beam.measure.estimators.leading_order", "comparison.matching.match", LONG_EXAMPLE,
    "self_similar_fe.method.SelfSimilarFE", "theory.contact.contact_parameters", "theory.prediction.predict",
    "theory.similarity.peak_moment",
}  # fmt: skip
"""What people start with."""


@pytest.mark.parametrize("long", [False, pytest.param(True, marks=pytest.mark.verify)])
def test_examples_in_docstrings_give_what_they_show(long: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    rooms = [importlib.import_module(room) for room in ROOMS]
    names = [one.name for room in rooms for one in pkgutil.walk_packages(room.__path__, f"{room.__name__}.")]
    finder, runner = doctest.DocTestFinder(), doctest.DocTestRunner()
    found = [test for name in names for test in finder.find(importlib.import_module(name)) if test.examples]
    assert {test.name for test in found} >= SHOWN
    for test in found:
        if (test.name == LONG_EXAMPLE) == long:
            assert runner.run(test).failed == 0, test.name
