"""All cases: those of the Hermite path, whole impacts, the other paths, and what is held against the theory."""

from __future__ import annotations

from itertools import product

from benchmarks.net.case import Case, part, sets
from benchmarks.net.hermite import HERMITE, hermite, run

__all__ = ["CASES"]

CHOSEN = "mesh, steps and contact are chosen"
RATTLES = "closed constraints rattle at θ = ½, also in the companion runs, and amplify round-off: inside the error bars"


def whole_impacts() -> list[Case]:
    """Damped whole impacts, two walls, and beams of the real cases on stated settings."""
    found = []
    for kappa, damping, name in product((0.5, 1.5, 2.0, 4.0), (1e-2, 1e-3), ("signorini-half", "moreau")):
        parts = hermite(name, steps="time_step=2e-4 growth=0", far_field="viscosity end=free viscosity=0")
        command = f"bounce --kappa-over-nu {{n}} --damping {damping} {parts} --json --quiet"
        found.append(Case(f"bounce {kappa} damping {damping} {name}", command, kappa, "bar", RATTLES, 2e-3))
    for kappa in (0.5, 1.5, 2.0, 4.0):
        command = "bounce --kappa-over-nu {n} --damping 0.01 --json --quiet"
        found.append(Case(f"bounce chosen {kappa}", command, kappa, "bar", CHOSEN, 2e-3))
    for name, distance in product(("signorini-half", "moreau", "alpha-pva"), (1.0, 0.7)):
        stated = hermite(name, mesh="uniform element_length=0.047", steps="time_step=1e-3 growth=0")
        more = sets("impact.velocity={n} beam.damping=0.05 wall.opposite=" + str(distance))
        found.append(
            Case(f"two walls {distance} {name}", run(f"{stated} {more}", "run.end_time=6", "{cases}/two_walls.toml"))
        )
    calm = hermite("moreau", mesh="uniform element_length=0.021", steps="time_step=2e-4 growth=0")
    for load in ("impact.rotation=0.3", "impact.first_touch=0.2", "wall.curvature=-0.3"):
        found.append(Case(f"whole {load}", run(calm, f"beam.damping=1e-2 run.end_time=0.6 {load}")))
    left = run(calm, "beam.damping=1e-2").replace("simulate", "simulate --until separation", 1)
    found.append(Case("whole until separation", left))
    for name, field, number, size, step in (
        ("drill_pipe", "velocity", 2.0, 0.3, 2e-5),
        ("ruler", "drop_height", 0.05, 0.001, 3e-7),
        ("rail", "drop_height", 0.1, 0.05, 2e-7),
        ("glass_fibre_rod", "angular_speed", 6.0, 0.01, 2e-6),
        ("thesis_K25_discrete", "velocity", 20.0, 1e-3, 5e-7),
        ("thesis_first_order_a0_minus700", "velocity", 3.5, 0.01, 1e-5),
    ):
        file = f"{{cases}}/{name}.toml"
        stated = hermite(
            "signorini", mesh=f"scale_free element_length={size} growth=1.02", steps=f"time_step={step} growth=0"
        )
        nudged = sets(f"impact.{field}={{n}}")
        found.append(Case(f"case {name}", run(f"{stated} {nudged}", "", file), number))
        chosen = f"simulate {file} {nudged} --json --quiet"
        loose = 0.05 if name.endswith("minus700") else 5e-3  # the moment is largest in the first, longer steps
        found.append(Case(f"chosen {name}", chosen, number, "bar", CHOSEN, loose))
    return found


