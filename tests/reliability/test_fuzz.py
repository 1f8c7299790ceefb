"""Any input gives a finite answer or the documented refusal; never a traceback, NaN, a hang or half a file."""

import contextlib
import io
import json
import math
import os
import random
import signal
import string
import tempfile
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, seed, settings
from hypothesis import strategies as st

import exudyn_models
import hermite_fe
from bent_beam import Impact, ImpactHistory, SimulationError
from bent_beam.meshes import MESHES
from comparison.command_line.app import run
from theory import contact_parameters
from theory import predict as predict_impact

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
    out, err = io.StringIO(), io.StringIO()
    with limited(), contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = run([str(a) for a in arguments])
    said = [line for line in err.getvalue().splitlines(keepends=True) if not line.startswith("compiling, as always")]
    return code, out.getvalue(), "".join(said)  # without what a machine says that is new to the kernels


def refuse_constant(name):
    raise AssertionError(f"{name} in JSON")


def check(code, out, err):
    """The contract: 0 and one finite JSON document, or 2 or 3 and one line on standard error."""
    assert code in (0, 2, 3), (code, err)
    assert "Traceback" not in err
    if code == 0:
        assert err == ""
        return json.loads(out, parse_constant=refuse_constant)
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
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
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


@fuzz(70, 1500)
@given(problems(), st.lists(st.one_of(powers, st.just(0.0)), max_size=3))
def test_predict_answers_or_refuses_any_problem(tables, times):
    options = [item for t in times for item in ("--time", repr(t))]
    found = check(*command("predict", case_file(tables_text(tables)), "--json", *options))
    if found is not None:
        assert found["lambda0"] >= 0.0 and found["r0"] > 0.0


@fuzz(50, 1000)
@given(damaged())
def test_damaged_cases_are_refused_by_name(tables):
    check(*command("predict", case_file(tables_text(tables)), "--json"))


@fuzz(40, 800)
@given(
    st.one_of(st.binary(max_size=300), st.text(max_size=300), st.text('[]{}="\n.0123456789einfabmx #', max_size=200))
)
def test_files_that_are_no_cases_are_refused(content):
    code, out, err = command("predict", case_file(content), "--json")
    assert code == 2
    check(code, out, err)


RUBBISH = (
    "--json --kappa-over-nu --alpha --set --time --path --first-order nan inf -1 0 1e-400 exudyn x.y=1 "
    "beam.length=nan 1,2 1,2,3,4 --jobs --out /dev/null"
).split()


@fuzz(40, 800)
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
flags = st.one_of(st.booleans(), anything)


@st.composite
def parts(draw, registries, fixed):
    """Assignments of kinds and their fields, some of them nonsense."""
    import dataclasses

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


@st.composite
def small_meshes(draw):
    return draw(st.integers(3, 40)) if draw(st.integers(0, 9)) else draw(st.sampled_from([1, 10**7, 10**300]))


@fuzz(40, 900)
@given(
    problems(st.one_of(st.just(0.0), st.floats(-10.0, 10.0))),
    small_meshes(),
    st.floats(0.002, 0.5),
    parts({f"hermite.{k}": v for k, v in hermite_fe.HermiteFE.PARTS.items()}, ("time_step", "growth")),
    st.booleans(),
)
def test_the_hermite_path_finishes_or_says_why_not(tables, elements, growth, chosen, keep):
    half = tables["beam"]["length"] / 2.0
    chosen |= {"mesh.kind": "uniform", "mesh.element_length": repr(half / elements if elements < 10**9 else 1e-300)}
    if "hermite.integrator.kind" not in chosen:
        chosen["hermite.integrator.kind"] = "signorini_position"
    chosen["hermite.integrator.growth"] = repr(growth)
    file = case_file(tables_text(tables))
    out = file.with_name("history.nc")
    options = ["--out", out] if keep else ["--out", file.with_name("other.nc")]
    found = check(*command("simulate", file, "--json", "--save", 12, *options, *assigned(chosen)))
    files = {f.name for f in file.parent.iterdir()} - {"case.toml"}
    assert not any(name.endswith(".part") for name in files)
    for name in files:
        ImpactHistory.load(file.with_name(name))
    assert (found is not None) == bool(files & {"history.nc", "other.nc"})


