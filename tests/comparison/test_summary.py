"""Error bars of one run's summary."""

from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from comparison.summary import Companion, summary
from hermite_fe import HermiteFE
from hermite_fe.integrators import MoreauJean
from theory import predict


def test_a_zone_that_its_scheme_throws_off_the_wall_is_pushed_too_hard_and_the_bar_says_so() -> None:
    """A companion that is thrown off alike does not show it. A damped beam lifts off by itself: no bar for that."""
    impact, end = Impact.whole_beam(0.06), 0.004
    method = HermiteFE(mesh=UniformMesh(0.01), integrator=MoreauJean(theta=1.0))
    found = []
    for one in (impact, impact.replace(damping=1e-3)):
        history = method.simulate(one, end_time=end, save=60)
        found.append(summary(history, others=[Companion.of(history)])["total_impulse"])
    exact = predict(impact, [end]).times[0].impulse
    assert 0.01 * exact < abs(found[0].known - exact) < found[0].bar < 0.3 * exact
    assert found[1].bar < 0.01 * exact
