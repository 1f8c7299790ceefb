"""What the page warns of is what ``bentbeam`` warns of."""

import re
import tomllib

import numpy as np
from page_scripts import evaluated

from bent_beam.cases import case_from_tables, load_case
from comparison import predict
from comparison.doubts import OVERDAMPED, SUNK, doubts
from comparison.readable import REGIMES, SHORT_ZONE, validity_text


def test_the_page_doubts_a_speed_of_sound_and_a_strain_that_no_material_has_and_the_weight_of_an_added_mass() -> None:
    """As `doubts` does (tests/comparison/test_prediction.py)."""
    beam, numbers = "Beam.impact({...Beam.START, ...more})", "{restitution: {}, moment: {}, force: {}}"
    told = f"given.map((more) => Words.warnings({beam}, {numbers}, Beam.problem({beam}, 0.01), false).join(' '))"
    mistakes = [{"youngs_modulus": 70e3}, {"density": 2.7}, {"tension": 2e6}, {"added_mass": 1.0}, {}]
    slow, fast, pulled, wet, sane = evaluated(told, mistakes)
    assert "buoyancy" in wet and "buoyancy" not in sane
    assert "speed of sound of 5.09 m/s" in slow and "speed of sound of 161" in fast
    assert "strains the section by 0.06" in pulled and "speed" not in sane + pulled and "strains" not in sane


def test_the_page_doubts_a_damping_and_a_wall_as_bentbeam_does() -> None:
    """On either side of each threshold, by the same words but for the unit of the field."""
    tube = load_case("cases/tube.toml").impact
    sinks = [tube.mass_per_length / (share * SUNK * tube.length) ** 2 for share in (0.99, 1.01)]  # at 1 m/s
    typed = [{"damping_ratio": ratio} for ratio in (None, 0.99 * OVERDAMPED, 1.01 * OVERDAMPED, 1.5)]
    typed += [{"wall_stiffness": 1e8, "wall_damping_ratio": ratio} for ratio in (0.0, 0.99, 1.01, 30.0)]
    typed += [{"wall_stiffness": stiffness} for stiffness in sinks]
    expression = """given.map((typed) => {
        const i = {...Beam.START, ...typed}, b = Beam.impact(i), numbers = {restitution: {}, moment: {}, force: {}};
        const told = Words.warnings(b, numbers, Beam.problem(b, b.damping ?? 0.01), false).join(" ");
        return [told.replace("’", "'"), Case.toml(i, b)]; })"""
    doubted = []
    for told, text in evaluated(expression, typed):
        case = case_from_tables(tomllib.loads(text))
        said = " ".join(doubts(case.impact, case.section))
        words = ["damps the first mode with a ratio of", "the wall's damping ratio is", "the wall gives way by some"]
        assert [part in told.lower() for part in words] == [part in said for part in words]
        assert all(number in said for number in re.findall(r"(?:ratio of|ratio is|by some) ([\d.]+)", told))
        doubted += [part for part in words if part in said]
    assert doubted == [words[0]] * 2 + [words[1]] * 2 + [words[2]]


def test_of_a_contact_that_stays_one_point_the_page_says_what_bentbeam_predict_does() -> None:
    """A beam that shears has a short zone at first; one that does not, and a contact that spreads, have their words."""
    typed = [{"velocity": 0.1}, {"velocity": 0.1, "model": "euler_bernoulli"}, {}]
    expression = """given.map((typed) => {
        const i = {...Beam.START, ...typed}, b = Beam.impact(i);
        return [Words.verdict(b, Instants.solve(b).contact), Case.toml(i, b)]; })"""
    found = evaluated(expression, typed)
    assert [verdict for verdict, _ in found] == [SHORT_ZONE, REGIMES["discrete"], REGIMES["continuous"]]
    for verdict, text in found:
        assert verdict in str(predict(case_from_tables(tomllib.loads(text)), theory_only=True))


