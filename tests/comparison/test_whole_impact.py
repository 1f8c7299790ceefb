"""The whole impact: from the first touch, through waves back from the ends, to the last separation."""

import dataclasses
import json
import math
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest

from bent_beam.free_flight import cannot_return, has_left
from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from bent_beam.meshes import UniformMesh
from bent_beam.method import for_whole_beam, method_from_tables
from comparison.bounce import bounce, bounce_document, problem
from comparison.command_line.app import run
from comparison.whole_impact import damped, ends, map
from comparison.whole_impact.hits import hits
from comparison.whole_impact.number import NUMBERS
from comparison.whole_impact.outcome import pushes, whole_impact
from comparison.whole_impact.prediction_errors import PredictionErrors, prediction_errors, random_problem
from comparison.whole_impact.stored_map import bounce_from_map, stored_map
from hermite_fe import HermiteFE
from hermite_fe.integrators import MoreauJean, NonsmoothGeneralizedAlpha, SignoriniPosition
from hermite_fe.whole_beam import ELEMENTS
from theory import contact_parameters, damped_zone
from theory.stopped_beam import StoppedBeam
from theory.validity import ends_errors

SCHEMES = [MoreauJean(theta=0.5), NonsmoothGeneralizedAlpha(), SignoriniPosition(theta=0.5)]
PATHS = ["hermite", "exudyn"]
COARSE = HermiteFE(mesh=UniformMesh(1.0 / 50))


def released(elements: int, step: float, integrator: object) -> tuple[float, float]:
    """Steps between the first release and the exact one, and the error of the impulse at that time (κ/ν = 2).

    Signorini's condition at position level with θ = ½ turns the velocity of a closed row in each step; its impulses
    alternate, and the reaction is their mean over two steps. So the wall lets go in the middle of the first two steps
    without a push.
    """
    exact = StoppedBeam(1e-3).release()
    h = step / elements**2
    method = HermiteFE(mesh=UniformMesh(1.0 / elements), integrator=dataclasses.replace(integrator, time_step=h))  # type: ignore[type-var]
    impact = Impact.whole_beam(2.0, relative_damping=1e-3)
    count = round(0.0825 / h)
    times = h * np.arange(round(0.078 / h), count + 1)
    history = method.for_whole_beam(impact).simulate(impact, end_time=count * h, save=times)
    impulse = history.array("total_impulse")[1:]
    stopped = int(np.argmax(impulse[2:] - impulse[:-2] <= 0.0))
    error = float(np.interp(exact.time, history.time[1:], impulse)) - exact.impulse
    return (history.time[2 + stopped] - exact.time) / h, error


@pytest.mark.parametrize("integrator", SCHEMES, ids=lambda scheme: type(scheme).__name__)
def test_first_release_and_impulse_until_then_are_the_stopped_beam_s(integrator: object) -> None:
    steps, error = released(50, 1.0, integrator)
    assert abs(steps) <= 2.0
    assert abs(error) < 4e-4


@pytest.mark.verify
@pytest.mark.parametrize("integrator", SCHEMES, ids=lambda scheme: type(scheme).__name__)
def test_impulse_until_the_first_release_is_exact_to_one_in_a_hundred_thousand(integrator: object) -> None:
    steps, error = released(200, 0.5, integrator)
    assert abs(steps) <= 2.0
    assert abs(error) < 1e-5


@pytest.mark.parametrize("integrator", SCHEMES, ids=lambda scheme: type(scheme).__name__)
def test_a_damped_point_contact_bounces_with_a_restitution_that_no_scheme_changes(integrator: object) -> None:
    impact = Impact.whole_beam(2.0, relative_damping=1e-2)
    history = dataclasses.replace(COARSE, integrator=integrator).simulate_to_separation(impact)
    found = whole_impact(history)
    assert found.left
    assert found.restitution == pytest.approx(0.5663, abs=3e-4)
    assert found.translation + found.vibration + found.dissipated == pytest.approx(1.0, abs=1e-6)
    assert found.energy_defect < 1e-9
    assert found.energy_gain == 0.0
    assert history.array("loss_material")[-1] > 0.3


