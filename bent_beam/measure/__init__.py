"""Evaluation of a history, from the history alone: λ₀, r₀, λ₁, r₁ with error bars; impulse, hits and peaks, whose bars
come from other runs (:mod:`comparison.runs`). No path or theory is asked.

``moments`` reduces impulses, ``reduction`` bending moments and pushes; ``estimators`` fits λ and r, ``instant`` reads
one time, ``whole_impact`` a rebound; ``numbers`` are those with bars. ``balance`` checks a run by ``limits``."""
