"""Figures: one style (:mod:`comparison.figures.style`), one small module a family of figures."""