def exudyn() -> list[Case]:
    """Every element, integrator and contact of the Exudyn path, on a coarse mesh."""
    found = []
    mesh = part("exudyn.mesh", "uniform element_length=0.05")
    steps = {"generalized_alpha": " time_step=2e-4", "newmark": " time_step=2e-4", "trapezoidal": " time_step=2e-4"}
    for element, integrator, contact, geometry in (
        ("ancf_cable", "generalized_alpha", "penalty hold=0 hold_start=0", "linear"),
        ("ancf_cable", "newmark", "penalty hold=0 hold_start=0", "linear"),
        ("ancf_cable", "trapezoidal", "penalty hold=0 hold_start=0", "linear"),
        ("ancf_cable", "rk44", "penalty hold=0 hold_start=0", "linear"),
        ("ancf_cable", "dopri5", "penalty hold=0 hold_start=0", "linear"),
        ("ancf_cable", "velocity_verlet", "penalty hold=0 hold_start=0", "linear"),
        ("ancf_cable", "newmark", "rigid hold=0", "linear"),
        ("ancf_cable", "generalized_alpha", "segment_friction", "true"),
        ("ancf_cable", "generalized_alpha", "penalty hold=0 hold_start=0", "true"),
        ("geometrically_exact", "generalized_alpha", "penalty hold=0 hold_start=0", "linear"),
        ("geometrically_exact", "newmark", "rigid hold=0", "linear"),
        ("geometrically_exact", "trapezoidal", "penalty hold=0 hold_start=0", "true"),
    ):
        tables = {"element": element, "integrator": integrator + steps.get(integrator, ""), "contact": contact}
        tables |= {"geometry": geometry}
        text = " ".join([mesh, *(part(f"exudyn.{table}", value) for table, value in tables.items())])
        name = f"exudyn {element} {integrator} {contact.split()[0]} {geometry}"
        found.append(Case(name, run(f"--path exudyn {sets(text)} --error-bars drift", "run.end_time=0.01")))
    return found


def against_theory() -> list[Case]:
    """Rows of ``match``, results that ``score`` judges, the theory itself, and the self-similar path."""
    found = []
    stated = hermite("signorini", mesh="scale_free element_length=1e-3 growth=1.01", steps="time_step=1e-6 growth=4e-3")
    for kappa in (0.1, 0.5, 2.0):
        row = "match --kappa-over-nu {n} --fresh --json --quiet --jobs 1 --path "
        found.append(Case(f"match {kappa}", f"{row} hermite {stated}", kappa))
        found.append(Case(f"match chosen {kappa}", row + "hermite", kappa, "bar", CHOSEN, 1e-3))
        similar = row + "self_similar --set self_similar.refine=0.5 --error-bars drift"
        found.append(Case(f"self-similar {kappa}", similar, kappa))
    first = "match --path hermite --kappa-over-nu 0.5 --first-order {n},0.5,1,-1 --fresh --json --quiet --jobs 1"
    found.append(Case("match first order", f"{first} {stated}", 4.0))
    found.append(Case("match chosen first order", first, 4.0, "bar", CHOSEN, 0.02))
    for kappa in (0.5, 2.0):
        before = run(stated, f"beam.curvature={kappa} beam.length=6 run.end_time=0.1", saved=300)
        found.append(Case(f"score {kappa}", "score {folder}/run.nc --json", before=before))
    for name in ("drill_pipe", "ruler", "rail", "thesis_K10", "thesis_K25_discrete", "thesis_first_order_a0_plus700"):
        found.append(Case(f"predict {name}", f"predict {{cases}}/{name}.toml --time 1e-4 --json --quiet"))
    for text in ("0.1", "0.5", "0.5 --alpha 4", "0.8 --psi 1 --chi -2", "0.3 --axial 2", "2"):
        number, *rest = text.split()
        found.append(Case(f"theory {text}", f"theory --kappa-over-nu {{n}} {' '.join(rest)} --json", float(number)))
    return found


def bands() -> list[Case]:
    """Undamped whole impacts: the mean of an ensemble."""
    why = "undamped, so contact is irregular and no run repeats another's"
    command = "bounce --kappa-over-nu {n} --damping 0 --runs 6 --json --quiet"
    return [Case(f"undamped {kappa}", command, kappa, "band", why, 0.02) for kappa in (0.5, 2.0)]


CASES = [*HERMITE, *whole_impacts(), *exudyn(), *against_theory(), *bands()]
