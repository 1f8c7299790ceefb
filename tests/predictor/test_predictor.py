"""The page says of the first instants what `theory` says and of a whole impact what `bounce` says; its case files mean
what it shows, those of others are read or refused by name, and it is complete in itself. Its scripts run in Node.js."""

import math
import re
import tomllib
from typing import Any

import numpy as np
import pytest
from called import command, refused
from here import CASES, ROOT
from histories import ROD
from page_scripts import evaluated

from bent_beam.cases import case_from_tables
from bent_beam.errors import InputError
from bent_beam.impact import Impact
from bent_beam.measure.numbers import Number
from bent_beam_programs.predictor.page import page
from comparison.bouncing import bounce
from comparison.doubts import comparable
from comparison.whole_numbers import FINAL
from theory import predict as theory_predict

NAMES = {"stiffness": "bending_stiffness", "mass": "mass_per_length", "length": "length", "curvature": "curvature",
         "velocity": "velocity", "acceleration": "acceleration", "tension": "axial_force", "damping": "damping",
         "wallCurvature": "wall_curvature", "naturalCurvature": "natural_curvature", "shear": "shear_stiffness",
         "turning": "rotary_inertia", "wallStiffness": "wall_stiffness", "wallDamping": "wall_damping"}  # fmt: skip


def in_si(impact: Impact, name: str) -> float:
    """A field as the page has it: 0 for none, the whole bow where no stress-free one is stated."""
    value = getattr(impact, name)
    return float(impact.curvature if value is None and name == "natural_curvature" else value or 0.0)


def random_impacts(count: int) -> list[Impact]:
    """Beams from wire to girder: every regime, with and without loads, damping, shear, and a wall that gives way."""
    rng, impacts = np.random.default_rng(21), []
    for _ in range(count):
        stiffness, mass, velocity = 10.0 ** rng.uniform((-2.0, -2.0, -1.0), (8.0, 3.0, 1.0))
        scale = np.sqrt(stiffness / mass) / velocity
        near_one = 1.0 - 10.0 ** rng.uniform(-8.0, -1.0)
        ratio = rng.choice([1.0 - rng.random(), 10.0 ** rng.uniform(-4.0, 1.0), near_one], p=[0.6, 0.3, 0.1]).item()
        impact = Impact(stiffness, mass, 10.0 ** rng.uniform(0.0, 3.0) * scale, ratio / scale, velocity)
        loads = rng.normal(size=2) * (rng.random(2) < 0.5) * 10.0 ** rng.uniform(-3.0, 0.5)
        sheared = (rng.random() < 0.5) * 10.0 ** rng.uniform(-3.0, -1.0) * impact.half_length
        wall = (rng.random() < 0.1) * 10.0 ** rng.uniform(2.0, 6.0) * stiffness / impact.half_length**4
        impacts.append(
            impact.replace(
                acceleration=loads[0] * velocity / impact.time_scale,
                axial_force=loads[1] * mass * velocity**2,
                damping=(rng.random() < 0.5) * 10.0 ** rng.uniform(-6.0, -0.5) * impact.slow_time_scale,
                wall_curvature=(rng.random() < 0.3) * rng.uniform(-2.0, 0.9) * impact.curvature,
                natural_curvature=rng.choice([1.0, 0.0, 0.4]) * impact.curvature,
                shear_stiffness=stiffness / sheared**2 if sheared else None,
                rotary_inertia=rng.uniform(0.1, 0.4) * mass * sheared**2,
                wall_stiffness=wall or None,
                wall_damping=rng.choice([0.0, 0.5]) * 2.0 * math.sqrt(wall * mass),
            )
        )
    return impacts