@pytest.mark.verify
@pytest.mark.parametrize("integrator", SCHEMES, ids=lambda scheme: type(scheme).__name__)
@pytest.mark.parametrize(
    ("kappa", "damping", "restitution", "within"),
    [
        (2.0, 1e-2, 0.56630, 1e-4),
        (1.5, 1e-3, 0.6161, 2e-4),
        (0.5, 1e-3, 0.4563, 5e-4),
        (0.5, 1e-2, 0.3364, 2e-4),
        (0.7, 1e-2, 0.4740, 5e-4),
        (1.2, 3e-3, 0.6108, 2e-4),
        (4.0, 1e-3, 0.616598, 1e-4),  # by modes
        (0.4, 1e-2, 0.2747, 3e-4),
    ],
)
def test_restitution_converges_whatever_the_scheme(
    integrator: object, kappa: float, damping: float, restitution: float, within: float
) -> None:
    elements = 400 if (kappa, damping) in ((0.5, 1e-3), (0.7, 1e-2)) else 200
    method = HermiteFE(mesh=UniformMesh(1.0 / elements), integrator=integrator)  # type: ignore[arg-type]
    history = method.simulate_to_separation(Impact.whole_beam(kappa, relative_damping=damping))
    found = whole_impact(history)
    assert found.restitution == pytest.approx(restitution, abs=within)
    assert found.energy_defect < 1e-6
    assert found.energy_gain < 1e-6


def test_a_beam_that_cannot_return_does_not_return() -> None:
    impact = Impact.whole_beam(0.5, relative_damping=1e-2)
    history = COARSE.simulate_to_separation(impact)
    assert has_left(history)
    later = COARSE.for_whole_beam(impact).simulate(impact, end_time=3.0, save=200)
    assert later.array("total_impulse")[-1] == pytest.approx(history.array("total_impulse")[-1], rel=1e-6)


def test_a_beam_that_swings_wider_than_it_is_away_may_return() -> None:
    impact = Impact.whole_beam(2.0)
    x = np.linspace(0.0, 1.0, 101)
    flat, up = 0.5 * 2.0 * x**2, -0.5 * np.ones_like(x)
    rigid = 0.5 * 2.0 * 0.5**2
    reach = math.sqrt(2.0 * 0.1 * 8.0 / 105.0)
    assert cannot_return(impact, x, flat + 1.01 * reach, up, rigid + 0.1)
    assert not cannot_return(impact, x, flat + 0.99 * reach, up, rigid + 0.1)
    assert not cannot_return(impact, x, flat + 1.01 * reach, -up, rigid + 0.1)
    assert not cannot_return(impact.replace(acceleration=1.0), x, flat + 9.0, up, rigid)


def test_breaks_shorter_than_the_shortest_separation_are_none() -> None:
    impulse = np.array([0.0, 1.0, 2.0, 2.0, 3.0, 3.0, 3.0, 3.0, 4.0, 4.0])
    time = np.arange(10.0)
    assert pushes(time, impulse, 0.5) == [(0, 2), (3, 4), (7, 8)]
    assert pushes(time, impulse, 2.0) == [(0, 4), (7, 8)]
    assert pushes(time, impulse, 9.0) == [(0, 8)]
    assert pushes(time, np.zeros(10), 1.0) == []


