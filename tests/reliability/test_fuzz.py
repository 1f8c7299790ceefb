"""Any input gives a finite answer or the documented refusal; never a traceback, NaN, a hang or half a file."""

import contextlib
import dataclasses
import json
import math
import os
import signal
import string
import tempfile
from pathlib import Path

import called
from hypothesis import HealthCheck, given, seed, settings
from hypothesis import strategies as st

import exudyn_models
import hermite_fe
from bent_beam import ImpactHistory
from theory import contact_parameters

FUZZ = bool(os.environ.get("FUZZ"))
SEED = int(os.environ.get("FUZZ_SEED", "0"))
LIMIT = 120  # s an input; all of them are meant to take a second at most


class Hang(BaseException):
    """Not an Exception, so that nothing on the way catches it."""


@contextlib.contextmanager
def limited():
    def ring(*_):
        raise Hang

    signal.signal(signal.SIGALRM, ring)
    signal.alarm(LIMIT)
    try:
        yield
    finally:
        signal.alarm(0)


def fuzz(quick, long):
    """``quick`` inputs, always the same ones, in `make test`; ``long`` with the run's seed in `make fuzz`."""

    def decorate(test):
        chosen = settings(
            max_examples=long if FUZZ else quick,
            derandomize=not FUZZ,
            deadline=None,
            database=None,
            suppress_health_check=list(HealthCheck),
        )
        return chosen(seed(SEED)(test) if FUZZ else test)

    return decorate


def command(*arguments):
    with limited():
        return called.command(*arguments)


def check(code, out, err):
    """The contract: 0 and one finite JSON document, or 2 or 3 and one line on standard error."""
    assert code in (0, 2, 3), (code, err)
    assert "Traceback" not in err
    if code == 0:
        assert err == ""
        return json.loads(out, parse_constant=called.finite)
    assert err.startswith("error: ") and err.count("\n") == 1 and len(err) > 12, err
    assert out == ""
    return None


# --- what is thrown at it ----------------------------------------------------------------------------------------

powers = st.floats(-12.0, 12.0).map(lambda p: 10.0**p)
velocities = st.floats(-9.0, 6.0).map(lambda p: 10.0**p)
curvatures = st.floats(-8.0, 6.0).map(lambda p: 10.0**p)
spans = st.floats(-8.0, 8.0).map(lambda p: 10.0**p)
anything = st.one_of(
    st.floats(),
    st.integers(),
    st.integers(-(10**400), 10**400),
    st.booleans(),
    st.text(max_size=20),
    st.sampled_from([0.0, -0.0, 1e-320, 5e-324, 1e308, -1e308, 1e60, 1e61, 1e-61]),
)
signed = st.one_of(st.just(0.0), st.floats(-1e3, 1e3), st.floats(allow_nan=False, allow_infinity=False))


