"""Cases of the Hermite path: short runs with every setting stated."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

from benchmarks.net.case import Case, part, sets

__all__ = ["HERMITE", "hermite", "run"]

# parts of the Hermite path --------------------------------------------------------------------------------------------
UNIFORM, FINE = "uniform element_length=0.021", "scale_free element_length=0.002 growth=1.02"
CONSTANT, GROWING = "time_step=4.7e-5 growth=0", "time_step=1e-6 growth=0.01"
NGA = "nonsmooth_generalized_alpha spectral_radius=0.8 levels="
INTEGRATORS = {
    "moreau": "moreau_jean theta=1.0",
    "moreau-half": "moreau_jean theta=0.5",
    "signorini": "signorini_position theta=1.0",
    "signorini-half": "signorini_position theta=0.5",
    "alpha-v": NGA + "velocity",
    "alpha-pv": NGA + "position_velocity",
    "alpha-pva": NGA + "position_velocity_acceleration",
    "penalty": "generalized_alpha_penalty spectral_radius=0.8 stiffness=1e6 damping=1e3 contact_rounds=20",
}
STRICT = " hold=0 hold_until=0"


def hermite(
    integrator: str,
    contact: str = "node restitution=0" + STRICT,
    mesh: str = UNIFORM,
    steps: str = CONSTANT,
    far_field: str = "viscosity end=free viscosity=0.3",
    mass: str = "consistent",
    more: str = "hermite.full_beam=false",
) -> str:
    """Options that state every setting of the Hermite path."""
    tables = {"integrator": f"{INTEGRATORS[integrator]} {steps}", "contact": contact, "mesh": mesh}
    tables |= {"far_field": far_field, "mass": mass}
    return sets(" ".join([*(part(f"hermite.{name}", text) for name, text in tables.items()), more]))


def run(options: str, settings: str = "", file: str = "", saved: int = 100) -> str:
    """A ``simulate`` whose history is kept; velocity and EI of the unit beam are the number."""
    file, unit = (file, "") if file else ("{unit}", "impact.velocity={n} beam.bending_stiffness={n} ")
    return f"simulate {file} {sets(unit + settings)} {options} --save {saved} --out {{folder}}/run.nc --json --quiet"


def short(name: str, integrator: str, settings: str = "", **parts: str) -> Case:
    """A short run of the Hermite path."""
    return Case(f"hermite {name} {integrator}", run(hermite(integrator, **parts), settings))


def every_pair() -> list[Case]:
    """Every integrator with every contact: constant steps below κ/ν = 1, growing ones above it."""
    found = []
    for (name, kappa), contact in product(product(INTEGRATORS, (0.5, 2.0)), ("node", "middle", "mean")):
        if name == "penalty" and contact != "node":
            continue  # it takes no other
        brief = " run.end_time=0.003" if name == "signorini-half" else ""  # closed rows rattle
        parts = {"mesh": UNIFORM, "steps": CONSTANT} if kappa < 1.0 else {"mesh": FINE, "steps": GROWING}
        law = f"{contact} restitution=0{STRICT}"
        found.append(short(f"{kappa} {contact}", name, f"beam.curvature={kappa}{brief}", contact=law, **parts))
    for name in INTEGRATORS:
        found.append(short("0.5 fine", name, mesh=FINE, steps=GROWING))
    return found


def variants() -> list[Case]:
    """What else a short run can have: each with the schemes that treat it differently."""
    found = []
    for e, name in product((0.5, 1.0), ("moreau", "moreau-half", "alpha-v", "alpha-pva")):
        case = short(f"restitution {e}", name, contact=f"node restitution={e}{STRICT}")
        if e == 0.5 and name == "alpha-pva":  # "at rest" is judged by the largest velocity of the beam now
            case = replace(case, kind="bar", relative=2e-3)
        found.append(case)
    for name in ("moreau", "signorini", "alpha-pva"):
        found.append(short("lumped", name, mass="lumped rotary=0.0128"))
        found.append(short("full beam", name, more="hermite.full_beam=true"))
        found.append(short("hold 3", name, contact="node restitution=0 hold=3 hold_until=0"))
        found.append(short("hold until", name, contact="middle restitution=0 hold=0 hold_until=0.002"))
        found.append(short("refined", name, more="hermite.refine=1.5"))
    for name in ("moreau-half", "signorini", "alpha-pva", "penalty"):
        sponge = "sponge end=free viscosity=0.3 strength=0.03 width=0.5"
        found.append(short("sponge", name, far_field=sponge))
        follow = "viscosity end=following viscosity=0.3"
        loaded = "impact.acceleration=1 impact.curvature_rate=1 impact.fourth_derivative=-2"  # moments at the ends
        found.append(short("domain", name, loaded, far_field=follow, more="hermite.domain=0.6"))
    meshes = ("graded element_length=0.01 growth=1.05 zone=0.2 size_ratio=100", "nodes places=[0,0.01,0.03,0.06,0.1,1]")
    for mesh in (*meshes, "square first_element=0.01 zone=0.3 growth=1.1 size_ratio=100"):
        found.append(short(mesh.split()[0], "signorini", mesh=mesh))
    loads = {
        "pressed": "impact.acceleration=5",
        "drawn off": "impact.acceleration=-5",
        "c0": "impact.curvature_rate=1",
        "q0": "impact.fourth_derivative=-2",
        "tension": "beam.axial_force=3",
        "damping 1e-2": "beam.damping=1e-2",
        "damping 1e-3": "beam.damping=1e-3",
        "hollow wall": "wall.curvature=0.2",
        "round wall": "wall.curvature=-0.2",
        "rocking": "impact.rotation=0.3",
        "first touch": "impact.first_touch=0.3 impact.rotation=-0.2",
    }
    for (load, settings), name in product(loads.items(), ("moreau", "signorini", "alpha-pva")):
        found.append(short(load, name, settings))
    return found


HERMITE = [*every_pair(), *variants()]
