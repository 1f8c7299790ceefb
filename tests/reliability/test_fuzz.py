"""Any input gives a finite answer or the documented refusal; never a traceback, NaN, a hang or half a file."""

import dataclasses
import json
import math
import signal
import string
import tempfile
from pathlib import Path
from unittest import mock

import called
import pytest
from here import FUZZ, SEED
from hypothesis import given, seed, settings
from hypothesis import strategies as st

import exudyn_models
import hermite_fe
from bent_beam import ImpactHistory

LIMIT = 120  # s an input; all of them are meant to take a second at most


def fuzz(quick, long):
    """``quick`` inputs, always the same ones, in `make test`; ``long`` with the run's seed in `make fuzz`."""
    return lambda test: settings(max_examples=long if FUZZ else quick)(seed(int(SEED))(test))


def command(*arguments):
    """What pytest fails with is no Exception: nothing on the way catches it."""
    signal.signal(signal.SIGALRM, lambda *_: pytest.fail("it hangs"))
    signal.alarm(LIMIT)
    try:
        return called.command(*arguments)
    finally:
        signal.alarm(0)


def answer(*arguments):
    """The contract: 0 and one finite JSON document, or 2 or 3, one line on standard error and ``None``."""
    code, out, err = command(*arguments)
    if code == 0:
        assert err == ""
        return json.loads(out, parse_constant=called.finite)
    assert code in (2, 3) and out == "", (code, out, err)
    assert err.startswith("error: ") and err.count("\n") == 1 and len(err) > 12 and "Traceback" not in err, err
    return None


def decades(first, last):
    return st.floats(first, last).map(lambda power: 10.0**power)


extremes = st.sampled_from([0.0, -0.0, 1e-320, 5e-324, 1e308, -1e308, 1e60, 1e61, 1e-61])
whole = st.integers() | st.integers(-(10**400), 10**400)
anything = st.one_of(st.floats(), whole, st.booleans(), st.text(max_size=20), extremes)
signed = st.one_of(st.just(0.0), st.floats(-1e3, 1e3), st.floats(allow_nan=False, allow_infinity=False))


def toml(value):
    if isinstance(value, float):
        return "nan" if math.isnan(value) else repr(value)
    if isinstance(value, int) and abs(value) > 10**399:
        return "9" * 5000  # beyond Python's limit of digits
    return json.dumps(value)


@st.composite
def problems(draw, loads=signed):
    """A beam of any stiffness, mass and speed, κ/ν, length over l* and load."""
    stiffness, mass, velocity = draw(decades(-12.0, 12.0)), draw(decades(-12.0, 12.0)), draw(decades(-9.0, 6.0))
    unit = math.sqrt(stiffness / mass) / velocity
    beam = {"bending_stiffness": stiffness, "mass_per_length": mass, "length": draw(decades(-8.0, 8.0)) * unit}
    beam["curvature"] = draw(decades(-8.0, 6.0)) / unit
    impact = {name: draw(loads) for name in ("acceleration", "curvature_rate", "fourth_derivative")}
    run = {"duration": draw(decades(-18.0, 12.0))}
    return {"beam": beam, "impact": {"velocity": velocity, **impact}, "run": run}


@st.composite
def damaged(draw):
    """A good problem with some values or keys replaced by anything, or left out."""
    tables = draw(problems())
    for _ in range(draw(st.integers(1, 3))):
        table = tables[draw(st.sampled_from(sorted(tables)))]
        key = draw(st.one_of(st.sampled_from(sorted(table) or ["x"]), st.text(string.ascii_lowercase, min_size=1)))
        if draw(st.booleans()):
            table[key] = draw(anything)
        else:
            table.pop(key, None)
    return tables


def case_file(content):
    """Alone in its folder: tables, text or bytes."""
    if isinstance(content, dict):
        lines = (f"[{name}]\n" + "".join(f"{k} = {toml(v)}\n" for k, v in t.items()) for name, t in content.items())
        content = "".join(lines)
    file = Path(tempfile.mkdtemp(dir=".")) / "case.toml"
    file.write_bytes(content if isinstance(content, bytes) else content.encode("utf-8", "surrogatepass"))
    return file


rubbish = st.binary(max_size=300) | st.text(max_size=300) | st.text('[]{}="\n.0123456789einfabmx #', max_size=200)


