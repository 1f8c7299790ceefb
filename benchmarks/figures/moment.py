"""The largest bending moment at leading order, m = M/(V₀√(EIμ)), over κ/ν: theory's curve and simulated points.

``python -m benchmarks.figures.moment`` measures the points and writes ``docs/figures/peak-moment.png`` with
``peak-moment.json`` beside it. At leading order the moment is constant in time, so the median over the last decade of a
run is one measurement of it; early instants, whose front no mesh resolves, overshoot and are left out. Elements and
damping at their scale cut the crest of the wave ahead of the front, by an amount that falls by the same factor from
resolution to resolution; the factor differs between the paths. So runs at the method's own resolution, half and a
quarter of it are extrapolated by Aitken's rule, and what that adds is the error bar.
"""

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from bent_beam.files import write_atomically
from bent_beam.impact import Impact
from bent_beam.method import Method, refined
from bent_beam.versions import stamp
from comparison.figures import style
from comparison.methods import methods_of
from theory.similarity import peak_moment

KAPPAS = (0.01, 0.05, 0.1, 0.2, 0.5, 0.8, 1.5)
FLATTEST = {"hermite": 0.01, "exudyn": 0.05}  # κ/ν of the flattest contact whose front a path's own mesh resolves
PATHS = tuple(FLATTEST)
END = 0.1  # τ
INSTANTS = 60
SLOWEST = 0.7  # factor between differences from which on they say nothing about a limit
FOLDER = Path(__file__).resolve().parents[2] / "docs" / "figures"


@dataclass(frozen=True)
class MeasuredMoment:
    """m extrapolated from the method's own resolution, its error bar (the difference from the own one, and the spread
    in time), and theory's."""

    label: str
    kappa_over_nu: float
    value: float
    error: float
    theory: float


def measure_moment(method: Method, kappa_over_nu: float) -> MeasuredMoment:
    """m of the leading order at κ/ν, from runs at the method's own resolution, half and a quarter of it."""
    quarter, half = (refined(method, factor) for factor in (0.25, 0.5))
    (coarsest, _), (coarse, _), (own, spread) = (_late_moment(m, kappa_over_nu) for m in (quarter, half, method))
    value = aitken(coarsest, coarse, own)
    theory = float(peak_moment(kappa_over_nu).largest)
    return MeasuredMoment(method.label, kappa_over_nu, value, abs(value - own) + spread, theory)


def aitken(first: float, second: float, third: float) -> float:
    """The limit of three values whose differences fall by one factor; the last where they do not fall
    (:data:`SLOWEST`)."""
    factor = (third - second) / (second - first) if second != first else 0.0
    return third + (third - second) * factor / (1.0 - factor) if 0.0 < factor < SLOWEST else third


def _late_moment(method: Method, kappa_over_nu: float) -> tuple[float, float]:
    """Median of the largest moment anywhere over the last decade of a run, V₀√(EIμ), and half its spread there."""
    impact = Impact.dimensionless(kappa_over_nu)
    times = np.geomspace(0.1, 1.0, INSTANTS) * END * impact.time_scale
    history = method.simulate(impact, end_time=float(times[-1]), save=times)
    unit = impact.velocity * np.sqrt(impact.bending_stiffness * impact.mass_per_length)
    late = range(int(np.searchsorted(history.time, 0.1 * END * impact.time_scale * (1.0 - 1e-9))), history.time.size)
    sizes = np.array([np.abs(history.bending_moments(k)[0]).max() for k in late]) / unit
    low, high = np.quantile(sizes, [0.05, 0.95])
    return float(np.median(sizes)), float(0.5 * (high - low))


def draw_moments(found: Sequence[MeasuredMoment], out: Path) -> list[Path]:
    """``peak-moment``: theory's curve with the points, and their difference in per cent."""
    marks = style.marks(m.label for m in found)
    ratio = np.geomspace(0.008, 2.0, 300)
    theory = peak_moment(ratio)
    with style.figure(1, 2, width=style.PAGE, height=2.7) as (fig, (left, right)):
        left.semilogx(ratio, theory.largest, **style.THEORY)
        left.semilogx(ratio, theory.at_contact, color="black", lw=0.8, ls="--", label="in the contact zone")
        spreads = ratio < 1.0
        left.semilogx(ratio[spreads], theory.ahead[spreads], color="black", lw=0.8, ls=":", label="ahead of the zone")
        right.axhline(0.0, **{**style.THEORY, "label": None})
        for i, (label, mark) in enumerate(marks.items()):
            mine = [m for m in found if m.label == label]
            x = np.array([m.kappa_over_nu for m in mine])
            left.plot(x, [m.value for m in mine], **mark)
            percent = [100.0 * (m.value / m.theory - 1.0) for m in mine]
            bars = [100.0 * m.error / m.theory for m in mine]
            style.bars(right, x * 1.04 ** (i - 0.5 * (len(marks) - 1)), percent, bars, mark)
        left.set(xlabel=r"$\kappa/\nu$  (1)", ylabel=r"$M/(V_0\sqrt{EI\mu})$  (1)", ylim=(0.0, 1.12))
        right.set(xlabel=r"$\kappa/\nu$  (1)", ylabel="difference  (%)", xscale="log")
        left.legend()
        right.legend()
        style.label_panels(left, right)
        return style.save(fig, out, "peak-moment")


def _main() -> None:
    asked = [(method, kappa) for method in methods_of(PATHS) for kappa in KAPPAS if kappa >= FLATTEST[method.path]]
    found = [measure_moment(method, kappa) for method, kappa in asked]
    for m in found:
        print(f"{m.label:14s} {m.kappa_over_nu:6g}  {m.value:.5f} ± {m.error:.1g}  theory {m.theory:.5f}")
    document = {**stamp("python -m benchmarks.figures.moment"), "points": [asdict(m) for m in found]}
    write_atomically(FOLDER / "peak-moment.json", json.dumps(document, indent=1) + "\n")
    print(*draw_moments(found, FOLDER))


if __name__ == "__main__":
    _main()
