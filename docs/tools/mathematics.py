r"""Formulas become pictures (SVG) while the site is built, drawn by MathJax inside Python: no request, no script.

Pages: `pymdownx.arithmatex` keeps formulas away from Markdown and marks them; `on_page_content` draws what it marked.
Notebooks: nbconvert leaves formulas between dollars in the text of their Markdown cells.
Single symbols in running text (λ_c, K_w) get their index set low; long names in code may break after an underscore.
"""

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
SYMBOL = re.compile(r"(?<![\w/.@-])([^\W\d_][²³*]?)_([^\W\d_]{1,4}?[̇̈]?)(?=GA\b|(?![\w(]))")  # κ_sGA is κ_s times GA
CODE = re.compile(r"(<(code|pre|svg|script|style|title|a)\b.*?</\2>|<[^>]*>)", re.DOTALL)
NAME = re.compile(r"(?<=[a-z])_(?=[a-z])")
PLAIN_CODE = re.compile(r"<code>[^<]*</code>")
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

    drawn = MATHJAX_SETTINGS.sub("", CELL.sub(cell, MARKED.sub(marked, content)))
    return "".join((text, breakable)[k % 3](part) for k, part in enumerate(CODE.split(drawn)) if k % 3 != 2)


def breakable(part: str) -> str:
    """A tag as it is; a name in code with places where a narrow column may break it."""
    return NAME.sub("_<wbr>", part) if PLAIN_CODE.fullmatch(part) else part


def text(part: str) -> str:
    """Running text with the indices of single symbols set low."""
    return SYMBOL.sub(r"\1<sub>\2</sub>", part)
