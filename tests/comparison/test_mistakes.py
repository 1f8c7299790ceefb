"""Who extends the project, or looks for a key, is told in one sentence what is wrong."""

import numpy as np
import pytest
from called import answered, command, refused
from strangers import Plain

import exudyn_models
import hermite_fe
import theory
from bent_beam import Impact, InputError
from bent_beam.cases import EXAMPLES, load_case
from bent_beam.meshes import UniformMesh
from bent_beam.method import method_from_tables, separation_times
from comparison import bounce, match, predict, sweep
from comparison.methods import methods_from_file
from comparison.questions import Question
from comparison.readable import folder
from comparison.simulating import simulate_case
from exudyn_models import ExudynModel
from hermite_fe import HermiteFE
from hermite_fe.contacts import NodeContact, element_rows
from hermite_fe.integrators import MoreauJean
from self_similar_fe import SelfSimilarFE

IMPACT, TUBE = Impact.dimensionless(0.5, length=20.0), EXAMPLES / "tube.toml"


class Light(NodeContact):
    """Weights that do not add up to one."""

    def rows(self, beam, facing, *, full):
        return element_rows(beam, facing, np.tile([0.4, 0.0, 0.4, 0.0], (beam.lengths.size, 1)), full=full)


class Mute(MoreauJean):
    def advance(self, *_):
        """Takes no step and says nothing."""


@pytest.mark.parametrize(
    ("made", "said"),
    [
        (lambda: HermiteFE(integrator=MoreauJean), r"integrator must be made from its class: MoreauJean\(\)"),
        (lambda: HermiteFE(integrator="moreau_jean"), "integrator must be an instance of Integrator .*'moreau_jean'"),
        (lambda: hermite_fe.simulate(IMPACT, end_time=0.01, contact=NodeContact), r"contact .*: NodeContact\(\)"),
        (lambda: HermiteFE().simulate(TUBE, end_time=0.01), r"impact must be a .*, as load_case\(…\).impact"),
        (lambda: exudyn_models.simulate(3), r"impact must be a bent_beam.Impact, .*\(got 3\)"),
        (lambda: exudyn_models.build(TUBE), "impact must be a bent_beam.Impact"),
        *(
            (lambda ask=ask: ask(load_case(TUBE)), r"impact must be a bent_beam.Impact, .*\(got Case")
            for ask in (*(one().refuses for one in (HermiteFE, SelfSimilarFE, ExudynModel)), theory.predict)
        ),
        (lambda: method_from_tables("exudyn", {"integrator": {"rho": 0.9}}), "integrator.rho is not a known setting"),
        (lambda: Impact.whole_beam(0.5, shear_ratio=0.3), r"shear_ratio has no effect without .*\(got 0.3\)"),
        (lambda: ExudynModel(mesh=3), r"mesh must be an instance of Mesh \(got 3\)"),
        (lambda: HermiteFE(contact=Light()).simulate(IMPACT, end_time=0.01), r"weights .* add up to one .*\(got 0.8\)"),
        (lambda: HermiteFE(integrator=Mute()).simulate(IMPACT, end_time=0.01), "Mute.advance must return .*got None"),
        (lambda: match(HermiteFE, kappa_over_nu=[0.5]), r"method: .*: HermiteFE\(\) \(got the class\)"),
        (lambda: bounce(Impact.whole_beam(2.0), 3), r"method: must be .*\(got 3\)"),
        (lambda: bounce(Impact.whole_beam(2.0), Plain()), "take hermite or exudyn .*theirs lacks for_whole_beam"),
        (lambda: match(HermiteFE(), kappa_over_nu=[0.5, 0.5]), r"kappa_over_nu has a value twice \(got \[0.5, 0.5\]\)"),
        (lambda: match(HermiteFE(), kappa_over_nu=[0.5], refine=[1.0, 1.0]), "refine has a value twice"),
        (lambda: match(HermiteFE(), kappa_over_nu=[]), r"kappa_over_nu must have a value \(got none\)"),
        (lambda: match(first_order=[(4, 0, 0, 0, 7)]), r"first_order takes alpha, .*\(got \(4, 0, 0, 0, 7\)\)"),
        (lambda: match(first_order=(4, 0, 0)), r"first_order takes alpha, .*\(got 4\)"),
        (lambda: bounce(Impact.whole_beam(0.5).replace(axial_force=-3.0)), "beam.axial_force must not press with more"),
        (lambda: Question(IMPACT, HermiteFE(), until=-1.0), r"until must be positive \(got -1.0\)"),
        (lambda: separation_times(IMPACT, save=0), r"save must be a whole number of at least 1 \(got 0\)"),
        (lambda: sweep({}, {"impact.velocity": 3.0}), r"impact.velocity takes its values in a list, .*\(got 3.0\)"),
        (lambda: sweep(TUBE, {"impact.velocity": [1.0, float("nan")]}), "vary: impact.velocity must be"),
        (lambda: sweep(TUBE, {}), "nothing is varied"),
        (lambda: sweep(load_case(TUBE), {"impact.velocity": [1.0]}), "case must be a case file or .*got Case"),
        (lambda: sweep(TUBE, {"impact.velocity": [1.0]}, HermiteFE()), "path must be the name .*got HermiteFE"),
        (lambda: sweep(TUBE, {"impact.velocity": []}), r"vary: impact.velocity has no values \(got \[\]\)"),
        (lambda: predict(TUBE, [0.001, 0.002]), r"times must be a finite number each: predict\(case, 0.001, 0.002\)"),
        (lambda: methods_from_file(TUBE), "tube.toml is a case file"),
        (lambda: folder(TUBE), "out must be a folder, and .*tube.toml is a file"),
    ],
)
def test_a_mistake_of_extension_is_one_sentence_that_says_what_to_write(made, said):
    with pytest.raises(InputError, match=said) as told:
        made()
    assert "\n" not in str(told.value)