@pytest.mark.parametrize(("walls", "count"), [(2, 25), pytest.param(8, 40, marks=pytest.mark.verify)])
def test_page_is_the_theory_on_random_beams(walls: int, count: int) -> None:
    shares, area, modulus = [0.003, 0.03, 0.3], 2.0, 0.5
    pointed = 10.0 ** np.random.default_rng(22).uniform(0.0, 2.0, walls)  # few of the others stand before a wall
    impacts = [Impact.dimensionless(ratio).replace(wall_stiffness=1e10) for ratio in pointed] + random_impacts(count)
    section = {"area": area, "modulus": modulus, "yieldStress": None}
    beams = [{here: in_si(i, there) for here, there in NAMES.items()} | section for i in impacts]
    solved = "given.beams.map((b) => { const p = Instants.solve(b);"
    solved += " return {...p, at: given.shares.map((share) => Instants.at(p, share * p.timeScale))}; })"
    causes, compared, unknown = set(), 0, 0
    for impact, answer in zip(impacts, evaluated(solved, {"beams": beams, "shares": shares}), strict=True):
        said, limits = theory_predict(impact, [share * impact.time_scale for share in shares]), answer["limits"]
        causes |= {said.limited_by, said.valid_after}
        assert (answer["contact"]["regime"], limits["by"], limits["after"]) == (
            said.regime, said.limited_by, said.valid_after)  # fmt: skip
        times = (said.valid_from, said.valid_until, said.force_until)
        assert (limits["from"], limits["until"], limits["forceUntil"]) == pytest.approx(times, rel=1e-3)
        if impact.damping == 0.0 or said.valid_until == 0.0:  # else of the end of the range; the page says it at times
            stress = said.peak_moment / modulus + abs(impact.axial_force) / area
            assert (answer["moment"], answer["stress"]) == pytest.approx((said.peak_moment, stress), rel=1e-9)
        for row, at in zip(said.times, answer["at"], strict=True):
            assert at["exists"] == (row.impulse is not None)
            if row.impulse is None:
                continue
            assert (at["moment"] is None) == (row.peak_moment is None)
            unknown += row.peak_moment is None
            root = math.sqrt(impact.wave_constant * row.time)
            momentum = impact.mass_per_length * impact.velocity * root
            units = {"halfLength": root, "force": momentum / row.time, "impulse": momentum, "moment": 0.0}
            values = (row.half_contact_length, row.reaction, row.impulse, row.peak_moment)
            for (name, unit), value in zip(units.items(), values):
                assert value is None or at[name] == pytest.approx(value, rel=1e-6, abs=1e-6 * unit), name
                compared += value is not None
    assert {"shear", "wall", "damping", "waves back from the ends", "slope", "first-order correction"} <= causes
    assert compared > 5 * (walls + count) and unknown > 3


def random_inputs(count: int, seed: int) -> list[dict[str, Any]]:
    """What somebody might type, in every combination of ways to say it."""
    rng, found = np.random.default_rng(seed), []
    for _ in range(count):
        length, kind = 10.0 ** rng.uniform(-0.5, 1.3), rng.integers(3)
        height = length / 10.0 ** rng.uniform(1.3, 2.3)
        modulus, density = [(70e9, 2700.0), (206e9, 7850.0), (40e9, 2000.0)][kind]
        velocity, stiffness = 10.0 ** rng.uniform(-0.5, 0.7), modulus * height**4 / 20.0
        curvature = 10.0 ** rng.uniform(-0.6, 0.5) * velocity / (math.sqrt(modulus / density) * height / 3.5)
        wall = (rng.random() < 0.3) * 10.0 ** rng.uniform(2.0, 5.0) * stiffness / (0.5 * length) ** 4
        choices = {"section": ["pipe", "round_bar", "rectangle", "general"], "bow": ["curvature", "sagitta", "dogleg"],
                   "approach": ["velocity", "drop"], "model": ["timoshenko", "timoshenko", "euler_bernoulli"],
                   "natural_share": [1.0, 1.0, 0.5], "wall_curvature": [0.0, 0.0, -0.1 * curvature],
                   "fluid_density": [0.0, 1100.0], "added_mass": [0.0, 0.03 * density * height**2],
                   "load": [0.0, 0.0, -0.3 * density * height**2], "wall_damping_ratio": [0.0, 0.3]}  # fmt: skip
        sizes = {"outer_diameter": height, "inner_diameter": height * rng.uniform(0.5, 0.93), "diameter": height,
                 "thickness": height, "width": height * rng.uniform(0.3, 3.0), "area_of_section": 0.5 * height**2,
                 "second_moment_of_area": 0.05 * height**4, "section_height": height, "youngs_modulus": modulus,
                 "density": density, "length": length, "curvature": curvature, "dogleg": curvature,
                 "sagitta": curvature * length**2 / 8.0, "velocity": velocity,
                 "drop_height": velocity**2 / 19.6, "damping_ratio": 10.0 ** rng.uniform(-3.0, -1.3),
                 "tension": (rng.random() < 0.2) * rng.uniform(-2.0, 8.0) * stiffness / length**2}  # fmt: skip
        drawn = {name: rng.choice(values).item() for name, values in choices.items()}
        drawn |= {name: float(value) for name, value in sizes.items()}
        drawn |= {"wall_stiffness": float(wall) or None, "gravity": [None, None, 9.81][rng.integers(3)]}
        found.append(drawn)
    return found


