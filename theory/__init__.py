"""The semi-analytic path: two-scale theory of a bent beam's impact on a wall, rigid (thesis, chapter 2) or
elastic, and closed forms of single hits.

`contact_parameters` solves the contact point, `ImpactFields` gives the beam around it, `SelfSimilarWave` the leading
order in closed form, `peak_moment` its largest bending moment, and `predict` gives them for a physical
impact. Its numbers carry the range in which they hold (`theory.validity`); one that is integrated in steps, the
largest force on a wall, has an error bar. The kernel is in `theory.kernel`, the φ functions in `theory.phi`. No answer
here comes from a simulation. Three bounds of their range do: how long shear is felt, on a rigid and on an elastic wall,
and how much damping of a beam's own a wall's law bears.

Beyond the thesis: `theory.shear`, `theory.damped_point`, `theory.stopped_beam`, `theory.elastic_wall`,
`theory.elastic_stop`, `theory.sideways`; exact impacts to test integrators on: `theory.ladder`.
"""

from theory.contact import ContactParameters, contact_parameters
from theory.fields import FieldValues, ImpactFields
from theory.prediction import Prediction, PredictionAtTime, predict
from theory.similarity import PeakMoment, SelfSimilarWave, peak_moment

__all__ = [
    "ContactParameters", "FieldValues", "ImpactFields", "PeakMoment", "Prediction", "PredictionAtTime",
    "SelfSimilarWave", "contact_parameters", "peak_moment", "predict",
]  # fmt: skip