def pushed_until(end: float, last: float = 2.0) -> ImpactHistory:
    """A rigid beam that the wall pushes from first touch to ``end``, T*, at 5.8 μℓV₀ a T*; saved until ``last``, T*."""
    time, x = np.linspace(0.0, last, 41), np.linspace(0.0, 1.0, 5)
    impulse = np.zeros((time.size, x.size))
    impulse[:, 0] = 2.9 * np.minimum(time, end)
    away = np.maximum(time[:, None] - end, 0.0) * np.ones(x.size)
    fields = {
        "gap": (("time", "x"), away),
        "velocity": (("time", "x"), -np.ones(away.shape)),
        "slope": (("time", "x"), np.zeros(away.shape)),
        "impulse": (("time", "contact"), impulse),
        "total_impulse": (("time",), 2.0 * impulse[:, 0]),
        "kinetic_energy": (("time",), np.ones(time.size)),
        "strain_energy": (("time",), np.zeros(time.size)),
    }
    return ImpactHistory.build(
        impact=Impact.whole_beam(2.0), path="bare", symmetry="half", settings={}, time=time, x=x, contact_x=x,
        fields=fields,
    )  # fmt: skip


def test_a_path_that_knows_no_loads_has_hits_and_a_whole_impact() -> None:
    history = pushed_until(0.5)
    (hit,), found = hits(history), whole_impact(history)
    assert (hit.impulse, hit.energy, hit.lost) == (2.9, 1.0, 0.0)
    assert found.restitution == pytest.approx(0.45) and found.midspan_moment == 2.0 and found.energy_gain == 0.0


@pytest.mark.parametrize(("path", "elements", "widest"), [("hermite", 50, 0.02), ("exudyn", 20, 0.03)])
def test_error_bars_of_a_bounce_hold_the_converged_value(path: str, elements: int, widest: float) -> None:
    method = dataclasses.replace(method_from_tables(path, {}), mesh=UniformMesh(1.0 / elements))
    found = bounce(problem(0.5, 1e-2), method)
    restitution = found.numbers["restitution"]
    assert set(restitution.parts) == {"mesh", "step", "contact_law"}
    assert restitution.value is not None and restitution.error is not None
    assert abs(restitution.value - 0.33636) <= restitution.error < widest
    document = bounce_document(found)
    assert json.loads(json.dumps(document)) == document
    assert document["si"]["impulse"]["value"] == pytest.approx(2.0 * (1.0 + restitution.value))


def test_without_damping_a_seeded_band_takes_the_place_of_a_number() -> None:
    first, again = (bounce(problem(2.0, 0.0), COARSE, runs=2, save=500, seed=3) for _ in range(2))
    assert first.numbers["restitution"].to_dict() == again.numbers["restitution"].to_dict()
    band = first.numbers["restitution"]
    assert (band.value, band.error, band.runs) == (None, None, 2)
    assert band.mean == pytest.approx(0.6, abs=0.1)
    assert any("no damping" in warning and "band" in warning for warning in first.warnings)
    told: list[tuple[int, int]] = []
    last = bounce(problem(2.0, 0.0), COARSE, runs=2, save=500, seed=4, progress=lambda *at: told.append(at))
    assert last.numbers["restitution"].mean != band.mean
    assert told == [(0, 2), (1, 2), (2, 2)]  # complete when all runs are
    document = bounce_document(first)
    assert document["seed"] == 3
    assert document["restitution"] == {
        "value": None,
        "error": None,
        "band": {"mean": band.mean, "std": band.std, "runs": 2},
    }


@pytest.mark.parametrize("path", PATHS)
def test_an_ensemble_draws_elements_steps_and_contact_from_its_seed(path: str) -> None:
    impact = problem(2.0, 0.0)
    first, again = (
        [method_from_tables(path, {}).varied(impact, random) for _ in range(6)]
        for random in (np.random.default_rng(7), np.random.default_rng(7))
    )
    assert first == again
    for part in ("mesh", "integrator", "contact"):
        assert len({str(getattr(method, part)) for method in first}) > 1


def test_only_the_length_of_a_contact_that_has_none_may_be_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    def answer(missing: int) -> Any:
        values = np.where(np.arange(3) == missing, np.nan, 0.25)
        return lambda kappa, load, ages, element: np.outer(values, np.ones(ages.size))

    monkeypatch.setattr(damped, "_answer", answer(0))
    found = damped.measure_loads(0.5)
    assert np.all(found[:, 0] == 0.0) and np.all(found[:, 1:] == 0.25)
    for missing in (1, 2):
        monkeypatch.setattr(damped, "_answer", answer(missing))
        with pytest.raises(FloatingPointError, match=r"not finite at kappa/nu = 0\.5"):
            damped.measure_loads(0.5)


