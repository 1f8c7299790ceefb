"""Every figure, table and printed number of the thesis, and its parameter studies."""
