r"""Formulas become pictures (SVG) while the site is built, drawn by MathJax inside Python: no request, no script.

Pages: `pymdownx.arithmatex` keeps formulas away from Markdown and marks them; `on_page_content` draws what it marked.
Notebooks: nbconvert leaves formulas between dollars in the text of their Markdown cells.
"""

from __future__ import annotations

import functools
import html
import re
from typing import Any

from quickjax import MathJaxRenderer

MARKED = re.compile(r'<(span|div) class="arithmatex">\\[(\[](.*?)\\[)\]]</\1>', re.DOTALL)
CELL = re.compile(
    r'(<div class="jp-RenderedHTMLCommon[^>]*data-mime-type="text/markdown">)(.*?)(</div>\s*</div>)', re.DOTALL
)
DOLLARS = re.compile(r"\$\$(.+?)\$\$|\$([^$]+?)\$", re.DOTALL)
TAG = re.compile(r"\\tag\{([^}]*)\}")
MATHJAX_SETTINGS = re.compile(r"<!-- Load mathjax -->.*?<!-- End of mathjax configuration -->", re.DOTALL)


@functools.cache
def renderer() -> MathJaxRenderer:
    """One MathJax for all pages: it takes a moment to start."""
    return MathJaxRenderer()


def formula(source: str, *, display: bool) -> str:
    """LaTeX as a picture whose name is its source; a ``\\tag`` stands at the right of a displayed formula.

    Raises ValueError where MathJax cannot read the source.
    """
    tag, plain = TAG.search(source), " ".join(TAG.sub("", source).split())
    picture = renderer().render(plain, display=display)
    if 'data-mml-node="merror"' in picture:
        raise ValueError(f"MathJax cannot read the formula {plain!r}")
    picture = picture.replace('role="img"', f'role="img" class="formula" aria-label="{html.escape(plain)}"', 1)
    if not display:
        return picture
    number = f'<span class="equation-number">({html.escape(tag[1])})</span>' if tag else ""
    return f'<div class="equation"><div>{picture}</div>{number}</div>'


def on_page_content(content: str, **_: Any) -> str:
    """MkDocs event: every formula of the page is drawn."""

    def marked(match: re.Match[str]) -> str:
        return formula(html.unescape(match[2]), display=match[1] == "div")

    def between_dollars(match: re.Match[str]) -> str:
        return formula(html.unescape(match[1] or match[2]), display=match[1] is not None)

    def cell(match: re.Match[str]) -> str:
        return match[1] + DOLLARS.sub(between_dollars, match[2]) + match[3]

    return MATHJAX_SETTINGS.sub("", CELL.sub(cell, MARKED.sub(marked, content)))
