"""Tables of README and docs, and the numbers in their cells."""

import itertools
import re

from here import ROOT

RAISED = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹−", "-0123456789-")
NUMBER = re.compile(r"([-+]?\d+(?:\.(\d+))?)(?:(?:·10|e)([-+]?\d+))?")


def stated(text: str) -> tuple[float, float]:
    """A number as it is printed, 10⁻³ among them, and the unit of its last digit."""
    found = NUMBER.search(re.sub(r"^10(?=-\d)", "1e", text.translate(RAISED)))
    assert found, text
    power = 10.0 ** int(found[3] or 0)
    return float(found[1]) * power, power * 10.0 ** -len(found[2] or "")


def cells(line: str) -> list[str]:
    return [cell.strip() for cell in line.strip()[1:-1].replace(r"\|", "/").split("|")]


def lines_after(page: str, words: str) -> list[list[str]]:
    """The first table below these words of a page, by lines; the second is the rule under the titles."""
    text = (ROOT / page).read_text(encoding="utf-8")
    lines = text[text.index(words) :].splitlines()
    first = next(k for k, line in enumerate(lines) if line.startswith("|"))
    return [cells(line) for line in itertools.takewhile(lambda line: line.startswith("|"), lines[first:])]
