"""A prediction in other units is the same prediction, in every number, to round-off."""

import random

import pytest
from here import FUZZ, SEED
from twins import EXACT, agree, in_units

from bent_beam import Impact
from bent_beam.section import Pipe
from theory import predict

BEAM = Impact(2.0, 3.0, 60.0, 0.4, 1.25)
SLOW = BEAM.replace(velocity=0.02, curvature=0.05)  # waves from its ends are back before anything else
LOADED = BEAM.replace(acceleration=0.8, curvature_rate=-0.02, fourth_derivative=0.03)
IMPACTS = {
    "loaded": LOADED,
    "sheared and pulled": LOADED.replace(shear_stiffness=150.0, rotary_inertia=5e-3, axial_force=0.5),
    "damped": BEAM.replace(damping=1e-3),
    "one point, damped": SLOW.replace(damping=1e-3),
    "a quartic bow": SLOW.replace(fourth_derivative=1e-7, curvature=0.01),
    "pulled": SLOW.replace(axial_force=8e-4),
    "soft wall": LOADED.replace(wall_stiffness=6e4, wall_damping=40.0),
    "one point, soft wall": BEAM.replace(curvature=3.0, wall_stiffness=6e4),
}
# one point on a soft wall yields, at 0.29 MPa; the others, at 0.21 MPa or less, are valid as long as they can
SECTION = Pipe(outer_diameter=0.05, wall_thickness=0.01, youngs_modulus=2e6, density=900.0, yield_stress=2.5e5)
LENGTHS = ("length_scale", "deflection_scale", "half_contact_length", "peak_moment_place", "zone_offset", "penetration")
TIMES = ("time_scale", "slow_time_scale", "valid_from", "valid_until", "force_until", "time", "rigid_from")
UNITS = dict.fromkeys(LENGTHS, "m") | dict.fromkeys((*TIMES, "peak_force_time"), "s")
UNITS |= dict.fromkeys(("reaction", "peak_force", "peak_force_error"), "N") | {"impulse": "N s", "peak_moment": "N m"}
UNITS |= dict.fromkeys(("contact_force_per_length", "pressure"), "N/m") | {"peak_stress": "Pa"}
BASES = [EXACT, {"kg": 1e-12, "m": 1e6, "s": 1e-4}]  # the second makes c = √(EI/μ) 1e16 times as large
if FUZZ:
    RANDOM = random.Random(SEED)
    BASES += [{unit: 10.0 ** RANDOM.uniform(-9.0, 9.0) for unit in EXACT} for _ in range(6)]


@pytest.mark.parametrize("name", IMPACTS)
def test_every_number_of_a_prediction_changes_with_its_unit(name):
    def predicted(beam, section):
        return predict(beam, [tau * beam.time_scale for tau in (1e-3, 0.05, 0.4)], section=section)

    found = predicted(IMPACTS[name], SECTION)
    for base in BASES:
        agree(found, predicted(in_units(IMPACTS[name], base), in_units(SECTION, base)), UNITS, base)