@fuzz(15, 3000)
@given(st.one_of(problems(), damaged(), rubbish), st.lists(st.one_of(decades(-12.0, 12.0), st.just(0.0)), max_size=3))
def test_predict_answers_or_refuses_any_case(content, times):
    options = [word for time in times for word in ("--time", repr(time))]
    found = answer("predict", case_file(content), "--theory-only", "--json", *options)
    assert found is None or (found["lambda0"] >= 0.0 and found["r0"] > 0.0)


RUBBISH = (
    "--json --kappa-over-nu --alpha --set --time --path --first-order nan inf -1 0 1e-400 exudyn x.y=1 "
    "beam.length=nan 1,2 1,2,3,4 --jobs --out /dev/null"
).split()
words = st.one_of(st.sampled_from(RUBBISH), st.text(max_size=10).filter(lambda text: "\0" not in text))


@fuzz(10, 800)
@given(
    st.sampled_from(["theory", "predict", "simulate", "match --unknown", "rerun", "study --unknown", "nothing", ""]),
    st.lists(words, max_size=6),
)
def test_command_lines_of_rubbish_are_refused(name, arguments):
    """None of them is a complete question, but for `theory`, which may be one."""
    code, out, err = command(*name.split(" "), *arguments)
    if code != 0:
        assert (code, err[:7], err.count("\n")) == (2, "error: ", 1)
    elif "--json" in arguments and name == "theory" and "--help" not in arguments:
        json.loads(out, parse_constant=called.finite)


numbers = st.one_of(decades(-6.0, 1.0), st.sampled_from([0.0, -1.0, 1e-300, 1e300, 1e30]), anything)
loads = st.one_of(st.just(0.0), st.floats(-10.0, 10.0))
few_or_absurd = st.one_of(st.integers(3, 40), st.sampled_from([1, 10**7, 10**300]))
STEPS = ("time_step", "growth", "relative_step", "safety")  # chosen below, so that a run takes a second at most


@st.composite
def parts(draw, method):
    """Assignments of kinds and their fields, some of them nonsense."""
    found = {}
    for name, registry in method.PARTS.items():
        if not draw(st.booleans()):
            continue
        kind = draw(st.sampled_from(sorted(registry)))
        found[f"{method.path}.{name}.kind"] = f'"{kind}"'
        for field in dataclasses.fields(registry[kind]):
            if field.name not in STEPS and draw(st.integers(0, 4)) == 0:
                found[f"{method.path}.{name}.{field.name}"] = toml(draw(numbers))
    return found


def simulate(path, tables, elements, chosen):
    """A run with chosen parts answers and leaves a whole history, or is refused and leaves none and no half of one."""
    length = tables["beam"]["length"] / 2.0 / elements if elements < 10**9 else 1e-300
    chosen |= {"mesh.kind": "uniform", "mesh.element_length": repr(length)}
    settings = [word for key, value in chosen.items() for word in ("--set", f"{key}={value}")]
    case = case_file(tables)
    history = case.with_name("history.nc")
    found = answer("simulate", case, "--path", path, "--json", "--save", 12, "--out", history, *settings)
    files = [file.name for file in case.parent.iterdir() if file != case]
    assert files in ([[], ["history.partial.nc"]] if found is None else [["history.nc"]])
    if found is not None:
        ImpactHistory.load(history)


@fuzz(5, 900)
@given(problems(loads), few_or_absurd, st.floats(0.002 if FUZZ else 0.01, 0.5), parts(hermite_fe.HermiteFE))
def test_the_hermite_path_finishes_or_says_why_not(tables, elements, growth, chosen):
    chosen.setdefault("hermite.integrator.kind", "signorini_position")
    simulate("hermite", tables, elements, chosen | {"hermite.integrator.growth": repr(growth)})


@fuzz(5, 250)
@given(problems(loads), st.integers(3, 16), st.floats(0.02, 0.5), parts(exudyn_models.ExudynModel))
def test_the_exudyn_path_finishes_or_says_why_not(tables, elements, relative, chosen):
    if chosen.get("exudyn.integrator.kind") in ('"generalized_alpha"', '"newmark"', '"trapezoidal"'):
        chosen["exudyn.integrator.relative_step"] = repr(relative)
    with mock.patch("exudyn_models.stepping.MOST_WORK", 4e6):  # half a minute: longer ones are refused at the same door
        simulate("exudyn", tables, elements, chosen)
