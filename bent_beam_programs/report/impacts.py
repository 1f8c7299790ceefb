"""Impacts to look at: each simulated by every method, reduced to one timeline, in units of the fast layer."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache, partial
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

from bent_beam import Impact, ImpactHistory
from bent_beam.as_json import plain
from bent_beam.errors import ANY_FAILURE
from bent_beam.history import Array
from bent_beam.measure.force_map import force_map
from bent_beam.measure.moments import moments
from bent_beam.method import Method, chosen_for, settings_of
from bent_beam_programs.report.rows import percent, true_minus
from comparison.runs import kept
from comparison.store import RunStore
from comparison.workers import Count, run_all
from theory import ImpactFields, contact_parameters

FRAMES = 32
POINTS = 91
BINS = 60
INSTANTS = 400
END = 0.1  # τ
START = 0.1  # of the way in √τ, the first frame

ENERGIES: dict[str, dict[str, Any]] = {  # what a method may report → how it is drawn
    name: {"title": title, "colour": colour, "dash": name.startswith("loss")}
    for name, title, colour in (
        ("kinetic_energy", "kinetic energy, change", "#0072B2"),
        ("strain_energy", "strain energy, change", "#D55E00"),
        ("work_of_loads", "work of wall and loads", "#009E73"),
        ("loss_impact", "lost in impacts", "#CC79A7"),
        ("loss_algorithmic", "lost in time integration", "#E69F00"),
        ("loss_viscous", "lost in grid viscosity", "#56B4E9"),
        ("loss_material", "lost in the material", "#8C6D31"),
        ("loss_absorbed", "absorbed far away", "#777777"),
    )
}


@dataclass(frozen=True)
class Shown:
    """An impact to be shown: κ/ν, (α, ψ, χ) and the size ε of the first order, ν = 1."""

    name: str
    title: str
    kappa_over_nu: float = 0.5
    first: tuple[float, float, float] = (0.0, 0.0, 0.0)
    epsilon: float = 0.0

    @property
    def impact(self) -> Impact:
        alpha, psi, chi = (self.epsilon * load for load in self.first)
        return Impact.dimensionless(self.kappa_over_nu, epsilon_alpha=alpha, epsilon_psi=psi, epsilon_chi=chi)

    @property
    def pressure(self) -> float:
        """The uniform reaction that theory puts on the zone: ε(α+ψ) where that presses, else 0."""
        return self.epsilon * float(contact_parameters(self.kappa_over_nu, *self.first).uniform_reaction)


SHOWN = (
    Shown("plain", "no acceleration (ε = 0)"),
    Shown("pressed", "accelerated into the wall (α = 4)", first=(4.0, 0.0, 0.0), epsilon=0.25),
    Shown("released", "decelerated and bending back (α = ψ = −1)", first=(-1.0, -1.0, 0.0), epsilon=0.75),
)


@dataclass(frozen=True)
class ShownImpact:
    """One method's run of an impact; :func:`reduce_history` says what ``data`` holds."""

    shown: Shown
    label: str
    data: Mapping[str, Any]
    settings: Mapping[str, Any]
    warnings: Sequence[str]


def frames() -> Array:
    """τ of the frames, the same for every method: even in √τ, as the front moves."""
    return np.asarray(np.linspace(START, 1.0, FRAMES) ** 2 * END)


def places(shown: Shown) -> Array:
    """x of the drawn points, denser in the zone: the farthest lies well ahead of the front at the end."""
    return np.asarray(np.linspace(0.0, 1.0, POINTS) ** 1.6 * 2.4 * widest(shown))


def widest(shown: Shown) -> float:
    """Half width of the map of forces: a little more than the front ever reaches."""
    reach = float(contact_parameters(shown.kappa_over_nu).lambda0) * np.sqrt(END)
    return 1.3 * max(float(reach), 0.2 * float(np.sqrt(END)))


