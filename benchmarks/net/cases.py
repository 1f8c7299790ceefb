"""The cases of the net, as data: commands of ``bentbeam``, and how closely their answers are held.

Three classes. ``same``: every number comes again to 1e-9 of the size of its family, or to 30 times what a nudge of the
input by 1e-13 changed when the answers were recorded. ``bar``: the settings are the program's own and may become
better ones, so the numbers stay within their recorded error bars, or within ``relative`` where there is none. ``band``:
an undamped whole impact is irregular, so its means stay within what so few runs allow.
"""

from __future__ import annotations

import shlex
from dataclasses import dataclass
from itertools import product
from pathlib import Path

__all__ = ["CASES", "Case"]

HERE = Path(__file__).parent
CASE_FILES = HERE.parents[1] / "cases"


@dataclass(frozen=True)
class Case:
    """One case of the net.

    command : of ``bentbeam``; ``{n}`` stands for ``number``, which the recording nudges, ``{folder}`` for a place for
    files. before : a command that has to run first. kind : same, bar or band. relative : tolerance of a number without
    an error bar, and the least of one with it (not of ``same``).
    """

    name: str
    command: str
    number: float = 1.0
    kind: str = "same"
    reason: str = "every setting is stated"
    relative: float = 0.0
    before: str = ""

    def arguments(self, folder: Path, nudge: float = 0.0) -> list[list[str]]:
        """The commands as lists of words."""
        fill = {"n": repr(self.number * (1.0 + nudge)), "folder": str(folder), "cases": str(CASE_FILES)}
        return [shlex.split(line.format(**fill)) for line in (self.before, self.command) if line]


def sets(text: str) -> str:
    """``a.b=1 c.d=2`` as ``--set`` options."""
    return " ".join(f"--set {shlex.quote(word)}" for word in text.split())


def part(table: str, text: str) -> str:
    """``kind field=value`` of one table as assignments."""
    kind, *fields = text.split()
    return " ".join([f"{table}.kind={kind}", *(f"{table}.{field}" for field in fields)])


# parts of the Hermite path --------------------------------------------------------------------------------------------
UNIFORM, FINE = "uniform element_length=0.02", "scale_free element_length=0.002 growth=1.02"
CONSTANT, GROWING = "time_step=5e-5 growth=0", "time_step=1e-6 growth=0.01"
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
RATTLES = {("moreau-half", 0.5, "middle"), *product(("signorini-half",), (0.5, 2.0), ("node", "middle", "mean"))}


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
    """A ``simulate`` whose history is kept; the velocity is the number."""
    file, speed = (file, "") if file else (str(HERE / "unit.toml"), "impact.velocity={n} ")
    return f"simulate {file} {sets(speed + settings)} {options} --save {saved} --out {{folder}}/run.nc --json --quiet"


def short(name: str, integrator: str, settings: str = "", **parts: str) -> Case:
    """A short run of the Hermite path."""
    return Case(f"hermite {name} {integrator}", run(hermite(integrator, **parts), settings))


def every_pair() -> list[Case]:
    """Every integrator with every contact: constant steps below κ/ν = 1, growing ones above it."""
    found = []
    for (name, kappa), contact in product(product(INTEGRATORS, (0.5, 2.0)), ("node", "middle", "mean")):
        if name == "penalty" and contact != "node":
            continue  # it takes no other
        calm = " beam.damping=1e-2" if (name, kappa, contact) in RATTLES else ""
        parts = {"mesh": UNIFORM, "steps": CONSTANT} if kappa < 1.0 else {"mesh": FINE, "steps": GROWING}
        law = f"{contact} restitution=0{STRICT}"
        found.append(short(f"{kappa} {contact}", name, f"beam.curvature={kappa}{calm}", contact=law, **parts))
    for name in INTEGRATORS:
        found.append(short("0.5 fine", name, mesh=FINE, steps=GROWING))
    return found


def variants() -> list[Case]:
    """What else a short run can have: each with the schemes that treat it differently."""
    found = []
    for e, name in product((0.5, 1.0), ("moreau", "moreau-half", "alpha-v", "alpha-pva")):
        found.append(short(f"restitution {e}", name, contact=f"node restitution={e}{STRICT}"))
    for name in ("moreau", "signorini", "alpha-pva"):
        found.append(short("lumped", name, mass="lumped rotary=0.0128"))
        found.append(short("full beam", name, more="hermite.full_beam=true"))
        found.append(short("hold 3", name, contact="node restitution=0 hold=3 hold_until=0"))
        found.append(short("hold until", name, contact="middle restitution=0 hold=0 hold_until=0.002"))
        found.append(short("refined", name, more="hermite.refine=1.5"))
    for name in ("moreau-half", "alpha-pva"):
        sponge = "sponge end=free viscosity=0.3 strength=0.03 width=0.5"
        found.append(short("sponge", name, far_field=sponge))
        follow = "viscosity end=following viscosity=0.3"
        found.append(short("domain", name, "impact.acceleration=1", far_field=follow, more="hermite.domain=0.6"))
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



