"""Evaluation of a history: λ₀, r₀, λ₁, r₁, impulse, hits and peaks, each with its error bar, independent of paths and
theory."""