def test_ratios_come_in_any_iterable_and_loads_as_arrays_and_too_few_elements_are_refused() -> None:
    for ratios in (0.5, np.float64(0.5), np.array(0.5), {0.5}, (one for one in (0.5,)), np.array([0.5])):
        (row,) = match(HermiteFE(mesh=UniformMesh(250.0)), kappa_over_nu=ratios, first_order=[np.array([4.0, 0, 0])])
        assert (row.kappa_over_nu, row.alpha) == (0.5, 4.0)
    assert row.refused and "mesh has 2 elements in a half beam of 500 m, and 4 are the fewest" in row.reason
    for loads in (["400"], [(4.0, 0.0)]):
        with pytest.raises(InputError, match="first_order takes alpha, psi, chi"):
            match(HermiteFE(), kappa_over_nu=0.5, first_order=loads)


def test_steps_of_which_no_other_run_tells_the_error_are_taken_where_none_is_asked() -> None:
    tables = ["beam.model=euler_bernoulli", "hermite.integrator.kind=moreau_jean", "hermite.integrator.time_step=2e-5"]
    case = load_case(TUBE, [*tables, "run.end_time=5e-5"])
    assert simulate_case(case, "hermite", until=5e-5, error_bars="drift").numbers["impulse"].bar is None
    with pytest.raises(InputError, match="time_step must be at most"):
        simulate_case(case, "hermite", until=5e-5)


@pytest.mark.parametrize("method", [HermiteFE(), ExudynModel(), SelfSimilarFE()], ids=lambda one: one.path)
@pytest.mark.parametrize("save", [[0.05, 0.05], [0.1, 0.0], [[0.1]], ["a"], True, 1.5])
def test_instants_to_save_are_a_whole_number_or_times_that_increase(method, save) -> None:
    with pytest.raises(InputError, match="save must "):
        method.simulate(Impact.dimensionless(0.5), end_time=0.1, save=save)


def test_what_is_said_twice_or_has_no_effect_is_refused_by_its_name() -> None:
    both = ["mesh.kind=uniform", "mesh.element_length=0.05", "hermite.mesh.kind=uniform"]
    with pytest.raises(InputError, match=r"\[mesh\] and \[hermite.mesh\] say the same: give one of them"):
        load_case(TUBE, [*both, "hermite.mesh.element_length=0.02"]).method("hermite")
    assert load_case(TUBE, [*both[:2], "hermite.mesh.kind=auto"]).method("hermite").mesh == UniformMesh(0.05)


def test_a_newcomer_starts_from_an_example_and_finds_a_key(tmp_path):
    file = tmp_path / "mine.toml"
    assert answered("new", file, "--like", "tube") == {"file": str(file), "like": "tube"}
    assert load_case(file).impact == load_case(TUBE).impact
    assert "did you mean tube?" in refused("new", tmp_path / "other.toml", "--like", "tub")
    assert "--like" in refused("new", tmp_path / "other.toml", "--like", "tube", "--section", "pipe")
    found = answered("settings", "loss_factor")
    assert {"loss_factor", "loss_frequency"} <= {one["name"] for one in found} and len(found) < 5
    assert "did you mean velocity?" in refused("settings", "velocty")
    assert "[exudyn.contact] kind = penalty: Nodal penalty: the default." in command("settings", "hold_start")[1]
