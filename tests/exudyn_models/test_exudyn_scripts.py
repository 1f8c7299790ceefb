"""Every model script runs as a user runs it and prints numbers that agree with the exact ones."""

import importlib
import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest

SCRIPTS = Path(__file__).resolve().parents[2] / "exudyn_models" / "scripts"


def run(name, tmp_path, *options):
    environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
    return subprocess.run(
        [sys.executable, str(SCRIPTS / f"{name}.py"), *options],
        cwd=tmp_path,
        text=True,
        capture_output=True,
        timeout=120,
        env=environment | {"MPLBACKEND": "Agg"},
        check=True,
    )


def errors(output):
    """Relative errors that a script printed: "off by +0.12%" or "off by -1.2e-06"."""
    found = re.findall(r"off by ([-+][0-9.e+-]+)(%?)", output)
    return [abs(float(number)) / (100 if percent else 1) for number, percent in found]


@pytest.mark.parametrize(
    ("name", "options", "count", "tolerance"),
    [
        ("cantilever", (), 2, 1e-5),
        ("simply_supported_beam", (), 3, 1e-6),
        ("bouncing_ball", (), 3, 3e-3),
        ("bent_beam_impact", ("--coarsen", "2"), 2, 2e-3),
        pytest.param("first_order_impacts", ("--coarsen", "2"), 4, 0.3, marks=pytest.mark.verify),
    ],
)
def test_script_prints_the_exact_answer_within(name, options, count, tolerance, tmp_path):
    done = run(name, tmp_path, *options)
    found = errors(done.stdout)
    assert len(found) == count
    assert max(found) < tolerance
    assert (tmp_path / f"{name}.png").stat().st_size > 1000


@pytest.mark.verify
def test_first_order_impacts_meet_theory_at_full_resolution(tmp_path):
    assert max(errors(run("first_order_impacts", tmp_path).stdout)) < 0.05


def test_true_geometry_script_approaches_the_linear_answer(tmp_path):
    assert max(errors(run("bent_beam_impact", tmp_path, "--geometry", "true", "--coarsen", "2").stdout)) < 5e-3


def test_scripts_write_where_told_and_name_what_is_wrong(tmp_path):
    from exudyn_models.scripts import cantilever, simply_supported_beam

    cantilever.main(["--load", "-1", "--out", str(tmp_path / "bent.png")])
    assert (tmp_path / "bent.png").exists()
    for main, wrong in ((cantilever.main, "0"), (simply_supported_beam.main, "3")):
        with pytest.raises(SystemExit):
            main(["--elements", wrong])


@pytest.mark.parametrize(
    "name", ["cantilever", "simply_supported_beam", "bouncing_ball", "bent_beam_impact", "first_order_impacts"]
)
def test_script_has_help(name, capsys):
    with pytest.raises(SystemExit) as left:
        importlib.import_module(f"exudyn_models.scripts.{name}").main(["--help"])
    assert left.value.code == 0 and "usage:" in capsys.readouterr().out


def test_view_without_a_display_is_said_plainly(tmp_path):
    done = run("cantilever", tmp_path, "--view")
    assert "no display" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.verify
@pytest.mark.skipif(not (shutil.which("Xvfb") and shutil.which("xdotool")), reason="needs Xvfb and xdotool")
def test_the_viewer_stays_until_it_is_told_to_go_on(tmp_path):
    there, here = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(here), "-screen", "0", "1280x900x24"], pass_fds=[here], stderr=subprocess.DEVNULL
    )
    try:
        with os.fdopen(there) as line:
            environment = os.environ | {"DISPLAY": f":{line.readline().strip()}", "MPLBACKEND": "Agg"}
        shown = subprocess.Popen(
            [sys.executable, str(SCRIPTS / "bent_beam_impact.py"), "--view", "--geometry", "true", "--coarsen", "3"],
            cwd=tmp_path,
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            env=environment,
        )
        assert "Q or Escape" in shown.stderr.readline()
        assert shown.poll() is None
        while shown.poll() is None:
            subprocess.run(["xdotool", "mousemove", "500", "300", "key", "Escape"], env=environment, timeout=60)
            time.sleep(0.2)
        assert shown.returncode == 0 and "lambda0" in shown.stdout.read()
    finally:
        server.terminate()
        server.wait(timeout=30)