def test_page_and_predict_say_alike_when_the_first_instants_have_a_reaction() -> None:
    """With shear it holds from twice as late on as length and impulse; where waves from the ends swing it by then, at
    no time."""
    base = {"limited_by": "slope", "valid_from": 1e-3, "valid_until": 5e-3, "model": "timoshenko", "damping": None}
    base |= dict.fromkeys(("epsilon_alpha", "epsilon_psi", "epsilon_chi", "epsilon_axial", "wall"), 0.0)
    later, never = "; for the reaction twice as long", "Its reaction is within 2 % at no time"
    ends = "it has no reaction"
    asked = [  # after, until when the force holds, until when the theory does, what is said
        ("shear", 5e-3, 5e-3, [later]), ("shear", 3e-3, 5e-3, [later, "From 3 ms on it has no reaction"]),
        ("shear", 1.9e-3, 5e-3, [never, "From 1.9 ms on it has no reaction"]), ("shear", 1.9e-3, 1.9e-3, [never]),
        ("shear", 2e-4, 5e-3, ["From 1 ms on it has no reaction"]), ("wall", 1.9e-3, 1.9e-3, []),
        ("wall", 1.9e-3, 5e-3, ["From 1.9 ms on it has no reaction"]),
    ]  # fmt: skip
    expression = """given.map(([after, forceUntil, until]) => {
        const holds = {from: 1e-3, until, forceUntil, by: "slope", after};
        return Words.holding(holds, {...Beam.impact(Beam.START), shear: true}, {regime: "continuous"}); })"""
    for (after, force, until, parts), told in zip(asked, evaluated(expression, asked), strict=True):
        said = {"valid_after": after, "force_until": force, "valid_until": until, "regime": "continuous"}
        for text in (validity_text(base | said), told):
            assert [one for one in (later, never, ends) if one in text] == [
                one for one in (later, never, ends) if any(one in part for part in parts)
            ] and all(part in text for part in parts)


def test_a_last_contact_within_its_bar_is_told() -> None:
    expression = """given.map((bar) => {
        const b = Beam.impact(Beam.START), one = {bar: 0, value: 1}, lastContact = {bar, value: 0.5};
        const numbers = {restitution: one, moment: one, force: one, lastContact};
        return Words.warnings(b, numbers, Beam.problem(b, 0.01), true).join(" "); })"""
    sure, unsure = evaluated(expression, [0.4, 0.6])
    for part in ("touches the wall once more", "hermite.refine=2"):
        assert part in unsure and part not in sure


def test_an_axial_force_alone_neither_brings_the_beam_back_nor_keeps_it_on_the_wall() -> None:
    """What holds the bow against it cancels it, as in `Impact.net_load`; a load of a billionth of it counts."""
    tensions = 10.0 ** np.random.default_rng(31).uniform(1.0, 3.5, 40)
    typed = [{"tension": float(sign * tension), "gravity": 0.0} for tension in tensions for sign in (-1.0, 1.0)]
    typed += [{"tension": 1e4, "gravity": 0.0, "load": load} for load in (1e-7, -1e-7)]
    expression = """given.map((typed) => {
        const i = {...Beam.START, ...typed}, b = Beam.impact(i), p = Beam.problem(b, b.damping);
        const one = {bar: 0, value: 1};
        const told = (value) => Words.warnings(b, {restitution: {bar: 0, value}, moment: one, force: one}, p, true);
        return {wrong: Beam.complaints(i), text: Case.toml(i, b), net: Answer.net(p), sum: p.load + p.pull,
            left: told(0.5).join(" "), stays: told(null).join(" ")}; })"""
    *alone, pressed, lifted = evaluated(expression, typed)
    assert sum(row["sum"] > 0.0 for row in alone) > 10  # by round-off
    for row in alone:
        assert not row["wrong"] and row["net"] == 0.0
        assert case_from_tables(tomllib.loads(row["text"])).impact.net_load == 0.0
        assert "bring the beam back" not in row["left"] and "keep the beam on the wall" not in row["stays"]
    assert pressed["net"] > 0.0 > lifted["net"]
    assert "bring the beam back" in pressed["left"] and "keep the beam on the wall" in pressed["stays"]
