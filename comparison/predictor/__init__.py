"""The predictor: theory in one web page that needs no server and no network.

`page` is the whole page as text, `write_page` puts it into a file. The theory runs in the browser, in plain
JavaScript (templates/theory.js), from the same closed forms as `theory`; tests/comparison/test_predictor_browser.py
compares the two on random problems.
"""

from comparison.predictor.page import page, panel, write_page

__all__ = ["page", "panel", "write_page"]