@fuzz(15, 250)
@given(
    problems(st.one_of(st.just(0.0), st.floats(-10.0, 10.0))),
    st.integers(3, 16),
    st.floats(0.02, 0.5),
    parts(
        {f"exudyn.{k}": v for k, v in exudyn_models.ExudynModel.PARTS.items()},
        ("time_step", "relative_step", "safety"),
    ),
)
def test_the_exudyn_path_finishes_or_says_why_not(tables, elements, relative, chosen):
    chosen |= {"mesh.kind": "uniform", "mesh.element_length": repr(tables["beam"]["length"] / 2.0 / elements)}
    if chosen.get("exudyn.integrator.kind", "x") in ('"generalized_alpha"', '"newmark"', '"trapezoidal"'):
        chosen["exudyn.integrator.relative_step"] = repr(relative)
    file = case_file(tables_text(tables))
    out = file.with_name("history.nc")
    found = check(
        *command("simulate", file, "--json", "--path", "exudyn", "--save", 10, "--out", out, *assigned(chosen))
    )
    assert (found is not None) == out.exists()


# --- Python calls --------------------------------------------------------------------------------------------------


@fuzz(30, 600)
@given(st.lists(st.one_of(powers, anything, signed), min_size=5, max_size=9), st.lists(numbers, max_size=2))
def test_impacts_and_predictions_are_finite_or_refused(values, times):
    try:
        impact = Impact(*values)
        found = predict_impact(impact, times)
    except ValueError as error:
        assert str(error)
        return
    assert all(math.isfinite(v) for v in (found.lambda0, found.r0, found.time_scale, found.epsilon))
    json.dumps(found.to_dict(), allow_nan=False)


@fuzz(20, 400)
@given(st.one_of(curvatures, anything), st.one_of(signed, anything), st.one_of(signed, anything), signed)
def test_contact_parameters_are_finite_or_refused(kappa, alpha, psi, chi):
    try:
        found = contact_parameters(kappa, alpha, psi, chi)
    except (ValueError, TypeError, OverflowError) as error:
        assert str(error)
        return
    assert math.isfinite(found.lambda0) and math.isfinite(found.r0)
    if max(abs(float(v)) for v in (alpha, psi, chi)) < 1e100 and kappa > 1e-20:
        assert math.isfinite(found.lambda1) and math.isfinite(found.r1)


@fuzz(30, 400)
@given(st.sampled_from(sorted(MESHES)), st.lists(numbers, min_size=1, max_size=4), powers)
def test_meshes_increase_from_the_centre_to_the_end_or_are_refused(kind, values, half):
    arguments = (tuple(values),) if kind == "nodes" else values
    try:
        nodes = MESHES[kind](*arguments).nodes(half)
    except (ValueError, TypeError) as error:
        assert str(error)
        return
    assert nodes[0] == 0.0 and nodes[-1] == pytest.approx(half) and (nodes[1:] > nodes[:-1]).all()


@fuzz(2, 12)
@given(
    powers, powers, velocities, st.sampled_from([2.0, 0.5] + [0.1] * FUZZ), st.floats(-24.0, 1.0).map(lambda p: 10.0**p)
)
def test_runs_chosen_from_the_problem_do_not_depend_on_its_size(stiffness, mass, velocity, kappa, tau):
    unit = math.sqrt(stiffness / mass) / velocity
    impact = Impact(stiffness, mass, 300.0 * unit * math.sqrt(tau), kappa / unit, velocity)
    end = tau * impact.time_scale
    try:
        history = hermite_fe.simulate(impact, end_time=end, save=8)
    except SimulationError as error:
        pytest.fail(str(error))
    assert 1_000 < history.steps < 60_000
    assert abs(history.energy_budget()["defect"]) < 1e-9 * history.energy_budget()["initial_energy"]


def test_no_hang_is_hidden_by_this_module():
    with pytest.raises(Hang), limited():
        signal.alarm(1)
        while True:
            random.random()
