"""What the Hermite path refuses, by name and value."""

from functools import partial

import numpy as np
import pytest
from hermite_parts import ALL, ball

from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from hermite_fe import HermiteFE, simulate
from hermite_fe.constraints import ContactLaw
from hermite_fe.contacts import AlternateContact, MeanContact, MiddleContact, NodeContact
from hermite_fe.far_fields import GridViscosity, Sponge
from hermite_fe.integrators import MasslessBoundary, Midpoint, MoreauJean, SignoriniPosition
from hermite_fe.masses import LumpedMass
from hermite_fe.run import integrate
from hermite_fe.system import ContactRows, System

SHORT = Impact.dimensionless(0.5, length=8.0)
SHEARED = Impact.whole_beam(0.5, relative_damping=3e-3, shear_length=0.05, shear_ratio=0.2)
LOSSY = SHEARED.replace(damping=0.0, hysteretic_loss=0.01, loss_frequency=1.0)
SPRINGS = SHORT.replace(wall_stiffness=50.0)
# a slope and the next node but one, coupled by the mass with the multipliers of two elements between them
FAR = System([[1.0] * 6, *np.zeros((2, 6)), [0.0, 0.1] + [0.0] * 4], np.zeros((1, 6)),
             ContactRows([[0, 1, 2, 3], [2, 3, 4, 5]], 0.5 * np.ones((2, 4)), np.ones(2)))  # fmt: skip
WAY = '.*model = "euler_bernoulli"'
LAYER = type("Layer", (GridViscosity,), {"absorbs": True})(viscosity=0.0)  # of somebody's own
ONE = ContactRows([[0]], [[1.0]], [1.0])
system = partial(System, np.ones((1, 2)), np.ones((1, 2)))
at_rest = partial(integrate, ball(), np.zeros(1), np.zeros(1))


def massless(impact=SHORT, element=0.04, contact=AlternateContact(), viscosity=0.0, end_time=0.1, mass=None):  # noqa: B008
    """A run without mass in the contact points, with something that it does not go with."""
    scheme, quiet = MasslessBoundary(time_step=2.5e-4, growth=0.0), GridViscosity(viscosity=viscosity)
    method = HermiteFE(mesh=UniformMesh(element), integrator=scheme, contact=contact, far_field=quiet, mass=mass)
    method.simulate(impact, end_time=end_time)


def odd(law, sticks=True):
    """A run whose contact has a law of somebody's own, that is none."""
    simulate(SHORT, integrator=MoreauJean(1e-3), contact=type("Odd", (NodeContact,), {"law": law, "sticks": sticks})())


