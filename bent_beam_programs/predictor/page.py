"""The page from its template. Nothing in it refers to anything outside.

Its scripts stand in ``templates/``, in the order of ``MODEL``, ``SIMULATION`` and ``PAGE``; the head of each says
what it is for. After a change, write the guide's copy anew: ``bentbeam predictor --out docs/predictor.html
--overwrite``.
"""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from bent_beam.files import write_atomically
from bent_beam.hysteresis import FIRST_MODE, SOFT
from bent_beam.measure.numbers import FACTOR
from bent_beam.measure.reduction import OF_BEAM
from bent_beam.measure.whole_impact import SHORTEST_SEPARATION, WINDOW
from bent_beam.method import LONGEST, LONGEST_OF_WALL, ON_WALL
from bent_beam_programs.predictor.coefficients import coefficients
from comparison.bouncing import ABOUT, DAMPING_RATIOS, RETURNS
from comparison.doubts import LEAST_RESTITUTION, OVERDAMPED, SOUND, STEEP, STRAIGHTENED, STRETCHED, STUBBY, SUNK, WIDE
from comparison.readable import BEAMS, BEFORE, LIMITS, NO_REACTION, REACTION_LATER, REGIMES, SHORT_ZONE
from comparison.runs import CHATTER, FLATTEST, LEAST, LEAST_LIGHT, LIGHT
from hermite_fe import whole_beam
from theory import contact_parameters, damped_point, shear, validity, wall_prediction
from theory.second_order import second_order

TEMPLATES = Path(__file__).parent / "templates"
MODEL = ("theory.js", "point.js", "limits.js", "beam.js", "instants.js", "case.js")
SIMULATION = ("elements.js", "contact.js", "solver.js", "answer.js", "worker.js")  # of the workers
PAGE = ("answer.js", "draw.js", "form.js", "words.js", "plots.js", "motion.js", "view.js")
WORDS = {"regimes": REGIMES, "short": SHORT_ZONE, "limits": LIMITS, "before": BEFORE, "beams": BEAMS,
         "later": REACTION_LATER, "never": NO_REACTION}  # fmt: skip
"""What ``bentbeam predict`` says of contact, theory and beam."""
DOUBTS = {"wide": WIDE, "least_restitution": LEAST_RESTITUTION, "steep": STEEP, "stubby": STUBBY,
          "straightened": STRAIGHTENED, "sound": SOUND, "stretched": STRETCHED,
          "overdamped": OVERDAMPED, "sunk": SUNK}  # fmt: skip
"""From when on ``bentbeam bounce`` warns."""
BARS = {"factor": FACTOR, "least": LEAST, "light": LIGHT, "leastLight": LEAST_LIGHT, "flattest": FLATTEST,
        "chatter": CHATTER, "about": ABOUT, "window": WINDOW, "returns": RETURNS, "ratios": DAMPING_RATIOS,
        "soft": SOFT}  # fmt: skip
"""Of its error bars, the damping ratios that it takes where none is stated, and on which walls it takes none."""
RUNS = {"elements": whole_beam.SHEARED_ELEMENTS, "step": whole_beam.SHEARED_STEP, "hard": whole_beam.HARD,
        "thick": whole_beam.THICK, "damped": whole_beam.DAMPED, "point": whole_beam.ONE_POINT,
        "pressed": whole_beam.PRESSED, "largest": whole_beam.LARGEST_ELASTIC, "longest": LONGEST, "onWall": ON_WALL,
        "longestOfWall": LONGEST_OF_WALL, "mode": FIRST_MODE, "separation": SHORTEST_SEPARATION,
        "unresolved": OF_BEAM}  # fmt: skip
"""Of its runs: elements and steps, what asks for finer ones or another scheme, and what is looked at."""
CONSTANTS = {
    validity: ("TOLERANCE", "DISTANCE", "SWING", "FLAT", "SMALL_CHANGE", "FLATTEST_SOLVED", "SLOPE_LIMIT"),
    shear: ("FORGOTTEN", "FLATTEST_SHEARED"),
    damped_point: ("AHEAD_FROM",),
    wall_prediction: tuple("FLATTEST_SETTLED LEAST_DAMPED ZONE_TIME ZONE_LENGTHS POINT_TIME SHARP_POINT_TIME".split()),
}
"""Of `theory`, what its formulas in limits.js and instants.js need: there by the same names in small letters."""


def constants() -> dict[str, float]:
    """:data:`CONSTANTS`, and the rates at which either load changes the gap's curvature at one point."""
    alpha, axial = (second_order(contact_parameters(1.0, a, axial=n)).opening for a, n in ((1.0, 0.0), (0.0, 1.0)))
    found = {name.lower(): getattr(module, name) for module, names in CONSTANTS.items() for name in names}
    return found | {"opening_alpha": alpha, "opening_axial": axial}


def script(names: tuple[str, ...] = (*MODEL, *PAGE)) -> str:
    data = {"COEFFICIENTS": coefficients(), "VALIDITY": constants(), "WORDS": WORDS, "DOUBTS": DOUBTS, "BARS": BARS,
            "RUNS": RUNS}  # fmt: skip
    return _script(data, names)


def page() -> str:
    """The page as text, complete in itself. What the workers run stands in it once, as the page's own script."""
    text = _source("predictor.html").replace("{{ style }}", _source("predictor.css"))
    workers = _script({"BARS": BARS, "RUNS": RUNS}, SIMULATION)
    return text.replace("{{ simulation }}", workers).replace("{{ script }}", script())


def write_page(file: Path) -> Path:
    """Write the page to ``file`` (its folder is made) and return the path."""
    write_atomically(file, page())
    return file


def _script(data: Mapping[str, Any], names: tuple[str, ...]) -> str:
    """The scripts after what they read, by its name."""
    read = {name: json.dumps(value, separators=(",", ":"), ensure_ascii=False) for name, value in data.items()}
    return "\n".join([*(f"const {name} = {text};" for name, text in read.items()), *map(_source, names)])


def _source(name: str) -> str:
    return (TEMPLATES / name).read_text(encoding="utf-8")
