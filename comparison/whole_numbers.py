"""The numbers of a whole impact: what each is measured in and called; and what is said of a hit, in a table of hits.

A further number is a line of the table and a field of :class:`bent_beam.measure.whole_impact.WholeImpact`, which reads
it off the record (or :mod:`bent_beam.measure.reduction`). The record must have what it needs: ``VARIABLES`` in
bent_beam/files.py, written by both paths (hermite_fe/simulate.py, exudyn_models/recording.py). What no companion run
shows of its error is named in :mod:`comparison.bouncing`. With a heading, or where its name begins with
``peak_moment``, a sweep has it. ``predict`` says those of ``OF_WHOLE_IMPACT`` (predicting.py, in the words of
texts.py), other answers those of ``OF_WHOLE`` (bounced.py), the report those of ``WHOLE`` (report/whole.py), the page
those of its ``answer.js``, which ``solver.js`` measures and ``view.js`` shows; ``SHOWN`` in figures/sweep.py are drawn.
``MAY_BE_WIDE`` (doubts.py) are warned of, ``OF_THE_WHOLE`` (benchmarks/beams.py) held against finer runs.
"""

from typing import NamedTuple


class WholeNumber(NamedTuple):
    """What is said of a number.

    scale : its SI unit among those of the beam (``Bounce.units``), empty where it has none, or comes from another
        number, as a stress does; unit : the name of that.
    title : in the text of an answer. heading : in a sweep's table, empty where it does not stand there.
    more : stands in the longer text alone. final : exists only once the beam has left.
    """

    scale: str
    unit: str
    title: str
    heading: str = ""
    more: bool = False
    final: bool = False


WHOLE = {
    "restitution": WholeNumber("", "", "coefficient of restitution", "restitution", final=True),
    "impulse": WholeNumber("impulse", "N s", "impulse", "impulse", final=True),
    "last_contact": WholeNumber("time", "s", "last contact", "last contact", final=True),
    "peak_moment": WholeNumber("moment", "N m", "largest bending moment", "largest moment"),
    "peak_stress": WholeNumber("", "Pa", "largest stress", "largest stress"),
    "peak_force": WholeNumber("force", "N", "largest force on the wall", "largest force"),
    "push": WholeNumber("impulse", "N s", "largest impulse within"),
    "translation": WholeNumber("energy", "J", "energy left in translation", final=True),
    "vibration": WholeNumber("energy", "J", "energy left in vibration", final=True),
    "dissipated": WholeNumber("energy", "J", "energy dissipated", final=True),
    "peak_moment_place": WholeNumber("length", "m", "place of the largest moment, from the middle", more=True),
    "peak_moment_time": WholeNumber("time", "s", "its time", more=True),
    "midspan_moment": WholeNumber("moment", "N m", "largest moment at the middle", more=True),
    "separations": WholeNumber("", "", "separations", more=True),
}
NUMBERS = tuple(name for name in WHOLE if name not in ("peak_stress", "peak_force"))
"""Those of every whole impact: a stress needs a section, a largest force a wall that gives way."""
FINAL = tuple(name for name, about in WHOLE.items() if about.final)
MAY_RISE = ("peak_moment", "peak_force")  # those that may still grow if a run ends with the beam at the wall

HIT = {
    "wall": "wall",
    "begin": "from, s",
    "end": "to, s",
    "place": "mean |x|, m",
    "impulse": "impulse, N s",
    "before": "V before, m/s",
    "after": "after, m/s",
    "restitution": "restitution",
    "energy": "energy, J",
    "lost": "lost, J",
    "moment": "moment, N m",
}
BETWEEN_WALLS = tuple(name for name in HIT if name != "restitution")
OF_ONE_WALL = ("begin", "end", "impulse", "before", "after", "restitution", "moment")