def test_a_case_means_what_the_page_shows_and_is_read_back() -> None:
    inputs = [{}, {"damping_ratio": None}, {"damping_ratio": 0.0}, *random_inputs(60, 25)]
    expression = """given.map((typed) => {
        const i = {...Beam.START, ...typed}, b = Beam.impact(i), text = Case.toml(i, b);
        return {wrong: Beam.complaints(i), text, b, again: Beam.impact(Case.read(text))}; })"""
    for row in evaluated(expression, inputs):
        if row["wrong"]:
            continue
        case = case_from_tables(tomllib.loads(row["text"]))
        for here, there in NAMES.items():
            value = in_si(case.impact, there)
            assert (row["b"][here] or 0.0) == pytest.approx(value, rel=1e-12, abs=1e-12), (here, row["text"])
            assert (row["again"][here] or 0.0) == pytest.approx(value, rel=1e-9, abs=1e-9), (here, row["text"])
        assert case.damping_stated == (row["b"]["damping"] is not None) == (row["again"]["damping"] is not None)
        for here, there in {"modulus": "section_modulus", "area": "area"}.items():
            assert row["b"][here] == pytest.approx(getattr(case.section, there), rel=1e-12)


READ = "given.map((text) => { try { return Beam.impact(Case.read(text)); } catch (error) { return error.message; } })"


def test_cases_are_read_and_what_the_page_lacks_is_refused_by_name() -> None:
    """A drop is under standard gravity where none is stated; at 100° it draws away from the wall."""
    texts = {name: (CASES / f"{name}.toml").read_text(encoding="utf-8")
             for name in ("tube", "drill_pipe", "rail", "ruler", "tube_between_plates")}  # fmt: skip
    for fall in ("drop_height = 0.05\ngravity_angle = 30.0", "velocity = 1.0\ngravity = 9.81\ngravity_angle = 100.0"):
        texts[fall] = ROD.replace("velocity = 1.0", fall)
    texts["misspelt"] = texts["tube"].replace("\nlength", "\nlenght")
    texts["nonsense"] = texts["tube"].replace("[run]", "[exudyn]\nrun = true\n[run]")
    found = dict(zip(texts, evaluated(READ, list(texts.values())), strict=True))
    of_simulate = "(bentbeam simulate takes them if they are spelled right)"
    between = f"beam.ends, wall.from, wall.to are not on this page {of_simulate}"
    assert found.pop("tube_between_plates") == between
    misspelt = "beam.lenght is not on this page (bentbeam simulate takes it if it is spelled right)"
    assert found.pop("misspelt") == misspelt
    assert "run = true is not a number" in found.pop("nonsense")
    for name, read in found.items():
        impact = case_from_tables(tomllib.loads(texts[name])).impact
        for here, there in NAMES.items():
            assert (read[here] or 0.0) == pytest.approx(in_si(impact, there), rel=1e-9), (name, here)