@dataclasses.dataclass(frozen=True)
class Bare:
    """Somebody's method without choices for the whole beam, nor for an ensemble."""

    label: str = "bare"
    path: ClassVar[str] = "bare"

    def refuses(self, impact: Impact) -> str | None:
        return None


def test_a_method_that_varies_nothing_gives_no_band_and_no_number_without_damping() -> None:
    with pytest.raises(ValueError, match="bare varies neither"):
        bounce(problem(2.0, 0.0), Bare())  # type: ignore[arg-type]


@dataclasses.dataclass(frozen=True)
class Scripted(Bare):
    """Its beam leaves at 0.5 T*; with ``other``, as its cross-check and some of an ensemble, much later."""

    other: bool = False

    def for_whole_beam(self, impact: Impact) -> "Scripted":
        return self

    def simulate_to_separation(self, impact: Impact, **_: Any) -> ImpactHistory:
        return pushed_until(9.0 if self.other else 0.5)

    def cross_checks(self, impact: Impact) -> dict[str, "Scripted"]:
        return {"step": Scripted(other=True)}

    def varied(self, impact: Impact, random: np.random.Generator) -> "Scripted":
        return Scripted(other=bool(random.random() < 0.5))


@pytest.mark.parametrize("damping", [1e-3, 0.0])
def test_a_single_run_that_ends_at_the_wall_is_told_with_the_numbers_that_it_enters(damping: float) -> None:
    found = bounce(problem(2.0, damping), Scripted(), runs=4, seed=0)  # type: ignore[arg-type]
    assert found.outcome.left and not found.left
    assert bounce_document(found)["left"] is False
    assert any("not left the wall" in warning for warning in found.warnings)


BEAM = """
[section]
kind = "rectangle"
width = 0.03
thickness = 0.001
youngs_modulus = 2.1e11
density = 7850.0
[beam]
length = 1.0
curvature = 0.05
damping = {damping}
[impact]
velocity = 0.05
[mesh]
kind = "uniform"
element_length = {element}
{more}
"""
def case(folder: Path, damping: float = 1e-3, element: float = 0.025, more: str = "") -> str:
    """A steel ruler's case file."""
    file = folder / "ruler.toml"
    file.write_text(BEAM.format(damping=damping, element=element, more=more))
    return str(file)


def document_of(capsys: pytest.CaptureFixture[str], *arguments: str) -> dict[str, Any]:
    code = run([*arguments, "--json"])
    out = capsys.readouterr()
    assert code == 0, out.err
    return dict(json.loads(out.out))


