"""Evaluation of a history: λ₀, r₀, λ₁, r₁, impulse, hits and peaks, each with its error bar, from the history alone:
no path or theory is asked. (``limits.py`` has limits of checks by path and integrator.)"""
