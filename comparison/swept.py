"""What a sweep found: as a document, a table for readers, columns (pandas), a grid (xarray)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from bent_beam.settings import settings
from comparison.readable import flat, readable, text_table, unit_for
from comparison.rows import failures
from comparison.sweeping import NAMES, Row
from comparison.whole_numbers import WHOLE

if TYPE_CHECKING:
    import xarray

__all__ = ["SweepTable", "numeric"]


@dataclass(frozen=True)
class SweepTable:
    """Rows of a sweep of the case ``title`` by the method of ``path``. vary : key → values, the last one fastest."""

    title: str
    path: str
    vary: Mapping[str, Sequence[Any]]
    rows: Sequence[Row]

    @property
    def kept(self) -> int:
        """How many rows came from the store, all their runs."""
        return sum(row.kept for row in self.rows)

    @cached_property
    def units(self) -> dict[str, str]:
        """Unit of each key that is varied, as ``bentbeam settings`` has it."""
        known = {f"{one.table}.{one.name}": one.unit for one in settings()}
        return {key: known.get(key, "") for key in self.vary}

    def to_dict(self) -> dict[str, Any]:
        """The contract of ``bentbeam sweep --json``."""
        return {
            "title": self.title,
            "path": self.path,
            "vary": {key: list(values) for key, values in self.vary.items()},
            "rows": [row.to_dict() for row in self.rows],
            "failures": [{"varied": row.varied, "reason": row.reason} for row in failures(self.rows)],
            "kept": self.kept,
        }

    def to_dataset(self) -> xarray.Dataset:
        """The numbers, ``name`` and ``name_error``, over the keys as coordinates, SI; NaN where there is none."""
        import numpy as np
        import xarray

        columns = {"kappa_over_nu": "1"}
        columns |= {f"{n}{end}": WHOLE[n].unit or "1" for n in NAMES for end in ("", "_error", "_mean", "_std")}
        rows, shape = [flat(row.to_dict()) for row in self.rows], [len(values) for values in self.vary.values()]
        variables = {}
        for name, unit in columns.items():
            values = np.array([row.get(name) for row in rows], float)  # None is NaN
            if np.isfinite(values).any():
                variables[name] = (list(self.vary), values.reshape(shape), {"units": unit})
        coordinates = {
            key: (key, np.array(values if numeric(values) else list(map(str, values))), {"units": self.units[key]})
            for key, values in self.vary.items()
        }
        about = {"title": self.title, "path": self.path, "made_by": "bentbeam sweep"}
        return xarray.Dataset(variables, coordinates, about)

    @property
    def table(self) -> Any:
        """The same as a pandas frame: a column a key and a number, a row a case."""
        return self.to_dataset().to_dataframe().reset_index()

    def __str__(self) -> str:
        there = {name for row in self.rows for name in row.numbers}
        shown = {name: about.heading for name, about in WHOLE.items() if about.heading and name in there}
        units = {name: self._unit(name) for name in shown}
        head = [f"{key}, {unit}" if unit else key for key, unit in self.units.items()]
        head += [f"{title}, {units[name][1]}" if units[name][1] else title for name, title in shown.items()]
        body = []
        for row in self.rows:
            cells = [str(row.numbers[n].scaled(units[n][0])) if n in row.numbers else "-" for n in shown]
            body.append([readable(value) for value in row.varied.values()] + cells)
        kept = f"± is the error bar. {self.kept} of {len(self.rows)} rows came from the store."
        lines = [text_table(head, body), "", kept]
        if any(row.until is not None for row in self.rows):
            lines.append("Between two walls or supports no separation is the last: numbers until the case's end time.")
        lines += self._told("no numbers", [[row.reason] if row.reason else [] for row in self.rows])
        lines += self._told("warning", [row.warnings for row in self.rows])
        return "\n".join(lines)

    def _unit(self, name: str) -> tuple[float, str]:
        """In which a number is written: the same in all rows."""
        values = [row.numbers[name] for row in self.rows if name in row.numbers]
        return unit_for(WHOLE[name].unit, [getattr(one, "mean", one.value) for one in values])

    def _told(self, what: str, sentences: Sequence[Sequence[str]]) -> list[str]:
        """Each of the rows' sentences once, and of which rows it is."""
        found: dict[str, list[int]] = {}
        for number, texts in enumerate(sentences):
            for text in texts:
                found.setdefault(text, []).append(number)
        return [f"{what}: {text} ({self._which(numbers)})" for text, numbers in found.items()]

    def _which(self, numbers: Sequence[int]) -> str:
        """Rows in words."""
        if 1 < len(numbers) == len(self.rows):
            return "all rows"
        first = self.rows[numbers[0]].name
        return first if len(numbers) == 1 else f"{len(numbers)} rows, the first at {first}"


def numeric(values: Sequence[Any]) -> bool:
    return all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in values)
