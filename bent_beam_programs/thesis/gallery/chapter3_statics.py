"""Chapter 3, sections 3.1 and 3.2: statics of the Hermite beam, the bouncing ball; and the shape functions (A.6)."""

import numpy as np

from bent_beam_programs.thesis.gallery.drawing import NIL, plain_line
from bent_beam_programs.thesis.sheet import Sheet, item, items
from comparison.figures import style
from hermite_fe import INTEGRATORS
from hermite_fe.beam import HermiteBeam, shape_functions
from hermite_fe.constraints import ContactLaw
from hermite_fe.run import integrate
from hermite_fe.system import ContactRows, System
from theory.ladder import BouncingBall

LENGTH, STIFFNESS, ELEMENTS = 5.0, 9.345e3, 52
NODES = np.linspace(0.0, LENGTH, ELEMENTS + 1)
AXIS_STIFFNESS = 500.0 * STIFFNESS  # EI, N m², that fits the axes of both figures; captions print a 500th of it
PRINTED = (
    "Drawn with EI = 4.67·10⁶ N m², which fits the thesis's axis; with the printed EI = 9.345·10³ N m² the deflection "
    "would be five hundred times as large, against both printed axes. Hermite elements are exact at the nodes"
)
GRAVITY, HEIGHT, RESTITUTION = 9.81, 0.5, 0.9


def static(sheet: Sheet, force: float, node: int, supports: dict[int, float], shape: np.ndarray) -> None:
    """Deflection of 52 elements under a nodal force against the exact one at the nodes, P/EI times ``shape`` (m³)."""
    exact = force * shape / AXIS_STIFFNESS
    beam = HermiteBeam(NODES, AXIS_STIFFNESS, 1.0)
    found = beam.static(force * (np.arange(beam.dofs) == 2 * node), supports)[0::2]
    with sheet.figure() as (_, axis):
        axis.set(xlabel="$x$  (m)", ylabel="$w$  (m)", xlim=(0, LENGTH))
        sheet.line(axis, beam.nodes, -exact, series="theory", **style.THEORY)
        sheet.line(axis, beam.nodes, -found, series="Hermite", **style.mark("hermite"), markevery=2)
        axis.legend()
    largest = float(np.abs(exact).max())
    sheet.numbers |= {
        "largest deflection (m)": largest,
        "largest deflection with the printed EI (m)": 500.0 * largest,
        "relative error at the nodes": float(np.abs(found - exact).max() / largest),
    }


FROM_SUPPORT = np.minimum(NODES, LENGTH - NODES)
items(__name__, static, (
    ("fig-3.3", "Deflection of a beam on two supports",
     f"Beam on two supports, L = 5 m, P = 5·10⁵ N in the middle, 52 elements, against (3.1.12). {PRINTED}. The "
     'thesis\'s caption says "encastre"; its text blocks the deflection alone, as here.',
     5e5, ELEMENTS // 2, {0: 0.0, 2 * ELEMENTS: 0.0},
     FROM_SUPPORT * (3.0 * LENGTH**2 - 4.0 * FROM_SUPPORT**2) / 48.0),
    ("fig-3.5", "Deflection of a cantilever",
     f"Cantilever clamped at x = L, P = 8·10⁵ N at x = 0, L = 5 m, 52 elements, against (3.1.15). {PRINTED}.",
     8e5, 0, {2 * ELEMENTS: 0.0, 2 * ELEMENTS + 1: 0.0},
     NODES**3 / 6.0 - LENGTH**2 * NODES / 2.0 + LENGTH**3 / 3.0),
))  # fmt: skip


def ball(step: float, end: float) -> tuple[np.ndarray, np.ndarray]:
    """Times (s) and heights (m) of the ball by Moreau–Jean with θ = 1 (implicit Euler)."""
    contacts = ContactRows(dofs=np.array([[0]]), factors=np.array([[1.0]]), gap=np.zeros(1))
    system = System(np.ones((1, 1)), np.zeros((1, 1)), load=np.array([[-GRAVITY]]), contacts=contacts)
    scheme = INTEGRATORS["moreau_jean"](time_step=step, theta=1.0)
    save = [float(t) for t in np.arange(round(end / step) + 1) * step]
    run = integrate(system, np.array([HEIGHT]), np.zeros(1), scheme, end, law=ContactLaw(RESTITUTION), save=save)
    return run.time, run.q[:, 0]


