"""The predictor's numbers are those of `theory` and of the stored map, and its file is complete in itself."""

import json
import math
import re
import shutil
import subprocess
import tomllib
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from bent_beam.cases import case_from_tables, load_case
from bent_beam.impact import Impact
from bent_beam.measure.numbers import Number
from bent_beam_programs.predictor.page import page, script, write_page
from comparison.command_line.app import run
from theory import ContactParameters, SelfSimilarWave, contact_parameters
from theory import predict as theory_predict
from theory.elastic_wall import peak_force
from theory.similarity import peak_moment
from theory.validity import shear_times

ROOT = Path(__file__).parents[2]
SAME = 1e-9
needs_node = pytest.mark.skipif(shutil.which("node") is None, reason="Node.js is not installed")


def evaluated(expression: str, argument: Any) -> Any:
    """What the page's scripts make of ``expression`` with ``given``, JSON in and out."""
    parts = [script(("theory.js", "limits.js", "beam.js", "case.js", "draw.js"))]
    parts += [f"const given = {json.dumps(argument)};", f"console.log(JSON.stringify({expression}));"]
    done = subprocess.run(["node", "-"], input="\n".join(parts), capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def random_impacts(count: int) -> list[Impact]:
    """Beams from wire to girder: every regime, an acceleration and an axial force or none, damped or not."""
    rng, impacts = np.random.default_rng(21), []
    for _ in range(count):
        stiffness, mass, velocity = 10.0 ** rng.uniform((-2.0, -2.0, -1.0), (8.0, 3.0, 1.0))
        scale = np.sqrt(stiffness / mass) / velocity
        near_one = 1.0 - 10.0 ** rng.uniform(-12.0, -1.0)
        ratio = rng.choice([1.0 - rng.random(), 10.0 ** rng.uniform(-12.0, 2.0), near_one], p=[0.7, 0.2, 0.1]).item()
        impact = Impact(stiffness, mass, 10.0 ** rng.uniform(0.0, 2.0) * scale, ratio / scale, velocity)
        loads = rng.normal(size=2) * (rng.random(2) < 0.7)
        impacts.append(
            impact.replace(
                acceleration=loads[0] * velocity / impact.time_scale,
                axial_force=loads[1] * mass * velocity**2,
                damping=(rng.random() < 0.5) * 10.0 ** rng.uniform(-6.0, -0.5) * impact.slow_time_scale,
                wall_curvature=(rng.random() < 0.3) * rng.uniform(-2.0, 0.9) * impact.curvature,
                natural_curvature=rng.choice([1.0, 0.0, rng.normal()]) * impact.curvature,
            )
        )
    return impacts


NAMES = {"stiffness": "bending_stiffness", "mass": "mass_per_length", "length": "length", "curvature": "curvature",
         "velocity": "velocity", "acceleration": "acceleration", "tension": "axial_force", "damping": "damping",
         "wallCurvature": "wall_curvature", "naturalCurvature": "natural_curvature"}  # fmt: skip
AREA, MODULUS, SHEAR = 2.0, 0.5, 1e4
X = np.linspace(0.0, 10.0, 21)


def answers(impacts: list[Impact], **more: float) -> list[dict[str, Any]]:
    section = {"area": AREA, "modulus": MODULUS, "shear": SHEAR} | more
    beams = [{here: getattr(i, there) for here, there in NAMES.items()} | section for i in impacts]
    return evaluated(
        "given.beams.map((b) => { const p = Beam.solve(b);"
        " return {...p, at: Beam.at(p, 0.1 * p.timeScale), gap: given.x.map((x) => Theory.gap(p.contact, x))}; })",
        {"beams": beams, "x": X.tolist()},
    )


def limits(impact: Impact, exact: ContactParameters, lambda0: float) -> tuple[float | None, float]:
    """From and until when (s), by the formulas; ``None``: a damped or flat zone."""
    point, tension, wave = exact.lambda0 == 0.0, impact.epsilon_axial, SelfSimilarWave(exact)
    of_r, of_lambda = tension * exact.r_axial, tension * exact.lambda_axial
    change = (abs(exact.r1 - of_r) + abs(of_r)) / exact.r0
    if not point:
        change = max(change, (abs(exact.lambda1 - of_lambda) + abs(of_lambda)) / exact.lambda0)
    steepest = np.abs(wave.slope(np.linspace(exact.lambda0, peak_moment(impact.kappa_over_nu).place, 1001))).max()
    until = [impact.slow_time_scale / max(exact.lambda0 + 10.0, 3.0 * exact.lambda0) ** 2]
    until += [np.sqrt(0.02) / change * impact.time_scale] if change else []
    until += [12.0 * 0.02 / steepest**2 * impact.time_scale]
    if not point and (impact.damping or impact.kappa_over_nu < 0.05):
        return None, min(until)
    sheared = math.sqrt(impact.bending_stiffness * impact.mass_per_length) / SHEAR
    return max(shear_times(replace(exact, lambda0=lambda0)) * sheared, 6.25 * impact.damping), min(until)


@needs_node
def test_page_is_the_theory_on_random_beams() -> None:
    impacts, regimes, compared = random_impacts(60), set(), 0
    for impact, found in zip(impacts, answers(impacts), strict=True):
        exact = contact_parameters(impact.kappa_over_nu, impact.epsilon_alpha, axial=impact.epsilon_axial)
        contact, wave = found["contact"], SelfSimilarWave(contact_parameters(impact.kappa_over_nu))
        assert contact["regime"] == exact.regime
        regimes.add(exact.regime)
        size = contact["change"]  # λ₁ and r₁ may be small differences of what the two loads do
        for name in ("lambda0", "r0", "lambda1", "r1", "uniform"):
            value = getattr(exact, {"uniform": "uniform_reaction"}.get(name, name))
            scale = max(abs(value), size * exact.r0, abs(impact.epsilon_alpha), 1.0)
            assert contact[name] == pytest.approx(value, rel=SAME, abs=SAME * scale), name
        gap = np.where(X > exact.lambda0, wave.deflection(X) - 1.0 + impact.kappa_over_nu * X**2 / 2.0, 0.0)
        assert found["gap"] == pytest.approx(gap, rel=1e-8, abs=1e-8)
        begins, until = limits(impact, exact, contact["lambda0"])
        assert found["limits"]["until"] == pytest.approx(until, rel=1e-6)
        assert found["limits"]["from"] == (None if begins is None else pytest.approx(begins, rel=SAME))

        time = 0.1 * impact.time_scale
        said, last = theory_predict(impact.replace(damping=0.0), time), found["at"]
        root = (impact.bending_stiffness / impact.mass_per_length) ** 0.25 * math.sqrt(time)
        impulse = impact.mass_per_length * impact.velocity * root * max(exact.r0, 1.0) * max(size, 1.0)
        row, pairs = said.times[0], (("halfLength", root * max(size, 1.0)), ("reaction", impulse / time))
        for name, unit in (*pairs, ("impulse", impulse)):
            value = row.half_contact_length if name == "halfLength" else getattr(row, name)
            if value is not None:  # the expansion has not broken down
                assert last[name] == pytest.approx(value, rel=SAME, abs=SAME * unit), name
                compared += 1
        assert last["moment"] == pytest.approx(said.peak_moment, rel=SAME)
        assert last["stress"] == pytest.approx(said.peak_moment / MODULUS + abs(impact.axial_force) / AREA, rel=SAME)
    assert regimes == {"continuous", "detached", "discrete"} and compared > 90


@needs_node
def test_the_largest_force_on_a_wall_that_gives_way_is_that_of_the_theory() -> None:
    ratios = [0.003, 30.0]  # that of the impact lies between
    exact = [peak_force(ratio).value for ratio in ratios]
    assert evaluated("given.map((ratio) => Theory.peakForce(ratio))", ratios) == pytest.approx(exact, rel=3e-4)
    impact = Impact(2.0, 3.0, 1e3, 0.4, 0.5, wall_stiffness=7.0)
    given = answers([impact], wallStiffness=7.0)[0]
    assert given["peakForce"] == pytest.approx(theory_predict(impact).peak_force, rel=3e-4)


def random_inputs(count: int) -> list[dict[str, Any]]:
    """What somebody might type, in every combination of ways to say it."""
    rng, found = np.random.default_rng(25), []
    for _ in range(count):
        outer, length = 10.0 ** rng.uniform(-3.0, -0.5), 10.0 ** rng.uniform(-0.5, 2.0)
        choices = {"section": ["pipe", "round_bar", "rectangle"], "bow": ["curvature", "sagitta", "dogleg"],
                   "approach": ["velocity", "drop"], "fluid_density": [0.0, 1100.0], "added_mass": [0.0, 0.3],
                   "natural_share": [1.0, 0.0, 0.4], "wall_curvature": [0.0, -0.01, 1e-9],
                   "damping_ratio": [0.0, 0.01], "tension": [0.0, 300.0, -20.0], "load": [0.0, 7.0, -7.0],
                   "wall_stiffness": [0.0, 2e7]}  # fmt: skip
        sizes = {"outer_diameter": outer, "inner_diameter": outer * rng.uniform(0.1, 0.99), "diameter": outer,
                 "thickness": outer, "width": outer * rng.uniform(0.2, 20.0), "length": length,
                 "curvature": 10.0 ** rng.uniform(-4.0, 0.0) / length, "dogleg": 10.0 ** rng.uniform(-4.0, -1.0),
                 "sagitta": length * 10.0 ** rng.uniform(-5.0, -1.0), "velocity": 10.0 ** rng.uniform(-2.0, 1.0),
                 "sagitta_length": length * rng.uniform(0.3, 1.0), "drop_height": rng.uniform(0, 9)}  # fmt: skip
        found.append({name: rng.choice(values).item() for name, values in choices.items()} | sizes)
    return found


@needs_node
def test_case_means_what_the_page_shows() -> None:
    inputs = [{}, *random_inputs(60)]
    expression = """given.map((typed) => { const i = {...Beam.START, ...typed}, b = Beam.impact(i), p = Beam.solve(b);
        return {wrong: Beam.complaints(i), case: Case.toml(i, b, p), b, until: p.shownUntil}; })"""
    found = evaluated(expression, inputs)
    for given, row in zip(inputs, found, strict=True):
        buckled = row["b"]["tension"] < -((math.pi / row["b"]["length"]) ** 2) * row["b"]["stiffness"]
        if buckled or (given.get("bow") == "sagitta" and given["sagitta"] >= given["sagitta_length"] / 2.0):
            assert row["wrong"]
            continue
        assert row["wrong"] == []
        case = case_from_tables(tomllib.loads(row["case"]))
        for here, there in NAMES.items():
            value = getattr(case.impact, there)
            value = case.impact.curvature if value is None else value
            assert row["b"][here] == pytest.approx(value, rel=1e-12, abs=1e-12), (here, row["case"])
        assert (row["b"]["wallStiffness"] or None) == case.impact.wall_stiffness
        assert case.end_time == row["until"]
        assert case.section is not None
        for here, there in {"modulus": "section_modulus", "area": "area", "shear": "shear_stiffness"}.items():
            assert row["b"][here] == pytest.approx(getattr(case.section, there), rel=1e-12)
    start, shipped = case_from_tables(tomllib.loads(found[0]["case"])).impact, load_case(ROOT / "cases/drill_pipe.toml")
    for name in ("kappa_over_nu", "bending_stiffness", "length"):
        assert getattr(start, name) == pytest.approx(getattr(shipped.impact, name), rel=1e-9)


def test_page_is_one_small_file_that_asks_for_nothing_and_is_written_once(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "new" / "predictor.html"
    text = write_page(file).read_text(encoding="utf-8")
    assert set(re.findall(r"https?://[^\s\"'<>]+", text)) == {"http://www.w3.org/2000/svg"}  # a name, no request
    asks = r"<(?:script|img|iframe)[^>]*\ssrc=|<link[^>]*href=\"(?!data:)|@import|fetch\(|XMLHttpRequest|import\("
    assert not re.search(asks, text)
    assert run(["predictor", "--out", str(file)]) == 2
    assert "overwrite" in capsys.readouterr().err
    assert run(["predictor", "--out", str(file), "--overwrite"]) == 0
    assert str(file) in capsys.readouterr().out


def test_the_page_of_the_guide_is_what_the_command_writes() -> None:
    """The words to the letter; the numbers but for rounding, which differs between machines."""
    number = re.compile(r"-?\d+(?:\.\d+)?(?:e-?\d+)?")
    shipped, current = (ROOT / "docs" / "predictor.html").read_text(encoding="utf-8"), page()
    assert number.sub("#", shipped) == number.sub("#", current), "bentbeam predictor --out docs/predictor.html"
    old, new = ([float(v) for v in number.findall(text)] for text in (shipped, current))
    assert old == pytest.approx(new, rel=1e-6, abs=1e-10)


@needs_node
def test_a_value_is_rounded_to_the_first_digit_of_its_bar_as_python_writes_it() -> None:
    rng = np.random.default_rng(8)
    values = rng.choice([-1.0, 1.0], 300) * 10.0 ** rng.uniform(-7.0, 9.0, 300)
    pairs = [(408.3, 48.0), (0.97, 0.096), (3.0, 20.0), (2.0, 0.0)]
    pairs += zip(values.tolist(), (abs(values) * 10.0 ** rng.uniform(-5.0, 0.5, 300)).tolist(), strict=True)
    written = evaluated("given.map(([value, error]) => Draw.bar(value, error))", pairs)
    power = re.compile(r"·10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)")
    digits = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
    plain = [power.sub(lambda m: f"e{int(m[1].translate(digits)):+03d}", text).replace("−", "-") for text in written]
    assert plain == [str(Number(*pair)) if pair[1] else "2 ± 0" for pair in pairs]
