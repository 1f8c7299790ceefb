"""A case file to start from: a beam as its owner knows it, every line with its unit."""

from pathlib import Path

from bent_beam.cases import EXAMPLES
from bent_beam.checks import shortened
from bent_beam.errors import InputError, nearest

SECTION_LINES = {
    "pipe": """outer_diameter = 0.127      # m
wall_thickness = 0.00919    # m (or inner_diameter)
# fluid_density = 1200.0    # kg/m³, what fills it
""",
    "round_bar": "diameter = 0.02             # m\n",
    "rectangle": """width = 0.03                # m
thickness = 0.001           # m, in the plane of bending
""",
    "general": """area_of_section = 7.686e-3  # m² (rail 60E1)
second_moment_of_area = 3.038e-5  # m⁴
section_height = 0.172      # m
""",
}

TEXT = """title = "My beam"

# Change the numbers; every other setting: bentbeam settings. Then: bentbeam predict THIS_FILE

[section]
kind = "{kind}"
{lines}youngs_modulus = 206e9      # Pa
density = 7850.0            # kg/m³
yield_stress = 7.24e8       # Pa; leave out when not of interest
# added_mass = 5.0          # kg/m, mass outside that moves with the beam

[beam]
length = {length:<18} # m, of the whole beam
sagitta = {sagitta:<17} # m, height of the bow over its length (or curvature, 1/m, or dogleg, degrees in 30 m)
# axial_force = 50e3        # N, tension positive, along x (or tension_direction = "tangent": along the bow)
damping_ratio = {damping}  # of the first bending mode (or damping, s, or loss_factor at loss_frequency)
# without this line there are answers for 0.0002, 0.002 and 0.02; that of the largest stress counts

[impact]
velocity = {velocity:<16} # m/s towards the wall (or drop_height, m; angular_speed; amplitude and frequency)
# gravity = 9.81            # m/s², with gravity_angle = 0.0 degrees onto a floor, 90.0 onto an upright wall

# [wall]
# curvature = 0.0           # 1/m, positive where the wall is concave

# [run]
# end_time = 0.005          # s, of the table of predict and of simulate; that of the first spread unless given
"""

UNSTATED = '"state it: 0.0002 bare steel, 0.002 as held, 0.02 a structure, 0 none"'
"""In place of a damping ratio: whoever reads the case is told the choices, those of `bouncing.DAMPING_RATIOS`."""


def new_case(kind: str, damping_ratio: float | None = None) -> str:
    """The text of a case with a section of ``kind``; a damping ratio of ``None`` is left to be stated, and the case
    refused until then. Raises :class:`InputError` for an unknown kind."""
    if kind not in SECTION_LINES:
        raise InputError(f"--section: {shortened(kind)} is not known{nearest(kind, SECTION_LINES)}")
    long = kind in ("pipe", "general")
    return TEXT.format(
        kind=kind,
        damping=UNSTATED if damping_ratio is None else f"{damping_ratio:g}",
        lines=SECTION_LINES[kind],
        length=30.0 if long else 1.0,
        sagitta=0.2 if long else 0.01,
        velocity=2.0 if long else 1.0,
    )


def examples() -> dict[str, Path]:
    """The example cases by name."""
    return {file.stem: file for file in EXAMPLES.glob("*.toml")}


def example(name: str) -> str:
    """The text of an example. Raises :class:`InputError` for an unknown name."""
    if name not in examples():
        raise InputError(f"--like: {shortened(name)} is no example{nearest(name, examples())}")
    return examples()[name].read_text(encoding="utf-8")
