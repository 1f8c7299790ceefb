"""Methods of somebody else's. The first imports nothing installed: what it imports is looked up for every run."""

import time
from dataclasses import dataclass
from typing import ClassVar

from bent_beam import SimulationError
from self_similar_fe import SelfSimilarFE


@dataclass(frozen=True)
class Stranger:
    """The self-similar solver under another name, which fails where it is told to; an error, before any run."""

    path: ClassVar[str] = "stranger"
    trouble: str | type[BaseException] = ""
    label: str = "Stranger"

    def refuses(self, impact):
        if isinstance(self.trouble, type):
            raise self.trouble("nobody looked")
        return "curvature: not today" if self.trouble == "refuses" else None

    def simulate(self, impact, *, end_time=None, save=200, progress=None):
        if self.trouble == "fails":
            raise SimulationError("no luck", time=1.0, step=3, advice="another day")
        if self.trouble == "creeps":
            while True:
                time.sleep(0.01)
                progress(0.0)
        return SelfSimilarFE(refine=0.5).simulate(impact, end_time=end_time, save=save, progress=progress)


@dataclass(frozen=True)
class Unlabelled:
    """Without parts, answers nothing, and is no method for want of a label."""

    path: ClassVar[str] = "theirs"

    def refuses(self, impact):
        return "axial_force is not modelled" if impact.axial_force else None

    def simulate(self, impact, **how):
        return None


@dataclass(frozen=True)
class Plain(Unlabelled):
    label: str = "theirs"