def whole_impacts() -> list[Case]:
    """Damped whole impacts, two walls, and beams of the real cases on stated settings."""
    parts = hermite("signorini-half", steps="time_step=2e-4 growth=0", far_field="viscosity end=free viscosity=0")
    found = []
    for kappa, damping in product((0.5, 1.5, 2.0, 4.0), (1e-2, 1e-3)):
        command = f"bounce --kappa-over-nu {{n}} --damping {damping} {parts} --json --quiet"
        found.append(Case(f"bounce {kappa} damping {damping}", command, kappa))
    walls = str(CASE_FILES / "two_walls.toml")
    for name, distance in product(("signorini-half", "moreau", "alpha-pva"), (1.0, 0.7)):
        stated = hermite(name, mesh="uniform element_length=0.05", steps="time_step=1e-3 growth=0")
        more = sets("impact.velocity={n} wall.opposite=" + str(distance))
        found.append(Case(f"two walls {distance} {name}", run(f"{stated} {more}", "run.end_time=6", walls)))
    calm = hermite("signorini-half", mesh="uniform element_length=0.02", steps="time_step=2e-4 growth=0")
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
        file = str(CASE_FILES / f"{name}.toml")
        stated = hermite("signorini", mesh=f"scale_free element_length={size} growth=1.02", steps=f"time_step={step} growth=0")
        nudged = sets(f"impact.{field}={{n}}")
        found.append(Case(f"case {name}", run(f"{stated} {nudged}", "", file), number))
        chosen = f"simulate {file} {nudged} --json --quiet"
        found.append(Case(f"chosen {name}", chosen, number, "bar", "mesh, steps and contact are chosen", 5e-3))
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
        ("ancf_cable", "generalized_alpha", "rigid hold=0", "linear"),
        ("ancf_cable", "generalized_alpha", "segment_friction", "true"),
        ("ancf_cable", "generalized_alpha", "penalty hold=0 hold_start=0", "true"),
        ("geometrically_exact", "generalized_alpha", "penalty hold=0 hold_start=0", "linear"),
        ("geometrically_exact", "newmark", "rigid hold=0", "linear"),
        ("geometrically_exact", "generalized_alpha", "segment_friction", "true"),
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
        row = f"match --path {{path}} --kappa-over-nu {{{{n}}}} --fresh --json --quiet --jobs 1"
        found.append(Case(f"match {kappa}", row.format(path="hermite") + " " + stated, kappa))
        name, why = f"match chosen {kappa}", "mesh, steps and contact are chosen"
        found.append(Case(name, row.format(path="hermite"), kappa, "bar", why, 1e-3))
        similar = row.format(path="self_similar") + " --set self_similar.refine=0.5 --error-bars drift"
        found.append(Case(f"self-similar {kappa}", similar, kappa))
    first = "match --path hermite --kappa-over-nu 0.5 --first-order {n},0.5,1,-1 --fresh --json --quiet --jobs 1"
    found.append(Case("match first order", f"{first} {stated}", 4.0))
    found.append(Case("match chosen first order", first, 4.0, "bar", "mesh, steps and contact are chosen", 0.02))
    for kappa in (0.5, 2.0):
        before = run(stated, f"beam.curvature={kappa} beam.length=6 run.end_time=0.1", saved=300)
        found.append(Case(f"score {kappa}", "score {folder}/run.nc --json", before=before))
    for name in ("drill_pipe", "ruler", "rail", "thesis_K10", "thesis_K25_discrete", "thesis_first_order_a0_plus700"):
        found.append(Case(f"predict {name}", f"predict {CASE_FILES / name}.toml --time 1e-4 --json --quiet"))
    for text in ("0.1", "0.5", "0.5 --alpha 4", "0.8 --psi 1 --chi -2", "0.3 --axial 2", "2"):
        kappa, *rest = text.split()
        found.append(Case(f"theory {text}", f"theory --kappa-over-nu {{n}} {' '.join(rest)} --json", float(kappa)))
    return found


def bands() -> list[Case]:
    """Undamped whole impacts: the mean of an ensemble."""
    why = "undamped, so contact is irregular and no run repeats another's"
    command = "bounce --kappa-over-nu {n} --damping 0 --runs 6 --json --quiet"
    return [Case(f"undamped {kappa}", command, kappa, "band", why) for kappa in (0.5, 2.0)]


CASES = [*every_pair(), *variants(), *whole_impacts(), *exudyn(), *against_theory(), *bands()]
