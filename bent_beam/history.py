"""The record of a run in SI units, the same for every path; as an ``xarray.Dataset`` for those who ask for one.

Dimensions: ``time`` (the saved instants), ``x`` (nodes) and ``contact`` (contact points). ``bent_beam/files.py`` lists
those that are checked, with dimensions and units; docs/guide/history.md says what each is. Attributes are JSON text.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bent_beam.checks import non_negative
from bent_beam.files import ENERGIES, UNITS, check_contents, check_variables, read_dataset, write_dataset
from bent_beam.impact import Impact
from bent_beam.loads import Array
from bent_beam.section import Section
from bent_beam.versions import versions

if TYPE_CHECKING:
    import xarray as xr

COORDINATES = ("time", "x", "contact_x")
FORMAT = "bent-beam-impact history 2"
REFLECTED = "waves may run to the ends of the beam"  # so begins what a run says that no endless beam covers to its end


class Variable(NamedTuple):
    """Dimensions, values of that shape, and the unit as ``{"units": …}``, empty for none."""

    dims: tuple[str, ...]
    values: NDArray[Any]
    attrs: Mapping[str, str]


@dataclass(frozen=True, eq=False, repr=False)
class ImpactHistory:
    """The result of a simulation: variables and attributes, with typed access to common quantities.

    >>> from bent_beam import Impact
    >>> from self_similar_fe import SelfSimilarFE
    >>> history = SelfSimilarFE().simulate(Impact.dimensionless(0.5), end_time=0.1, save=50)
    >>> history.array("total_impulse").shape == history.time.shape
    True
    """

    variables: Mapping[str, Variable]
    attrs: Mapping[str, Any]

    @classmethod
    def build(
        cls,
        *,
        impact: Impact,
        path: str,
        symmetry: str,
        settings: Mapping[str, Any],
        time: Array,
        x: Array,
        contact_x: Array,
        fields: Mapping[str, tuple[Sequence[str], NDArray[Any]]],
        warnings: Sequence[str] = (),
        steps: int = 0,
        seconds: float = 0.0,
        completed: bool = True,
    ) -> ImpactHistory:
        """Assemble a history.

        path : name of the path; symmetry : "half" or "full" (what was modelled);
        settings : JSON-ready description of mesh, integrator, contact …; fields : name → (dims, values);
        steps, seconds : time steps taken and wall seconds spent in the solver.
        Raises ``ValueError`` when a field is not finite or has other dimensions than a history has.
        """
        places = {"time": (("time",), time), "x": (("x",), x), "contact_x": (("contact",), contact_x)}
        variables: dict[str, Variable] = {}
        for name, (dims, values) in {**fields, **places}.items():
            array = np.asarray(values, float if name in COORDINATES else None)
            variables[name] = Variable(tuple(dims), array, {"units": UNITS[name]} if name in UNITS else {})
        attrs = {
            "format": FORMAT,
            "path": path,
            "symmetry": symmetry,
            "impact": json.dumps(asdict(impact)),
            "settings": json.dumps(dict(settings), sort_keys=True),
            "versions": json.dumps(versions(), sort_keys=True),
            "warnings": json.dumps(list(warnings)),
            "steps": int(steps),
            "seconds": float(seconds),
            "completed": int(completed),
        }
        check_variables(variables)
        return cls(variables, attrs)

    @classmethod
    def of(cls, dataset: xr.Dataset) -> ImpactHistory:
        """The history that :attr:`dataset` shows."""
        parts = {str(n): Variable(tuple(map(str, v.dims)), v.values, v.attrs) for n, v in dataset.variables.items()}
        return cls(parts, dataset.attrs)

    def with_warnings(self, warnings: Sequence[str]) -> ImpactHistory:
        """The same with other warnings."""
        return replace(self, attrs={**self.attrs, "warnings": json.dumps(list(warnings))})

    def until(self, time: float) -> ImpactHistory:
        """The same up to the saved instant nearest to ``time``, s."""
        last = int(np.argmin(np.abs(self.time - non_negative("time", time))))
        cut = {n: v._replace(values=v.values[: last + 1]) for n, v in self.variables.items() if "time" in v.dims}
        steps = round(self.steps * float(self.time[last] / (self.time[-1] or 1.0)))  # of steps that are alike
        return replace(self, variables={**self.variables, **cut}, attrs={**self.attrs, "steps": steps})

    def described(self, title: str, section: Section | None) -> ImpactHistory:
        """The same that knows the title of its case, and its section, for stresses."""
        held = {"title": title} if title else {}
        if section is not None:
            held["section"] = json.dumps({"area": section.area, "section_modulus": section.section_modulus})
        return replace(self, attrs={**self.attrs, **held})

    @cached_property
    def dataset(self) -> xr.Dataset:
        """All of it, for xarray; values are shared."""
        import xarray as xr

        parts: dict[str, Any] = dict(self.variables)
        return xr.Dataset(parts, {name: parts.pop(name) for name in COORDINATES if name in parts}, dict(self.attrs))

    @cached_property
    def impact(self) -> Impact:
        return Impact(**json.loads(self.attrs["impact"]))

    @property
    def path(self) -> str:
        return str(self.attrs["path"])

    @property
    def symmetry(self) -> str:
        """What was modelled: the "half" beam or the "full" one."""
        return str(self.attrs["symmetry"])

    @property
    def sides(self) -> int:
        """Sides of the first touch that were modelled: 1 of the half beam, 2 of the full one."""
        return 2 if self.symmetry == "full" else 1

    @property
    def settings(self) -> dict[str, Any]:
        return dict(json.loads(self.attrs["settings"]))

    @property
    def versions(self) -> dict[str, str]:
        return dict(json.loads(self.attrs["versions"]))

    @property
    def warnings(self) -> list[str]:
        return list(json.loads(self.attrs["warnings"]))

    @property
    def steps(self) -> int:
        return int(self.attrs["steps"])

    @property
    def seconds(self) -> float:
        return float(self.attrs["seconds"])

    @property
    def completed(self) -> bool:
        return bool(self.attrs["completed"])

    @property
    def time(self) -> Array:
        """Saved instants, s, shape (times,)."""
        return self.array("time")

    def positions(self, k: int) -> Array:
        """Node places at saved instant ``k``, m, shape (nodes,)."""
        return self.array("position", k) if "position" in self else self.array("x")

    def contact_positions(self, k: int) -> Array:
        """Contact point places at saved instant ``k``, m, shape (contacts,)."""
        return self.array("contact_position", k) if "contact_position" in self else self.array("contact_x")

    def bending_moments(self, k: int | slice) -> tuple[Array, Array]:
        """Bending moment EI(y_xx + K₀), N m, at both ends of each element at saved instant ``k``, and its places, m,
        both of shape (elements, 2); K₀ is the curvature of the beam free of stress. For a slice of instants, of a fixed
        mesh, the moments have these in front.

        Moments that the path has recorded, as of a beam with shear; else y_xx is that of the Hermite cubic through
        deflections and slopes (by differences where a history has none). The part η y_txx of a damped beam is left out.
        """
        impact, x = self.impact, self.positions(0 if isinstance(k, slice) else k)
        place = np.stack([x[:-1], x[1:]], axis=1)
        if "bending_moment" in self:
            recorded = self.array("bending_moment", k)
            return np.stack([recorded[..., :-1], recorded[..., 1:]], axis=-1), place
        y = -self.array("gap", k) - 0.5 * impact.wall_curvature * (x - impact.first_touch) ** 2
        slope = self.array("slope", k) if "slope" in self else np.gradient(y, x, axis=-1, edge_order=2)
        return impact.bending_stiffness * (end_curvatures(x, y, slope) + impact.unbent_curvature), place

    @property
    def modelled_length(self) -> float:
        """What is modelled of the beam at the first saved instant, m, both sides, along x."""
        return 2.0 / self.sides * float(np.ptp(self.positions(0)))

    @property
    def is_arc(self) -> bool:
        """Whether the beam lies along an arc, longer than its places along x say."""
        return (self.settings.get("geometry") or {}).get("kind") == "TrueGeometry"

    @property
    def is_whole(self) -> bool:
        """Whether all of the beam is modelled, of an arc by its chords."""
        rise = np.diff(self.array("gap", 0)) * self.is_arc
        return 2.0 / self.sides * float(np.hypot(np.diff(self.positions(0)), rise).sum()) >= 0.99 * self.impact.length

    def impulse_at(self, time: Any) -> Any:
        """Impulse of the wall since the first touch, N s, at ``time``, s, linear between saved instants."""
        return np.interp(time, np.append(0.0, self.time), np.append(0.0, self.array("total_impulse")))

    @property
    def force(self) -> Array:
        """Mean force of the wall since the saved instant before, N, shape (times,)."""
        start = 0.0 if self.time[0] else -np.inf  # nothing is before an instant 0: no force
        return np.diff(self.array("total_impulse"), prepend=0.0) / np.diff(self.time, prepend=start)

    @property
    def moment(self) -> Array:
        """Largest |M|, N m, (times,): of all steps since the saved instant before where known, or at the instant."""
        if "largest_moment" in self:
            return self.array("largest_moment")
        return np.array([np.abs(self.bending_moments(k)[0]).max() for k in range(self.time.size)])

    @property
    def stress(self) -> Array | None:
        """Largest normal stress |M|/W + |N|/A, Pa, shape (times,); ``None`` where the section is not known."""
        if "section" not in self.attrs:
            return None
        section = json.loads(self.attrs["section"])
        return self.moment / section["section_modulus"] + abs(self.impact.axial_force) / section["area"]

    def plot(self) -> Any:
        """Force and stress (without a section the moment) over time as a Matplotlib figure."""
        from bent_beam.pictures import force_and_stress

        return force_and_stress(self)

    def __repr__(self) -> str:
        return f"<ImpactHistory: {self.path}, {self.time.size} instants until {self.time[-1]:.4g} s>"

    def __contains__(self, name: str) -> bool:
        return name in self.variables

    def array(self, name: str, k: int | slice | NDArray[np.intp] | None = None) -> NDArray[Any]:
        """The values of one variable, of all saved instants or of those numbered ``k``."""
        values = self.variables[name].values
        return values if k is None else np.asarray(values[k])

    def energy(self, name: str) -> Array:
        """One of :data:`ENERGIES`, or the branch energy, J, shape (times,): nothing where the path has no such term."""
        return self.array(name) if name in self else np.zeros(self.time.size)

    def energy_budget(self, until: float | None = None) -> dict[str, float]:
        """Where the energy went from the first saved instant to ``until``, s (default: the last instant; linear between
        instants), J, and the ``defect`` of the sum."""
        end = self.time[-1] if until is None else until
        budget = {n: float(np.interp(end, self.time, self.array(n)) - self.array(n)[0]) for n in ENERGIES if n in self}
        defect = sum(-value if name == "work_of_loads" else value for name, value in budget.items())
        initial = float(self.array("kinetic_energy")[0] + self.array("strain_energy")[0])
        return budget | {"initial_energy": initial, "defect": defect}

    def save(self, file: str | Path) -> Path:
        """Write netCDF: a killed run or a full disk leaves either the whole file or none. Returns the path."""
        write_dataset(self.dataset, Path(file))
        return Path(file)

    @classmethod
    def load(cls, file: str | Path) -> ImpactHistory:
        """Read a history; ``ValueError`` when the file is none, or holds anything that a history does not."""
        history = cls.of(read_dataset(Path(file)))
        if history.attrs.get("format") != FORMAT:
            raise ValueError(f"{file} is not a history of this project")
        try:
            check_contents(history)
        except (ValueError, TypeError, KeyError, OverflowError, RecursionError) as error:
            what = f"{error} is missing" if isinstance(error, KeyError) else str(error)
            raise ValueError(f"{file} is not a good history: {what}") from None
        return history


def end_curvatures(x: Array, y: Array, slope: Array) -> Array:
    """y_xx of the cubics between nodes at both ends of each element, (…, elements, 2), from values at (…, nodes)."""
    h = np.diff(x)
    rise = np.diff(y, axis=-1) / h
    left = (6.0 * rise - 4.0 * slope[..., :-1] - 2.0 * slope[..., 1:]) / h
    right = (-6.0 * rise + 2.0 * slope[..., :-1] + 4.0 * slope[..., 1:]) / h
    return np.stack([left, right], axis=-1)