REFUSED = [
    # arguments
    (lambda: simulate(SHORT, end_time=0.0), r"end_time must be positive \(got 0.0\)"),
    (lambda: simulate(SHORT, end_time=float("nan")), "end_time must be a finite number"),
    (lambda: simulate(SHORT, save=1), "save must be"),
    (lambda: simulate(SHORT, mesh=UniformMesh(1e-9)), r"^mesh\.element_length is too small"),
    (lambda: simulate(Impact.dimensionless(0.5, epsilon_psi=1.0, length=40.0)), "into the wall before the impact"),
    (lambda: simulate(SHORT.replace(rotation=-3.0, first_touch=0.5)), r"rotation must not .* at -0\.5 m/s"),
    (lambda: integrate(ball(), np.zeros(1), np.zeros(0), MoreauJean(1e-3), 0.1), r"v must have shape \(1,\) .*\(0,\)"),
    # systems
    (lambda: ContactRows([[1], [0]], np.ones((2, 1)), np.ones(2)), "sorted by their first dof"),
    (lambda: ContactRows([[0, 1], [0, 2]], np.ones((2, 2)), np.ones(2)), "those of several dofs each with another"),
    (lambda: ContactRows([[0]], [[1.0]], [1.0], places=np.ones(2)), r"places must have shape \(1,\) \(got \(2,\)\)"),
    (lambda: System(np.ones((1, 2)), np.ones((1, 3)), ONE), r"system\.stiffness must have shape \(≤ 4, 2\)"),
    (lambda: System(np.ones((5, 2)), np.ones((1, 2)), ONE), r"system\.mass must .* \(got \(5, 2\)\)"),
    (lambda: system(ONE, (("viscous", np.ones(2)),) * 2), "each of .* at most once"),
    (lambda: system(ONE, (("friction", np.ones(2)),)), r"dampings must name .* \(got \['friction'\]\)"),
    (lambda: system(ONE, load=np.ones((2, 3))), r"system\.load must have shape \(powers, 2\)"),
    (lambda: system(ContactRows([[2]], [[1.0]], [1.0])), "contact rows must name dofs from 0 to 1"),
    (lambda: system(ContactRows([[-1]], [[1.0]], [1.0])), "contact rows must name dofs from 0 to 1"),
    (lambda: system(ONE, supports=(-1,)), r"system\.supports must name dofs from 0 to 1 \(got \(-1,\)\)"),
    (lambda: system(ONE, supports=(0,)), "must not share a dof"),
    # contacts
    (lambda: integrate(FAR, np.zeros(6), np.zeros(6), MoreauJean(1e-3), 0.1), "a few neighbouring dofs"),
    (lambda: NodeContact(restitution=0.05, hold=4), "hold keeps rows closed"),
    (lambda: MeanContact(restitution=1.5), r"contact\.restitution must lie in \[0, 1\] \(got 1.5\)"),
    (lambda: MiddleContact(hold=-1), r"contact\.hold must be a whole number"),
    (lambda: NodeContact(hold_until=-1.0), r"contact\.hold_until must not be negative"),
    (lambda: simulate(SHORT, integrator=ALL["penalty"](1e-3), contact=NodeContact(hold=4)), r"\.hold has no effect"),
    (lambda: simulate(SHORT, integrator=ALL["penalty"](1e-3), contact=MiddleContact()), r"contact\.kind"),
    (lambda: simulate(SHORT, integrator=ALL["penalty"](1e-3), contact=NodeContact(0.5)), r"restitution must be 0 \("),
    # integrators
    (lambda: ALL["velocity"](spectral_radius=-0.1), r"spectral_radius must lie in \[0, 1\] \(got -0.1\)"),
    (lambda: ALL["velocity"](levels="none"), "levels must be one of"),
    (lambda: ALL["penalty"](stiffness=0.0), "stiffness must be positive"),
    (lambda: ALL["penalty"](damping=-1.0), "damping must not be negative"),
    (lambda: ALL["penalty"](contact_rounds=0), "contact_rounds must be a whole number of at least 1"),
    (lambda: MoreauJean(time_step=1e-12).instants(1.0), "2e.07 are the most: give an earlier end"),
    (lambda: MoreauJean().instants(1.0), "not chosen yet"),
    # contact points without mass
    (lambda: massless(viscosity=0.3), r"takes no damping: hermite.far_field.viscosity"),
    (lambda: massless(contact=NodeContact()), r'points that do not touch.*contact.kind must be "alternate"'),
    (lambda: massless(contact=MiddleContact()), r'points that are dofs: hermite.contact.kind must be "alternate"'),
    (lambda: massless(contact=AlternateContact(restitution=0.5)), r"restitution must be 0 \(got 0.5\)"),
    (lambda: massless(SHORT.replace(shear_stiffness=50.0)), r"shear_stiffness"),
    (lambda: massless(mass=LumpedMass(0.1)), r"hermite.mass has no effect .*\(got LumpedMass\(rotary=0.1\)\)"),
    (lambda: massless(element=1e-3, end_time=1e3), r"massless_boundary and mesh ask for .* steps"),
    # a wall that gives way
    (lambda: HermiteFE(integrator=MoreauJean()).simulate(SPRINGS, end_time=1.0), "integrator.kind"),
    (lambda: HermiteFE(contact=NodeContact()).simulate(SPRINGS, end_time=1.0), "contact has no effect"),
    (lambda: HermiteFE(integrator=Midpoint()).simulate(SHORT, end_time=1.0), "integrator.kind"),
    # shear and hysteretic loss
    (lambda: HermiteFE(integrator=ALL["penalty"]()).simulate(LOSSY.unsheared), "loss needs .*Penalty"),
    (lambda: simulate(LOSSY), "hysteretic_loss" + WAY),
    (lambda: simulate(SHEARED, contact=MiddleContact()), r"contact\.kind" + WAY),
    (lambda: simulate(SHEARED.replace(wall_stiffness=1e3), contact=MiddleContact()), "has no effect on a wall"),
    (lambda: HermiteFE(far_field=Sponge()).simulate_to_separation(SHEARED), "sponge absorbs waves"),
    (lambda: HermiteFE(far_field=LAYER).simulate_to_separation(SHEARED), "far field absorbs waves"),
    # a largest pull
    *((lambda kind=kind: at_rest(ALL[kind](1e-4), 1.0, law=ContactLaw(strength=np.ones(1))), "needs moreau_jean")
      for kind in ("penalty", "velocity", "position_velocity_acceleration")),
    (lambda: at_rest(MoreauJean(1e-4), 1.0, law=ContactLaw(strength=-np.ones(1))), r"0 or more, N \(got -1.0\)"),
    (lambda: at_rest(MoreauJean(1e-4), 1.0, law=ContactLaw(0.5, strength=np.ones(1))), r"must be 0 \(got 0.5\)"),
    (lambda: at_rest(SignoriniPosition(1e-4, theta=0.9), 1.0, law=ContactLaw(strength=np.ones(1))), "theta = 1"),
    (lambda: odd(lambda *_: None), "Odd.law must return a ContactLaw"),
    (lambda: odd(lambda *_: ContactLaw(strength=np.ones(3))), "Odd.law must give one strength, or one a row"),
    (lambda: odd(lambda *_: ContactLaw(strength="1.0")), "strength as a number, N .*got '1.0'"),
    (lambda: odd(lambda *_: ContactLaw(strength=1.0), sticks=False), "Odd.law has a strength: set `sticks"),
    (lambda: odd(lambda *_: ContactLaw(strength=1.0, hold=2)), "neither rebounds nor is held"),
]  # fmt: skip


@pytest.mark.parametrize(("made", "said"), REFUSED, ids=[said for _, said in REFUSED])
def test_what_has_no_effect_or_no_sense_is_refused_by_name(made, said):
    with pytest.raises(ValueError, match=said):
        made()