GENERAL = 'kind = "general"\narea_of_section = 1e-4\nsecond_moment_of_area = 1e-9\nsection_height = 0.01'
REFUSED = [  # instead of a line of the rod, another: what the page says
    ("density = 7850.0", "", "section.density is missing"),
    ("diameter = 0.02", "", "section.diameter is missing"),
    ('kind = "round_bar"\ndiameter = 0.02', GENERAL, "beam.model = timoshenko needs a section with a shape"),
    ("diameter = 0.02", "diameter = 0.02\nwidth = 0.1", "section.width is none of a round_bar"),
    ("sagitta = 0.01", "", "give one of beam.sagitta, beam.curvature, beam.dogleg"),
    ("sagitta = 0.01", "sagitta = 0.01\ncurvature = 0.1", "give one of beam.sagitta"),
    ("sagitta = 0.01", "curvature = 0.1\nsagitta_length = 0.5", "sagitta_length has no effect"),
    ("velocity = 1.0", "", "give one of impact.velocity, impact.drop_height"),
    ("velocity = 1.0", "velocity = 1.0\ngravity = 9.81\nacceleration = 1.0", "say the same"),
    ("velocity = 1.0", "velocity = 1.0\ngravity_angle = 30.0", "gravity_angle has no effect"),
    ("velocity = 1.0", "velocity = 1.0\n[wall]\ndamping_ratio = 0.1", "wall.damping_ratio has no effect"),
]


def test_the_page_makes_nothing_up_of_a_case_that_bentbeam_refuses() -> None:
    sheared = ROD.replace("length", 'model = "timoshenko"\nlength')  # a general section has no shear
    texts = [(sheared if other == GENERAL else ROD).replace(line, other) for line, other, _ in REFUSED]
    for text, (_, _, said), found in zip(texts, REFUSED, evaluated(READ, texts), strict=True):
        with pytest.raises(InputError):
            case_from_tables(tomllib.loads(text))
        assert said in found


KNOWN = "bending_stiffness = 1600.0\nmass_per_length = 2.4\n"
BARE = f"[beam]\n{KNOWN}length = 1.0\nsagitta = 0.01\ndamping_ratio = 0.02\n[impact]\nvelocity = 1.0"


def test_of_a_beam_that_shears_without_a_shape_the_page_names_commands_that_take_it() -> None:
    """And no section without shear, which is what it advises of a beam that has none."""
    shear = "shear_stiffness = 1e7\n"
    general = ROD.replace('kind = "round_bar"\ndiameter = 0.02', GENERAL).replace("length", f"{shear}length")
    plain, sheared, of_section = evaluated(READ, [BARE, BARE.replace(KNOWN, KNOWN + shear), general])
    assert plain.endswith('beam.mass_per_length are not on this page: give a [section] of kind "general" instead')
    for said in (sheared, of_section):
        assert "beam.shear_stiffness" in said and "general" not in said
        assert said.endswith(
            "this page knows shear only for a section with a shape: take bentbeam predict or bentbeam bounce"
        )
    case = case_from_tables(tomllib.loads(general))
    assert (
        case.impact.shear_stiffness == 1e7 and comparable(case.impact) and bounce(case, case.method("hermite")).numbers
    )


