"""Evaluation of a history, from the history alone: λ₀, r₀, λ₁, r₁ with error bars; impulse, hits and peaks, whose bars
come from other runs (:mod:`comparison.runs`). No path or theory is asked. (``limits.py`` has limits of checks by path
and integrator.)"""
