"""A result that is not to be trusted says so where the number is, in the JSON's `warnings`; long runs stay exact."""

import pytest
from called import CASE, answered
from here import FUZZ

import hermite_fe
from benchmarks.scale import peak
from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from hermite_fe.integrators import MoreauJean


def simulate(tmp_path, path, settings):
    """The answer, with ``settings`` of anything."""
    file = tmp_path / "case.toml"
    file.write_text(CASE)
    words = (word for setting in settings.split() for word in ("--set", setting))
    return answered("simulate", file, "--path", path, "--save", 20, *words)


UNIFORM = "mesh.kind=uniform mesh.element_length="
LONG_STEPS = "hermite.integrator.kind=signorini_position hermite.integrator.growth=3.0"
BENT = UNIFORM + "0.25 beam.length=10.0 beam.curvature=30.0"
DAMPED = "beam.curvature=0.1 beam.damping=0.01"  # η = 0.01 t*: bending runs 0.1 l* in that time


@pytest.mark.parametrize(
    ("path", "settings", "words"),
    [
        ("hermite", "run.duration=3.0", "ends of the beam"),
        ("hermite", UNIFORM + "2.0", "cannot resolve the contact front"),
        ("hermite", LONG_STEPS, "time steps cannot resolve"),
        ("exudyn", UNIFORM + "0.02 beam.length=0.4", "reflected"),
        ("exudyn", UNIFORM + "1.0", "holds 0.33 elements at the end time"),  # √(κ/ν · 2 · 1.1 T) m
        ("exudyn", "mesh.kind=graded mesh.element_length=0.02 mesh.growth=1.25", "grows by 25%"),
        ("exudyn", f"{BENT} exudyn.geometry.kind=linear exudyn.geometry.amplitude=1e-3", "linear range"),
        ("hermite", f"{DAMPED} {UNIFORM}0.1", "lifts off the wall"),
    ],
)
def test_a_doubtful_run_says_so(path, settings, words, tmp_path):
    said = simulate(tmp_path, path, settings)["warnings"]
    assert any(words in warning for warning in said), said


def test_a_sound_run_has_nothing_to_warn_of(tmp_path):
    """The lift of a damped beam is its own where elements resolve its damping: converged, 0.42 V₀t."""
    assert simulate(tmp_path, "hermite", "")["warnings"] == []
    damped = simulate(tmp_path, "hermite", DAMPED)
    assert damped["lift"] > 0.05 and not [said for said in damped["warnings"] if "lifts off the wall" in said]
    assert not [said for said in simulate(tmp_path, "exudyn", BENT)["warnings"] if "linear range" in said]


minutes = pytest.mark.skipif(not FUZZ, reason="a run of minutes: FUZZ=1")
STEPS = [500, pytest.param(20_000, marks=pytest.mark.verify), pytest.param(200_000, marks=minutes)]


@pytest.mark.parametrize("steps", STEPS)
def test_the_budget_of_a_long_run_closes_and_its_memory_stays_flat(steps):
    """Two thousand nodes."""
    impact = Impact.dimensionless(0.5, length=20.0)

    def run(count):
        mesh, scheme = UniformMesh(10.0 / 1999), MoreauJean(time_step=0.1 / steps)
        return hermite_fe.simulate(impact, end_time=0.1 * count / steps, mesh=mesh, integrator=scheme, save=20)

    assert run(max(steps // 100, 10)).dataset is not None  # kernels are loaded then, and xarray is imported
    before = peak()  # MB
    history = run(steps)
    budget = history.energy_budget()
    assert history.steps == steps and history.dataset.sizes["x"] == 2000
    assert abs(budget["defect"]) < 1e-9 * budget["initial_energy"]
    assert peak() - before < 20.0 + 40e-6 * steps  # the instants, 8 bytes a step, and copies of them
