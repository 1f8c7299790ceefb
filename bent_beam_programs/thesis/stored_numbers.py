"""The page of printed numbers and a few figures of the gallery, stored for the report.

``python -m bent_beam_programs.thesis.stored_numbers GALLERY`` writes ``numbers.json`` beside the stored studies,
{"columns", "classes", "summary", "rows", "figures": [{"id", "title"}]}, a small picture of each figure, and the page
``docs/thesis_numbers.md``: all from what ``bentbeam gallery --out GALLERY`` has drawn.
"""

import argparse
import csv
from pathlib import Path

from bent_beam import stored
from bent_beam.files import write_atomically
from bent_beam_programs.thesis.gallery import ITEMS
from bent_beam_programs.thesis.gallery.numbers import markdown
from bent_beam_programs.thesis.stored_studies import FILE, PACKAGES, small_picture
from bent_beam_programs.thesis.verdicts import CLASSES, summary

SHOWN = ("extra-filter", "fig-3.24", "fig-3.27", "fig-3.34")  # of the five verdicts
WIDTH = 900  # of a small picture, pixels
PAGE = Path(__file__).resolve().parents[2] / "docs" / "thesis_numbers.md"


def main() -> None:
    """Store table and figures of a gallery folder. Raises ``OSError`` for a figure that it lacks."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("gallery", type=Path, metavar="GALLERY", help="a folder that bentbeam gallery has drawn")
    gallery: Path = parser.parse_args().gallery
    with (gallery / "table-numbers.csv").open(encoding="utf-8") as stream:
        columns, *rows = csv.reader(stream)
    for name in SHOWN:
        write_atomically(FILE.with_name(f"{name}.png"), small_picture(gallery / f"{name}.png", WIDTH))
    write_atomically(PAGE, markdown(rows))
    made_by = "bentbeam gallery --out GALLERY && python -m bent_beam_programs.thesis.stored_numbers GALLERY"
    figures = [{"id": name, "title": ITEMS[name].title} for name in SHOWN]
    data = {"columns": columns, "classes": list(CLASSES), "summary": summary(rows), "rows": rows, "figures": figures}
    print(stored.write(FILE.with_name("numbers.json"), "printed numbers of the thesis", made_by, PACKAGES, {}, data))


if __name__ == "__main__":
    main()
