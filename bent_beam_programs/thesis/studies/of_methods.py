"""A study of given methods in place of the thesis's settings: its parameter varied on each, a line a method.

Parts and fields are named, the path does not matter: a method shows its parts by its fields and its ``PARTS``
(:mod:`bent_beam.method`). A study that needs a part which a method lacks names it (:class:`NotVaried`), and the method
becomes a row with that reason.
"""

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import NullFormatter

from bent_beam.cases import Case
from bent_beam.errors import ANY_FAILURE, InputError
from bent_beam.meshes import MESHES, Mesh
from bent_beam.method import Method, chosen_for, refined
from bent_beam_programs.thesis.sheet import Sheet
from bent_beam_programs.thesis.studies.outcome import Outcome
from bent_beam_programs.thesis.studies.thesis import Variant
from comparison.figures import style

CONCLUSION = (
    "Each row is one setting of one method on the same case, compared with theory; a row without numbers gives the "
    "reason."
)
SMALLEST = 1e-6  # in the picture, on a logarithmic axis
PANELS: dict[str, str] = {
    "reaction_error": "error of $r_0$  (%)",
    "contact_length_error": r"error of $\lambda_0$  (%)",
    "lift": r"lift $/(V_0t)$  (1)",
    "noise": "noise of $R$  (%)",
}


class NotVaried(ValueError):
    """A method lacks a part or a field that a study varies."""


@dataclass(frozen=True)
class MethodOnCase:
    """A method and the case that it runs: what a study varies."""

    method: Any
    case: Case

    def setting(self, name: str, method: Method, value: float | None = None, **others: Any) -> Variant:
        """A run with one value of the varied parameter, named alike for all methods. others : impact, end_time
        where they are not the case's."""
        about: dict[str, Any] = {"impact": self.case.impact, "end_time": self.case.end_time} | others
        return Variant(self.method.label, method=method, value=value, setting=name, **about)

    def has(self, name: str) -> bool:
        return name in getattr(self.method, "PARTS", {})

    def kinds(self, name: str) -> Mapping[str, type]:
        """The kinds of a part that the method knows. Raises :class:`NotVaried` where it has no such part."""
        if not self.has(name):
            raise NotVaried(f"{self.method.path} has no {name}")
        return dict(self.method.PARTS[name])

    def part(self, name: str, *, filled: bool = False) -> Any:
        """A part as the method has it; where it is left open, of the kind that is chosen for the case.

        filled : with the part's own open fields chosen too. Raises :class:`NotVaried` where there is none.
        """
        self.kinds(name)
        own = getattr(self.method, name)
        if own is not None and not filled:
            return own
        chosen: Any = getattr(chosen_for(self.method, self.case.impact, self.case.end_time), name)
        if chosen is None:
            raise NotVaried(f"{self.method.path} chooses its {name} in the run: name one")
        if filled:
            return chosen
        try:
            return type(chosen)()
        except TypeError:  # it has no defaults
            return chosen

    def with_parts(self, **parts: Any) -> Method:
        changed: Method = dataclasses.replace(self.method, **parts)
        return changed

    def with_field(self, name: str, **values: Any) -> Method:
        """A copy with fields of one part changed. Raises :class:`NotVaried` for a field that the part lacks."""
        part = self.part(name)
        for field in values.keys() - {f.name for f in dataclasses.fields(part)}:
            raise NotVaried(f"its {name} ({type(part).__name__}) has no {field}")
        return self.with_parts(**{name: dataclasses.replace(part, **values)})

    def over(self, name: str, field: str, words: str, values: Sequence[float]) -> list[Variant]:
        """One field of a part at several values, which are named by ``words``. Raises :class:`NotVaried` where the
        method states one: no row would have it."""
        part = self.part(name)
        stated = getattr(part, field, None)
        if stated not in (getattr(type(part), field, stated), *values):
            raise NotVaried(f"its {name}.{field} is what the study varies: leave it out (got {stated!r})")
        return [self.setting(words.format(v), self.with_field(name, **{field: v}), v) for v in values]

    def laid_on(self, mesh: Mesh) -> Method:
        """A copy with another mesh and the steps that the method has with its own."""
        steps = {"integrator": self.part("integrator", filled=True)} if self.has("integrator") else {}
        return self.with_parts(mesh=mesh, **steps)

    def grown(self, growths: Sequence[float]) -> list[Variant]:
        """On meshes that grow by these factors outside the zone; none where the method's mesh does not grow."""
        mesh = self.part("mesh", filled=True)
        for name in ("growth_outside", "growth"):
            if type(mesh) in MESHES.values() and getattr(mesh, name, None) is not None:
                laid = {e: self.laid_on(dataclasses.replace(mesh, **{name: e})) for e in growths}
                return [self.setting(f"e = {e:g}", method, e) for e, method in laid.items()]
        return []