@pytest.mark.parametrize("path", PATHS)
def test_a_run_until_separation_ends_off_the_wall_on_either_path(
    path: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    kept = tmp_path / "run.nc"
    file = case(tmp_path)
    found = document_of(capsys, "simulate", file, "--path", path, "--until", "separation", "--out", str(kept))
    history = ImpactHistory.load(kept)
    assert has_left(history)
    assert history.array("gap")[-1].min() > 0.0
    assert found["time"] == history.time[-1] < 3.0 * history.impact.slow_time_scale
    assert abs(found["energy"]["defect"]) < 1e-5 * found["energy"]["initial"]
    mass = history.impact.mass_per_length * history.impact.length
    assert 1.1 < found["total_impulse"]["value"] / (mass * history.impact.velocity) < 2.0
    assert found["hits"] is None


def test_largest_stress_is_that_of_the_largest_moment_with_the_same_bar(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    found = document_of(capsys, "bounce", case(tmp_path))
    moment, stress = found["si"]["peak_moment"], found["peak_stress"]
    modulus = 0.03 * 0.001**2 / 6.0
    assert stress["value"] == pytest.approx(moment["value"] / modulus, rel=1e-12)
    assert stress["error"] == pytest.approx(moment["error"] / modulus, rel=1e-12)
    assert found["si"]["peak_moment_time"]["value"] > 0.0
    assert 0.0 <= found["si"]["peak_moment_place"]["value"] <= 0.5
    assert run(["bounce", case(tmp_path)]) == 0
    assert "largest stress" in capsys.readouterr().out


def test_an_impact_off_the_middle_by_nothing_is_that_of_the_half_beam() -> None:
    impact = Impact.whole_beam(0.5, relative_damping=1e-2)
    full = COARSE.simulate(impact.replace(first_touch=1e-12), end_time=0.2, save=50)
    half = COARSE.for_whole_beam(impact).simulate(impact, end_time=0.2, save=50)
    assert full.dataset.attrs["symmetry"] == "full"
    assert full.array("total_impulse")[-1] == pytest.approx(half.array("total_impulse")[-1], rel=1e-9)


def test_a_rocking_beam_keeps_momentum_and_energy() -> None:
    impact = Impact.whole_beam(0.5, relative_damping=1e-2).replace(rotation=0.5, first_touch=0.2)
    history = COARSE.simulate(impact, end_time=0.4, save=400)
    x, velocity = history.positions(0), history.array("velocity")
    carried = np.trapezoid(velocity, x, axis=1)
    assert carried + history.array("total_impulse") == pytest.approx(2.0, abs=2e-3)
    spin = np.trapezoid(velocity * x, x, axis=1) + history.array("impulse") @ history.contact_positions(0)
    assert spin == pytest.approx(spin[0], abs=2e-3)
    assert history.array("kinetic_energy")[0] == pytest.approx(1.0 + 0.5**2 / 3.0, rel=1e-3)
    assert abs(history.energy_budget()["defect"]) < 1e-9
    assert history.array("gap").min() > -1e-9


def test_a_beam_that_would_rock_off_before_it_touches_is_refused() -> None:
    impact = Impact.whole_beam(0.5).replace(rotation=-3.0, first_touch=0.5)
    assert "rotation" in str(HermiteFE().refuses(impact))


def test_between_two_walls_the_beam_goes_back_and_forth() -> None:
    method = HermiteFE(mesh=UniformMesh(1.0 / 20))
    impact = Impact.whole_beam(0.5, relative_damping=1e-2).replace(opposite_wall=0.6)
    history = method.simulate(impact, end_time=8.0, save=np.linspace(0.0, 8.0, 1601)[1:])
    found = hits(history)
    assert [hit.wall for hit in found[:3]] == ["front", "opposite", "front"]
    after = [1.0, *(hit.velocity for hit in found)]
    signs = {"front": -1.0, "opposite": 1.0}
    for before, hit, now in zip(after, found, after[1:]):
        assert 2.0 * (now - before) == pytest.approx(signs[hit.wall] * hit.impulse, rel=1e-9)
        assert hit.lost > 0.0
    assert (history.array("gap").min(), history.array("gap").max()) == pytest.approx((0.0, 0.6), abs=5e-3)
    assert abs(history.energy_budget()["defect"]) < 1e-9


@pytest.mark.parametrize("path", PATHS)
def test_hits_between_two_walls_are_listed_and_no_separation_is_the_last(
    path: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    file = case(tmp_path, damping=1e-2, element=0.05, more="[wall]\nopposite = 0.01\n")
    found = document_of(capsys, "simulate", file, "--path", path, "--set", "run.end_time=0.5", "--save", "2000")
    assert [hit["wall"] for hit in found["hits"][:2]] == ["front", "opposite"]
    assert all(hit["impulse"] > 0.0 and hit["lost"] > 0.0 for hit in found["hits"][:2])
    assert run(["simulate", file, "--path", path, "--until", "separation"]) == 2
    assert "opposite_wall" in capsys.readouterr().err


@pytest.mark.verify
@pytest.mark.parametrize(("path", "elements", "closes"), [("hermite", 40, 1e-6), ("exudyn", 10, 1e-3)])
def test_ten_hits_between_two_walls(path: str, elements: int, closes: float) -> None:
    impact = Impact.whole_beam(1.5, relative_damping=1e-3).replace(opposite_wall=1.0)
    method = dataclasses.replace(method_from_tables(path, {}), mesh=UniformMesh(1.0 / elements))
    history = for_whole_beam(method, impact).simulate(impact, end_time=60.0, save=np.linspace(0.0, 60.0, 24001)[1:])
    found = hits(history)
    assert len(found) >= 10
    assert {hit.wall for hit in found} == {"front", "opposite"}
    after = [1.0, *(hit.velocity for hit in found)]
    signs = {"front": -1.0, "opposite": 1.0}
    for before, hit, now in zip(after, found, after[1:]):
        assert 2.0 * (now - before) == pytest.approx(signs[hit.wall] * hit.impulse, rel=1e-6, abs=1e-9)
        assert hit.lost > -1e-9
    assert sum(hit.lost for hit in found) < 1.0
    assert abs(history.energy_budget()["defect"]) < closes


@pytest.mark.verify
def test_both_paths_give_the_first_hits_between_two_walls_alike() -> None:
    """Later ones are not comparable: which part of a vibrating beam meets a wall when is chaotic."""
    impact = Impact.whole_beam(1.5, relative_damping=1e-2).replace(opposite_wall=1.0)
    found = []
    for path in PATHS:
        method = dataclasses.replace(method_from_tables(path, {}), mesh=UniformMesh(1.0 / 50))
        history = for_whole_beam(method, impact).simulate(
            impact, end_time=6.0, save=np.linspace(0.0, 6.0, 6001)[1:]
        )
        found.append(hits(history)[:3])
    for one, other in zip(*found):
        assert one.wall == other.wall
        assert one.impulse == pytest.approx(other.impulse, rel=5e-3)
        assert one.velocity == pytest.approx(other.velocity, abs=5e-3)
        assert one.lost == pytest.approx(other.lost, abs=5e-3)


def test_the_map_holds_its_points_and_lies_between_them() -> None:
    table = stored_map()
    point = next(p for p in table["points"] if (p["kappa_over_nu"], p["damping"]) == (2.0, 1e-2))
    found = bounce_from_map(2.0, 1e-2)
    assert found is not None
    for name in NUMBERS:
        assert found[name].value == pytest.approx(point["numbers"][name][0], rel=1e-12)
        assert found[name].error == pytest.approx(point["numbers"][name][1], rel=1e-12)
    assert found["restitution"].value == pytest.approx(0.5663, abs=1e-4)
    between = bounce_from_map(0.447, 1e-2)
    assert between is not None and between["restitution"].value is not None and between["restitution"].error is not None
    low, high = (bounce_from_map(kappa, 1e-2) for kappa in (0.4, 0.5))
    assert low is not None and high is not None
    sides = sorted(float(side["restitution"].value or 0.0) for side in (low, high))
    assert sides[0] < between["restitution"].value < sides[1]
    assert between["restitution"].error > max(low["restitution"].error or 0.0, high["restitution"].error or 0.0)
    assert bounce_from_map(0.01, 1e-2) is None
    assert bounce_from_map(1.0, 1.0) is None
    faint, none = bounce_from_map(0.5, 1e-5), bounce_from_map(0.5, 0.0)
    assert faint is not None and faint == none and faint["restitution"].runs == 24
    far, point_contact = bounce_from_map(math.inf, 1e-2), bounce_from_map(1e3, 1e-2)
    assert far is not None and point_contact is not None
    assert far["restitution"] == point_contact["restitution"]


def test_points_of_another_path_on_the_map_agree_within_their_bars() -> None:
    table = stored_map()
    assert len(table["others"]) >= 8
    at = {(p["damping"], p["kappa_over_nu"]): p["numbers"] for p in table["points"]}
    for other in table["others"]:
        here = at[other["damping"], other["kappa_over_nu"]]
        for name in ("restitution", "translation", "dissipated"):
            (value, error), (reference, bar) = other["numbers"][name], here[name]
            assert abs(value - reference) <= error + bar, (other["kappa_over_nu"], other["damping"], name)


def test_energy_of_every_point_of_the_map_is_closed_and_every_beam_has_left() -> None:
    for point in stored_map()["points"]:
        assert point["left"], point
        assert point["energy_defect"] < 1e-6
        shares = sum(point["numbers"][name][0] for name in ("translation", "vibration", "dissipated"))
        assert shares == pytest.approx(1.0, abs=1e-6)


@pytest.mark.verify
def test_numbers_between_the_points_of_the_map_lie_within_their_bars() -> None:
    random = np.random.default_rng(20)
    for _ in range(8):
        kappa, damping = math.exp(random.uniform(math.log(0.3), math.log(3.0))), 10.0 ** random.uniform(-3.5, -1.0)
        integrator = SignoriniPosition(theta=0.5, time_step=1.0 / ELEMENTS**2)
        run = HermiteFE(integrator=integrator).simulate_to_separation(problem(kappa, damping))
        found, said = whole_impact(run), bounce_from_map(kappa, damping)
        assert said is not None
        for name in ("restitution", "translation", "dissipated"):
            value, error = said[name].value, said[name].error
            assert value is not None and error is not None
            assert abs(getattr(found, name) - value) <= error, (kappa, damping, name)


@pytest.mark.verify
@pytest.mark.parametrize(
    ("kappa", "damping"), [(0.05, 1e-2), (0.1, 1e-1), (0.2, 1e-2), (0.6, 3e-3), (1.0, 1e-3), (1.2, 1e-3), (4.0, 1e-4)]
)
def test_points_of_the_map_hold_what_finer_elements_and_another_scheme_give(kappa: float, damping: float) -> None:
    """Half as long again as the map's elements are these, shorter the steps, and Signorini's law is at velocity level:
    what that gives lies within the map's bars, not within these and bars of its own."""
    point = next(point for point in map.grid() if point[1:3] == (kappa, damping))
    elements = round(1.5 * point.refine * ELEMENTS)
    step = 0.35 / elements**2
    method = HermiteFE(mesh=UniformMesh(1.0 / elements), integrator=MoreauJean(theta=0.5, time_step=step))
    found = whole_impact(method.simulate_to_separation(problem(kappa, damping)))
    stored = next(
        p["numbers"] for p in stored_map()["points"] if (p["kappa_over_nu"], p["damping"]) == (kappa, damping)
    )
    for name in ("restitution", "impulse", "peak_moment", "translation", "dissipated"):
        value, error = stored[name]
        assert abs(getattr(found, name) - value) <= error, (name, getattr(found, name), value, error)


@pytest.mark.verify
@pytest.mark.parametrize("kappa", [0.1, 0.3, 0.75])
def test_a_damped_zone_measured_again_is_the_stored_one_within_half_a_per_cent(kappa: float) -> None:
    ages = damped.AGES[32:64:4]
    again = damped.measure_zone(kappa, ages)
    r0 = contact_parameters(kappa).r0
    stored = damped_zone.ratios(kappa, r0, ages)
    again[0] *= 1.0 - damped_zone.age_of_spreading(kappa) / ages
    assert again == pytest.approx(stored, rel=5e-3)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_an_error_is_reached_on_its_own_side_when_it_turns(sign: float) -> None:
    """From 1 % on one side to 5 % on the other, 2 % are half-way in ln t; the size alone would be at a quarter."""
    times = np.array([1.0, 2.0, 8.0, 16.0])
    curve = sign * np.array([0.0, 0.01, -0.05, -0.2])
    assert ends.reached(times, curve, 0.02) == pytest.approx(4.0, rel=1e-12)
    assert ends.reached(times, curve, 0.05) == pytest.approx(8.0, rel=1e-12)
    assert ends.reached(times, curve, 0.01) == pytest.approx(2.0, rel=1e-12)
    assert ends.reached(times, curve, 0.3) is None


@pytest.mark.verify
@pytest.mark.parametrize("kappa", [0.0548, 0.092, 0.29, 0.46, 0.683])
def test_waves_from_the_ends_come_out_again_between_what_was_measured(kappa: float) -> None:
    times = ends.TIMES
    again = ends.measure_ends(kappa)
    stored, _ = ends_errors(kappa, times, ends.USUAL)
    for name, a, b in zip(("half length", "force"), again, stored):
        felt = [ends.reached(times, curve, ends.TOLERANCE) for curve in (a, b)]
        assert felt[0] == pytest.approx(felt[1], rel=0.05), name


def checked(seed: int, count: int) -> list[PredictionErrors]:
    """Prediction errors of ``count`` random problems, each drawn problem counts; seed and misses are printed."""
    random = np.random.default_rng(seed)
    found = [prediction_errors(random_problem(random)) for _ in range(count)]
    for k, v in enumerate(found):
        if not (holds_at_limit(v) and is_not_too_early(v)):
            print(f"seed {seed}, problem {k}: {v.impact}, limit {v.valid_until:.4g}, {v.at_limit}, {v.first_wrong}")
    held, late = (sum(says(v) for v in found) for says in (holds_at_limit, is_not_too_early))
    print(f"seed {seed}: {held} of {count} hold at the limit, of {late} it is no less than half of what is possible")
    return found


def holds_at_limit(v: PredictionErrors) -> bool:
    return v.at_limit is not None and v.at_limit <= 0.02


def is_not_too_early(v: PredictionErrors) -> bool:
    return v.first_wrong is None or v.valid_until >= 0.5 * v.first_wrong


def test_random_problems_are_within_two_per_cent_at_the_limit_of_predict() -> None:
    found = checked(2027, 2)
    assert all(holds_at_limit(v) and is_not_too_early(v) for v in found)


@pytest.mark.verify
def test_sixty_random_problems_are_within_two_per_cent_at_the_time_predict_gives_as_its_limit() -> None:
    found = checked(777, 60)
    assert sum(holds_at_limit(v) for v in found) == 60
    assert sum(is_not_too_early(v) for v in found) == 60
    for v in found:  # before it: a zone that begins to spread, and the pulse of the lifted middle that comes back
        age = damped_zone.touch_age(v.impact.kappa_over_nu)
        touched = age is not None and v.valid_until > age * v.impact.relative_damping
        assert v.largest_within is None or v.largest_within <= (0.04 if touched else 0.025), v.impact


def test_bounce_on_the_command_line(capsys: pytest.CaptureFixture[str], tmp_path) -> None:  # type: ignore[no-untyped-def]
    coarse = ["--set", "hermite.mesh.kind=uniform", "--set", "hermite.mesh.element_length=0.04"]
    asked = ["bounce", "--kappa-over-nu", "2", "--damping", "0.01", *coarse, "--out", str(tmp_path), "--json"]
    assert run(asked) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["restitution"]["value"] == pytest.approx(0.5663, abs=2e-3)
    assert set(document["energy"]) == {"translation", "vibration", "dissipated"}
    assert {"restitution", "impulse", "last_contact", "separations", "peak_moment", "midspan_moment"} <= set(document)
    assert {file.name for file in tmp_path.iterdir()} == {"bounce.json", "bounce.png", "bounce.gif"}


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        ([], "--kappa-over-nu"),
        (["--kappa-over-nu", "2"], "--damping"),
        (["--kappa-over-nu", "2", "--damping", "-1"], "damping"),
        (["--kappa-over-nu", "-2", "--damping", "0.1"], "kappa_over_nu"),
        (["--kappa-over-nu", "2", "--damping", "0.1", "--path", "self_similar"], "self_similar"),
    ],
)
def test_what_bounce_cannot_take_is_named(
    arguments: list[str], named: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["bounce", *arguments]) == 2
    assert named in capsys.readouterr().err