def toml(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return "nan" if math.isnan(value) else repr(value)
    if isinstance(value, int):
        try:
            return str(value)
        except ValueError:  # beyond Python's limit of digits
            return "9" * 5000
    return json.dumps(value)


def tables_text(tables):
    return "".join(
        f"[{name}]\n" + "".join(f"{key} = {toml(value)}\n" for key, value in table.items())
        for name, table in tables.items()
    )


@st.composite
def problems(draw, loads=signed):
    """A beam of any stiffness, mass and speed, κ/ν, length over l* and load."""
    stiffness, mass, velocity = draw(powers), draw(powers), draw(velocities)
    unit = math.sqrt(stiffness / mass) / velocity
    return {
        "beam": {
            "bending_stiffness": stiffness,
            "mass_per_length": mass,
            "length": draw(spans) * unit,
            "curvature": draw(curvatures) / unit,
        },
        "impact": {
            "velocity": velocity,
            "acceleration": draw(loads),
            "curvature_rate": draw(loads),
            "fourth_derivative": draw(loads),
        },
        "run": {"duration": 10.0 ** draw(st.floats(-18.0, 12.0))},
    }


@st.composite
def damaged(draw):
    """A good problem with some values, keys or tables replaced by anything."""
    tables = draw(problems())
    for _ in range(draw(st.integers(1, 3))):
        name = draw(st.sampled_from(sorted(tables)))
        key = draw(
            st.one_of(st.sampled_from(sorted(tables[name]) or ["x"]), st.text(string.ascii_lowercase, min_size=1))
        )
        if draw(st.booleans()):
            tables[name][key] = draw(anything)
        else:
            tables[name].pop(key, None)
    return tables


def case_file(text):
    folder = tempfile.mkdtemp(prefix="fuzz-")
    file = Path(folder) / "case.toml"
    file.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8", "surrogatepass"))
    return file


# --- predict and theory: fast, so most inputs go here ------------------------------------------------------------

rubbish = st.one_of(
    st.binary(max_size=300), st.text(max_size=300), st.text('[]{}="\n.0123456789einfabmx #', max_size=200)
)


@fuzz(70, 3000)
@given(st.one_of(problems(), damaged(), rubbish), st.lists(st.one_of(powers, st.just(0.0)), max_size=3))
def test_predict_answers_or_refuses_any_case(content, times):
    case = case_file(tables_text(content) if isinstance(content, dict) else content)
    options = [item for t in times for item in ("--time", repr(t))]
    found = check(*command("predict", case, "--theory-only", "--json", *options))
    if found is not None:
        assert found["lambda0"] >= 0.0 and found["r0"] > 0.0


RUBBISH = (
    "--json --kappa-over-nu --alpha --set --time --path --first-order nan inf -1 0 1e-400 exudyn x.y=1 "
    "beam.length=nan 1,2 1,2,3,4 --jobs --out /dev/null"
).split()


@fuzz(25, 800)
@given(
    st.sampled_from(["theory", "predict", "simulate", "match", "rerun", "study", "nothing", ""]),
    st.lists(
        st.one_of(
            st.sampled_from(RUBBISH),
            st.text(max_size=10).filter(lambda text: "\0" not in text),
        ),
        max_size=6,
    ),
)
def test_command_lines_of_rubbish_are_refused(name, arguments):
    """None of them is a complete question, but for `theory`, which may be one."""
    if name in ("match", "study"):
        arguments = ["--unknown", *arguments]
    code, out, err = command(name, *arguments)
    assert code in (0, 2) and "Traceback" not in err
    if code == 2:
        assert err.startswith("error: ") and err.count("\n") == 1
    elif "--json" in arguments and name == "theory" and "--help" not in arguments:
        check(code, out, err)


# --- simulations, small enough by hand to finish, or absurd --------------------------------------------------------

numbers = st.one_of(
    st.floats(-6.0, 1.0).map(lambda p: 10.0**p), st.sampled_from([0.0, -1.0, 1e-300, 1e300, 1e30]), anything
)


@st.composite
def parts(draw, registries, fixed):
    """Assignments of kinds and their fields, some of them nonsense."""
    found = {}
    for name, registry in registries.items():
        if not draw(st.booleans()):
            continue
        kind = draw(st.sampled_from(sorted(registry)))
        found[f"{name}.kind"] = f'"{kind}"'
        for field in dataclasses.fields(registry[kind]):
            if field.name not in fixed and draw(st.integers(0, 4)) == 0:
                found[f"{name}.{field.name}"] = toml(draw(numbers))
    return found


def assigned(settings):
    return [item for key, value in settings.items() for item in ("--set", f"{key}={value}")]


PATHS = {"hermite": hermite_fe.HermiteFE.PARTS, "exudyn": exudyn_models.ExudynModel.PARTS}
STEPS = ("time_step", "growth", "relative_step", "safety")  # chosen below, so that a run takes a second at most


def simulated(path, tables, elements, chosen):
    """The answer of a run with chosen parts, and whether it left a whole history, or none and no half of one."""
    length = tables["beam"]["length"] / 2.0 / elements if elements < 10**9 else 1e-300
    chosen |= {"mesh.kind": "uniform", "mesh.element_length": repr(length)}
    file = case_file(tables_text(tables))
    arguments = ["--path", path, "--json", "--save", 12, "--out", file.with_name("history.nc"), *assigned(chosen)]
    found = check(*command("simulate", file, *arguments))
    files = [f.name for f in file.parent.iterdir() if f != file]
    assert files in ([[], ["history.partial.nc"]] if found is None else [["history.nc"]])
    if found is not None:
        ImpactHistory.load(file.with_name("history.nc"))


loads = st.one_of(st.just(0.0), st.floats(-10.0, 10.0))
counts = st.one_of(st.integers(3, 40), st.sampled_from([1, 10**7, 10**300]))


@fuzz(20, 900)
@given(
    problems(loads),
    counts,
    st.floats(0.002, 0.5),
    parts({f"hermite.{k}": v for k, v in PATHS["hermite"].items()}, STEPS),
)
def test_the_hermite_path_finishes_or_says_why_not(tables, elements, growth, chosen):
    chosen.setdefault("hermite.integrator.kind", "signorini_position")
    simulated("hermite", tables, elements, chosen | {"hermite.integrator.growth": repr(growth)})


@fuzz(15, 250)
@given(
    problems(loads),
    st.integers(3, 16),
    st.floats(0.02, 0.5),
    parts({f"exudyn.{k}": v for k, v in PATHS["exudyn"].items()}, STEPS),
)
def test_the_exudyn_path_finishes_or_says_why_not(tables, elements, relative, chosen):
    if chosen.get("exudyn.integrator.kind", "x") in ('"generalized_alpha"', '"newmark"', '"trapezoidal"'):
        chosen["exudyn.integrator.relative_step"] = repr(relative)
    simulated("exudyn", tables, elements, chosen)


# --- Python calls --------------------------------------------------------------------------------------------------


@fuzz(20, 400)
@given(st.one_of(curvatures, anything), st.one_of(signed, anything), st.one_of(signed, anything), signed)
def test_contact_parameters_are_finite_or_refused(kappa, alpha, psi, chi):
    try:
        found = contact_parameters(kappa, alpha, psi, chi)
    except (ValueError, TypeError, OverflowError) as error:
        assert str(error)
        return
    assert math.isfinite(found.lambda0) and math.isfinite(found.r0)
    if max(abs(float(v)) for v in (alpha, psi, chi)) < 1e100 and float(kappa) > 1e-20:
        assert math.isfinite(found.lambda1) and math.isfinite(found.r1)