def show(shown: Shown, method: Method, store: RunStore | None = None) -> ShownImpact:
    """Simulate with ``method`` and reduce, or find it in ``store``. Raises ``ValueError`` for what it refuses."""
    impact = shown.impact
    if reason := method.refuses(impact):
        raise ValueError(reason)
    end = END * impact.time_scale

    def run() -> ImpactHistory:
        fixed = chosen_for(method, impact, end) if shown.epsilon else method
        return fixed.simulate(impact, end_time=end, save=INSTANTS)

    about = [shown.name, shown.kappa_over_nu, *shown.first, shown.epsilon, FRAMES, POINTS, BINS, INSTANTS, END]
    found = kept(store, {"shown": about}, method, partial(reduce_history, shown=shown), run)
    return ShownImpact(shown, method.label, found.reading, settings_of(method), found.warnings)


def _attempted(shown: Shown, method: Method, store: RunStore) -> ShownImpact | str:
    """:func:`show` in a worker; a sentence where it fails."""
    try:
        return show(shown, method, store)
    except ANY_FAILURE as error:
        return f"{method.label}, {shown.title}: {' '.join(str(error).split())}"


def show_all(
    wanted: Sequence[Shown], methods: Sequence[Method], *, store: RunStore, jobs: int = 1, progress: Count | None = None
) -> tuple[list[ShownImpact], list[str]]:
    """Every impact by every method, impact by impact, and a sentence for each that could not be shown."""
    calls = [(shown, method, store) for shown in wanted for method in methods]
    each = run_all(
        _attempted, calls, jobs=jobs, progress=progress,
        on_death=lambda i, why: f"{calls[i][1].label}, {calls[i][0].title}: {why}",
    )  # fmt: skip
    return [e for e in each if isinstance(e, ShownImpact)], [e for e in each if isinstance(e, str)]


@cache
def theory_of(shown: Shown) -> dict[str, Any]:
    """Theory to first order on the same timeline: ``time``, ``x``, ``gap`` over V₀t, ``front``, ``reaction`` (one
    end's), ``pressure``."""
    exact = contact_parameters(shown.kappa_over_nu, *shown.first)
    tau, x = frames(), places(shown)
    root = np.sqrt(tau)
    fields = ImpactFields(exact, shown.epsilon, tolerance=1e-7)
    # at leading order the shape is one function of x/√τ; the first order adds a part in proportion to τ
    times = tau[[0, -1]] if shown.epsilon else tau[:1]
    near = 4.0 * max(float(exact.lambda0), 0.5)  # in front of the contact the shape bends most
    z = np.concatenate([np.linspace(0.0, near, 91), np.geomspace(near, max(x[-1] / root[0], 2.0 * near), 31)[1:]])
    profiles = -fields.beam(z[None, :] * np.sqrt(times)[:, None], times[:, None]).deflection / times[:, None]
    gap = []
    for t, r in zip(tau, root):
        profile = np.array([np.interp(t, times, column) for column in profiles.T])
        gap.append(_short(CubicSpline(z, profile)(x / r)))
    return {
        "time": _short(tau),
        "x": _short(x),
        "gap": gap,
        "front": _short(root * (exact.lambda0 + shown.epsilon * exact.lambda1 * tau)),
        "reaction": _short(np.sqrt(2.0 / np.pi) * (exact.r0 + shown.epsilon * exact.r1 * tau) / root),
        "pressure": shown.pressure,
    }