Vary = Callable[[MethodOnCase], Sequence[Variant]]  # the runs of a study on a method; raises NotVaried


def of_kind(kind: type, part: Any) -> Any:
    """A part of another kind that keeps the fields which both kinds have and ``part`` sets."""
    known = {f.name for f in dataclasses.fields(kind)}
    given = {f.name: getattr(part, f.name) for f in dataclasses.fields(part) if f.name in known}
    return kind(**{name: value for name, value in given.items() if value is not None})


def runs_of_methods(
    vary: Vary, case: Case, methods: Sequence[Method], refines: Sequence[float]
) -> list[Variant | Outcome]:
    """The runs of all methods at all resolutions. A method that the study cannot use, and one that refuses the case,
    are rows with the reason."""
    found: list[Variant | Outcome] = []
    for method, factor in product(methods, refines):
        asked = Variant(method.label, case.impact, case.end_time, method, refine=factor)
        try:
            if (finer := refined(method, factor)) is None:
                raise InputError(f"refine: {method.path} does not know how to be refined (got {factor:g})")
            if reason := finer.refuses(case.impact):
                raise InputError(reason)
            runs = vary(MethodOnCase(finer, case))
            found += [dataclasses.replace(run, label=method.label, refine=factor) for run in runs]
        except NotVaried as error:
            found.append(asked.lost(f"not varied: {error}", refused=True))
        except ANY_FAILURE as error:
            found.append(asked.lost(str(error), refused=True))
    return found


def draw_methods(sheet: Sheet, heading: str, outcomes: Sequence[Outcome]) -> None:
    """Errors, lift and noise over the settings, a line a method (and resolution)."""
    finished = [o for o in outcomes if o.failure is None]
    if not finished:
        return
    settings = list(dict.fromkeys(o.setting for o in finished))
    marks = style.marks(o.method for o in finished)
    height = 4.4 + 0.17 * -(-len(marks) // 2) + 0.06 * max(map(len, settings))
    with sheet.figure(2, 2, height=height, sharex=True, legend=2, legend_size=6.5) as (_, axes):
        for axis, (name, title) in zip(axes.flat, PANELS.items()):
            for label, mark in marks.items():
                mine = [o for o in finished if o.method == label]
                points = [(settings.index(o.setting), abs(v)) for o in mine if (v := o.measures.get(name)) is not None]
                if points:
                    x, y = np.array(points, float).T
                    sheet.line(axis, x, np.maximum(y, SMALLEST), series=label, **mark | {"ls": "-", "lw": 0.7})
            _decades(axis)
            axis.set_ylabel(title)
            axis.set_xticks(range(len(settings)), settings, rotation=45.0, ha="right", rotation_mode="anchor")
            axis.set_xlim(-0.4, len(settings) - 0.6)
        for axis in axes[-1]:
            axis.set_xlabel(heading)


def _decades(axis: Axes) -> None:
    """A logarithmic axis over whole decades."""
    axis.set_yscale("log")
    axis.yaxis.set_minor_formatter(NullFormatter())
    drawn = [line.get_ydata() for line in axis.lines]
    if drawn:
        values = np.concatenate([np.asarray(y, float) for y in drawn])
        low, high = np.log10([values.min(), values.max()])
        axis.set_ylim(10.0 ** np.floor(low - 0.02), 10.0 ** np.ceil(high + 0.02))
