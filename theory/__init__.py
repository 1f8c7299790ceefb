"""The semi-analytic path: two-scale theory of a bent beam's impact on a rigid wall (thesis, chapter 2).

`contact_parameters` solves the contact point, `ImpactFields` gives the beam around it, `SelfSimilarWave` the leading
order in closed form, `peak_moment` its largest bending moment, and `predict` says what that means for a physical
impact and where it may be trusted. The kernel is in `theory.kernel`, the φ functions in `theory.phi`.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from theory.contact import ContactParameters, contact_parameters
    from theory.fields import FieldValues, ImpactFields
    from theory.moment import PeakMoment, peak_moment
    from theory.prediction import Prediction, PredictionAtTime, predict
    from theory.similarity import SelfSimilarWave

__all__ = [
    "ContactParameters",
    "FieldValues",
    "ImpactFields",
    "PeakMoment",
    "Prediction",
    "PredictionAtTime",
    "SelfSimilarWave",
    "contact_parameters",
    "peak_moment",
    "predict",
]

# Each is imported when it is asked for: nine numbers take less time than all modules take to import.
_WHERE = {
    "ContactParameters": "theory.contact",
    "FieldValues": "theory.fields",
    "ImpactFields": "theory.fields",
    "PeakMoment": "theory.moment",
    "Prediction": "theory.prediction",
    "PredictionAtTime": "theory.prediction",
    "SelfSimilarWave": "theory.similarity",
    "contact_parameters": "theory.contact",
    "peak_moment": "theory.moment",
    "predict": "theory.prediction",
}


def __getattr__(name: str) -> Any:
    if name not in _WHERE:
        raise AttributeError(f"module 'theory' has no attribute {name!r}")
    return getattr(importlib.import_module(_WHERE[name]), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