def reduce_history(history: ImpactHistory, shown: Shown) -> dict[str, Any]:
    """What the page needs of a history, JSON-ready, in units of the fast layer, at the times of :func:`frames`.

    ``gap`` (frames, points) over V₀t, null where no beam was modelled; ``front`` and ``reaction`` (one end's);
    ``pressure`` of the zone; ``lift`` over V₀t; ``map``: force per length in bins of x between kept instants;
    ``energy``: those of :data:`ENERGIES` that the method reports, as changes since the first saved instant.
    """
    impact, found, wanted, x = history.impact, moments(history), frames(), places(shown)
    tau, root = found.tau, np.sqrt(found.tau)
    reaction = np.gradient(found.impulse, root) / (2.0 * np.sqrt(np.maximum(tau, 1e-300)))  # I ~ √τ
    gap = np.zeros((tau.size, x.size))
    for k, t in enumerate(history.time):
        nodes = history.positions(k) / impact.length_scale
        half = nodes >= 0.0  # a full beam is drawn by its right half
        shape = np.interp(x, nodes[half], history.array("gap", k)[half], right=np.nan)
        gap[k] = shape / (impact.velocity * max(t, 1e-300))

    def at(values: Array) -> Array:
        return np.interp(wanted, tau, values)

    even = np.linspace(START, 1.0, FRAMES) ** 2 * history.time[-1]  # in √t
    instants = np.unique(np.maximum(np.abs(history.time[None, :] - even[:, None]).argmin(axis=1), 1))
    edges = np.linspace(0.0, widest(shown), BINS + 1)
    energy = impact.mass_per_length * impact.length_scale * impact.velocity**2
    force = {
        "x": _short(0.5 * (edges[1:] + edges[:-1])),
        "root_time": _short(root[instants][1:]),
        "force": [_short(row) for row in force_map(history, instants, edges)],
    }
    curves = {"front": found.front, "reaction": reaction, "pressure": found.pressure, "lift": found.lift}
    reduced = {
        "gap": [_short(row) for row in np.array([at(column) for column in gap.T]).T],
        **{name: _short(at(values)) for name, values in curves.items()},
        "map": force,
        "energy": {name: _short(at(values) / energy) for name, values in energies(history).items()},
    }
    return dict(plain(reduced))


def energies(history: ImpactHistory) -> dict[str, Array]:
    """Changes of the energies, J, in the frame of the free beam, where the wall moves at v = V₀ + a₀t and does work.
    Against the frame of the wall, kinetic energy and work are greater by v∫R dt less what the free beam gains."""
    changes = {n: history.array(n) - history.array(n)[0] for n in ENERGIES if n in history}
    if "position" in history:  # a mesh that moves carries the waves alone, and is in this frame
        return changes
    p = history.impact
    v, mass = p.velocity + p.acceleration * history.time, 2.0 * p.mass_per_length * history.positions(-1).max()
    shift = v * history.array("total_impulse") - 0.5 * mass * (v**2 - p.velocity**2)
    return changes | {n: changes[n] + shift for n in ("kinetic_energy", "work_of_loads") if n in changes}


def _short(values: Array) -> list[float]:
    """Four significant digits: enough to look at."""
    return [float(f"{v:.4g}") for v in np.asarray(values, float)]


def acceleration_rows(impacts: Sequence[ShownImpact]) -> list[dict[str, str]]:
    """What an acceleration does to a method's contact, at the end of the impact, ready to be shown: a row for each run
    with acceleration whose method ran without it too.

    zone, reaction : change of contact length and end reaction against the same method's run without acceleration;
    uniform, theory : reaction per length in the zone over μV₀/t*; gap : the largest inside the zone, over V₀t.
    """
    plain = {i.label: i for i in impacts if i.shown.epsilon == 0.0}
    rows = []
    for impact in impacts:
        if impact.shown.epsilon == 0.0 or impact.label not in plain:
            continue
        found, base = impact.data, plain[impact.label].data
        change = {name: 100 * (found[name][-1] / base[name][-1] - 1) for name in ("front", "reaction")}
        row = {"impact": f"{impact.shown.title}, ε = {impact.shown.epsilon:g}", "label": impact.label}
        row |= {"zone": true_minus(f"{change['front']:+.0f} %"), "reaction": true_minus(f"{change['reaction']:+.0f} %")}
        row |= {"uniform": true_minus(f"{found['pressure'][-1]:.2f}"), "theory": f"{impact.shown.pressure:.2f}"}
        rows.append(row | {"gap": percent(max(found["lift"]))})
    return rows