def predicting_ball(step: float, instants: int) -> np.ndarray:
    """Heights (m) by the thesis's algorithm (3.2): where a step of implicit Euler would end in the wall, the impact law
    turns the velocity round, and the step is taken with it."""
    height, velocity, found = HEIGHT, 0.0, [HEIGHT]
    for _ in range(instants - 1):
        fallen = velocity - GRAVITY * step
        velocity = fallen if height + step * fallen > 0.0 else -RESTITUTION * velocity
        height += step * velocity
        found.append(height)
    return np.array(found)


@item("fig-3.6")
def bouncing(sheet: Sheet) -> None:
    """Bouncing ball

    Bouncing ball, q₀ = 0.5 m, v₀ = 0, h = 10⁻³ s, restitution 0.9, Moreau–Jean with implicit Euler: the law acts on
    velocities, so positions drift by up to a step (zoom on the right). The thesis tests the position that a step would
    reach, and its ball turns above the wall (vermilion); Hermite's Moreau–Jean tests the gap before the step, and the
    ball may turn inside it (blue). Smaller steps bring both to the wall.
    """
    times, height = ball(1e-3, 3.0)
    predicted = predicting_ball(1e-3, times.size)
    flight = BouncingBall(HEIGHT, gravity=GRAVITY, restitution=RESTITUTION)
    bounces = flight.impact_time(np.arange(1, 61))
    dense = np.unique(np.concatenate([np.linspace(0.0, 3.0, 3001), bounces[bounces <= 3.0]]))
    exact = np.where(np.isin(dense, bounces), 0.0, flight.position(dense))
    with sheet.figure(1, 2, height=2.5, texts=["", "zoom"], legend=3) as (_, axes):
        for axis, marker in zip(axes, ("", ".")):
            axis.set(xlabel="$t$  (s)", ylabel="$q$  (m)")
            sheet.line(axis, dense, exact, series="theory", **style.THEORY)
            for series, y, colour in (("position predicted", predicted, "vermilion"), ("Moreau–Jean", height, "blue")):
                sheet.line(axis, times, y, series=series, **plain_line(colour, width=0.9, marker=marker, ms=4))
        hit = float(np.sqrt(2.0 * HEIGHT / GRAVITY))
        axes[0].set(xlim=(0, 3), ylim=(0, 0.52))
        axes[1].set(xlim=(hit - 0.012, hit + 0.012), ylim=(-0.005, 0.04))
        axes[1].axhline(0.0, **NIL)
    first = (times > 0.2) & (times < 0.5)
    sheet.numbers["lowest height at the first bounce (m)"] = float(height[first].min())
    sheet.numbers["the same, position predicted (m)"] = float(predicted[first].min())
    sheet.numbers["way of a step (m)"] = hit * GRAVITY * 1e-3


@item("fig-A.1")
def shapes(sheet: Sheet) -> None:
    """Hermite shape functions

    Cubic Hermite shape functions N₁ … N₄ (A.6.1–4) over ξ = x/l_e; N₂ = l_e ξ(1 − ξ)² and N₄ = l_e ξ²(ξ − 1) over l_e.
    """
    xi = np.linspace(0.0, 1.0, 101)
    with sheet.figure(2, 2, width=4.6, height=3.6, sharex=True) as (_, axes):
        for i, (axis, values) in enumerate(zip(axes.flat, shape_functions(xi, 1.0).T), 1):
            axis.set(ylabel=f"$N_{i}$  (1)" if i % 2 else f"$N_{i}/l_e$  (1)", xlim=(0, 1))
            axis.set_xlabel(r"$\xi$  (1)" if i > 2 else "")
            sheet.line(axis, xi, values, series=f"N{i}", **style.THEORY)
