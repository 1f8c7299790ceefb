"""In the linear limit an ANCF cable is the Hermite element with consistent mass: on one mesh, with one step and one
contact law, both codes must give the same gaps, node by node and digit by digit. Neither knows of the other."""

import numpy as np
import pytest

import exudyn_models
import hermite_fe
from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from exudyn_models.contacts import CONTACTS as EXUDYN_CONTACTS
from exudyn_models.integrators import INTEGRATORS as EXUDYN_INTEGRATORS
from exudyn_models.solvers import SOLVERS
from hermite_fe.far_fields import FAR_FIELDS
from hermite_fe.integrators import INTEGRATORS


@pytest.mark.parametrize(("damping", "gaps", "impulse"), [(1e-3, 1e-6, 1e-9), (1e2, 0.11, 1e-3)])
def test_nodal_gaps_of_both_codes_agree(damping, gaps, impulse):
    """With next to no dashpots digit by digit. Those of Exudyn's path grip just before the wall and let go before they
    would pull, those of the Hermite path act inside the wall alone: gaps differ by a tenth of V₀t at first, by a
    hundredth at the end, the impulse hardly."""
    impact = Impact.dimensionless(0.5, length=10.0)
    step, stiffness = 2e-4, 1e4  # per unit length of beam, as the damping
    how = {"end_time": 0.1, "mesh": UniformMesh(0.05), "save": np.linspace(0.0, 0.1, 26)}
    ours = hermite_fe.simulate(
        impact,
        **how,
        integrator=INTEGRATORS["generalized_alpha_penalty"](
            spectral_radius=0.5, time_step=step, stiffness=stiffness, damping=damping, contact_rounds=20
        ),
        far_field=FAR_FIELDS["viscosity"](viscosity=0.0),
    )
    theirs = exudyn_models.simulate(
        impact,
        **how,
        element=exudyn_models.ELEMENTS["ancf_cable"](viscosity=0.0),
        integrator=EXUDYN_INTEGRATORS["generalized_alpha"](spectral_radius=0.5, time_step=step),
        contact=EXUDYN_CONTACTS["penalty"](
            relative_stiffness=stiffness * 0.05**4, relative_damping=damping * 0.05**2, hold_start=0.0
        ),
        geometry=exudyn_models.GEOMETRIES["linear"](amplitude=1e-5),
        solver=SOLVERS["newton"](contact_iterations=20, contact_tolerance=1e-10, initial_accelerations=False),
    )
    assert np.allclose(ours.time, theirs.time, rtol=1e-9)
    scale = impact.velocity * ours.time[1:, None]
    difference = np.abs(ours.array("gap")[1:] - theirs.array("gap")[1:]) / scale
    assert ours.array("in_contact").any()
    assert float(difference.max()) < gaps and float(difference[-1].max()) < 0.1 * gaps
    assert ours.array("total_impulse")[-1] == pytest.approx(theirs.array("total_impulse")[-1], rel=impulse)


@pytest.mark.verify
def test_both_paths_agree_on_a_finite_beam():
    """The thesis's beam of two metres with a₀ = −700 m/s²: the middle lifts off on both, by the same amount."""
    impact = Impact(1.0, 1.0, 2.0, 0.35, 3.5, acceleration=-700.0)
    end = 0.02 * impact.time_scale
    methods = (hermite_fe.HermiteFE(refine=0.5), exudyn_models.ExudynModel(refine=0.5))
    ours, theirs = (method.simulate(impact, end_time=end) for method in methods)
    a, b = (float(h.array("gap")[-1, 0]) for h in (ours, theirs))
    assert a > 0.0
    assert a == pytest.approx(b, rel=0.05)
    assert ours.array("total_impulse")[-1] == pytest.approx(theirs.array("total_impulse")[-1], rel=0.005)
