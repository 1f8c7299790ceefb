"""The semi-analytic path: two-scale theory of a bent beam's impact on a rigid wall (thesis, chapter 2).

`contact_parameters` solves the contact point, `predict` says what that means for a physical impact and
where it may be trusted; the kernel and the φ functions are in `theory.kernel` and `theory.phi`.
"""

from theory.contact import ContactParameters, contact_parameters
from theory.prediction import Prediction, PredictionAtTime, ValidityCheck, predict

__all__ = [
    "ContactParameters",
    "Prediction",
    "PredictionAtTime",
    "ValidityCheck",
    "contact_parameters",
    "predict",
]