def page_and_bounce(inputs: list[dict[str, Any]], share: float = 1.0) -> tuple[int, list[str]]:
    """How many numbers of whole impacts were compared, and those that differ by more than this share of both bars."""
    expression = """given.map((typed) => {
        const i = {...Beam.START, ...typed}, b = Beam.impact(i), p = Beam.problem(b, b.damping), runs = {};
        for (const [name, how] of Object.entries(Answer.runs(p))) runs[name] = Solver.simulate(p, how);
        const leaves = Object.values(runs).map((run) => run.restitution !== null);
        return {wrong: Beam.complaints(i), text: Case.toml(i, b), numbers: Answer.numbers(p, runs), leaves}; })"""
    names = {"restitution": "restitution", "lastContact": "last_contact", "impulse": "impulse"}
    names |= {"moment": "peak_moment", "force": "peak_force"}
    compared, missed = 0, []
    for row in (row for row in evaluated(expression, inputs) if not row["wrong"]):
        case = case_from_tables(tomllib.loads(row["text"]))
        answer = bounce(case, case.method("hermite"))
        said, leaves = answer.numbers, {*row["leaves"], *(run.reading["left"] for run in answer.runs.every)}
        unsure = FINAL if len(leaves) == 2 else ()  # a flight about as long as the period that makes two hits of one
        for here, there in ((here, there) for here, there in names.items() if there in said and there not in unsure):
            one, other = Number(row["numbers"][here]["value"], row["numbers"][here]["bar"]), said[there]
            assert one.measured == (other.value is not None), (there, row["text"])
            if other.value is None:
                continue
            compared += 1
            if abs(one.known - other.value) > share * (one.spread + (other.bar or 0.0)):
                missed.append(f"{there}: page {one}, bounce {other}, of\n{row['text']}")
    return compared, missed


RUBBER = {"wall_stiffness": 2e5, "wall_damping_ratio": 0.2}


@pytest.mark.parametrize(
    "wall", [{}, *(pytest.param(RUBBER | more, marks=pytest.mark.verify) for more in ({}, {"damping_ratio": 0.0}))]
)
def test_a_whole_impact_is_that_of_bounce_within_bars(wall: dict[str, float]) -> None:
    """A sheared tube, slower and with more damping than at the start, on a floor or on a rubber mat. On the floor the
    schemes are the same."""
    tube = {"velocity": 0.4, "damping_ratio": 0.02, "gravity": None} | wall
    compared, missed = page_and_bounce([tube], 1.0 if wall else 0.1)
    assert compared == 4 + bool(wall) and not missed


@pytest.mark.verify
def test_twenty_random_beams_bounce_on_the_page_as_in_bounce() -> None:
    seed = int(np.random.default_rng().integers(10**6))
    print(f"seed {seed}")
    compared, missed = page_and_bounce(random_inputs(20, seed))
    assert compared > 40
    assert len(missed) <= 0.05 * compared, f"seed {seed}: " + "\n".join(missed)


def test_page_is_one_small_file_that_names_no_other_and_is_written_once(tmp_path):
    """That it asks for nothing is seen in a browser (``test_predictor_browser.py``)."""
    file = tmp_path / "new" / "predictor.html"
    assert command("predictor", "--out", file)[:2] == (0, f"{file}: open it in a browser\n")
    text = file.read_text(encoding="utf-8")
    assert len(text.encode()) < 400_000
    assert set(re.findall(r"https?://[^\s\"'<>]+", text)) == {"http://www.w3.org/2000/svg"}  # a name, no request
    assert "overwrite" in refused("predictor", "--out", file)
    assert command("predictor", "--out", file, "--overwrite")[0] == 0


def test_the_page_of_the_guide_is_what_the_command_writes() -> None:
    """The words to the letter; the numbers but for rounding, which a fit enlarges to 4e-9 between machines."""
    number = re.compile(r"-?\d+(?:\.\d+)?(?:e-?\d+)?")
    shipped, current = (ROOT / "docs" / "predictor.html").read_text(encoding="utf-8"), page()
    assert number.sub("#", shipped) == number.sub("#", current), "bentbeam predictor --out … --overwrite"
    old, new = ([float(v) for v in number.findall(text)] for text in (shipped, current))
    assert old == pytest.approx(new, rel=1e-6, abs=1e-7)  # coefficients of fits of order one
