"""The report's page, written once for all that look at it, its browser too."""

from types import SimpleNamespace

import pytest
from matplotlib.figure import Figure
from report_fixtures import impacts, lost, pipe, rows, studies

from bent_beam_programs.report import page
from bent_beam_programs.report.rows import PATHS, report_questions
from bent_beam_programs.report.studies import stored_studies
from comparison.figures import style
from comparison.methods import methods_of
from comparison.store import RunStore


@pytest.fixture(scope="session")
def written(tmp_path_factory: pytest.TempPathFactory) -> SimpleNamespace:
    """Of made-up rows, one of which failed, real impacts on coarse meshes, and all that is stored.

    ``found`` is what the writer returned, ``seen`` its progress, ``nasty`` the text that came from files and methods.
    """
    nasty = "<script>alert('x')</script> & \"quotes\" </script>"
    folder, every = tmp_path_factory.mktemp("report"), [*rows(), lost("exudyn", 0.3, nasty)]
    seen: list[tuple[int, int]] = []
    every[0].warnings.append(nasty)
    stored = [*stored_studies(), *stored_studies(studies(folder, nasty))]
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(style.RC, "figure.constrained_layout.use", False)  # layouts take longer than the page
        patch.setattr(Figure, "draw_without_rendering", lambda figure: None)
        patch.setattr(page, "match", lambda asked, *, progress, **_: progress(1, len(asked)) or every)
        patch.setattr(page, "warm_up", lambda methods: None)
        patch.setattr(page, "show_all", lambda *_, **__: (list(impacts()), [nasty]))
        patch.setattr(page, "pipe_prediction", lambda store: pipe())
        patch.setattr(page, "stored_studies", lambda: stored)
        methods = methods_of(PATHS)
        asked, store = report_questions(methods, (0.5, 1.0)), RunStore(None)
        found = page.write_report(folder, methods, asked, store=store, progress=lambda *of: seen.append(of))
    file = folder / "index.html"
    text = file.read_text()
    return SimpleNamespace(found=found, seen=seen, file=file, text=text, nasty=nasty, studies=stored, asked=asked)
