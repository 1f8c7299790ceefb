"""What is stored for the report: the parameter studies on the thesis's own cases."""

import json
from dataclasses import replace
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from bent_beam import stored
from bent_beam_programs.thesis import stored_studies
from bent_beam_programs.thesis.gallery.runs import case, thesis


@pytest.mark.verify
def test_report_and_gallery_show_one_result() -> None:
    """The stored study of 3.3.3, on the thesis's own case, is the run that the gallery draws."""
    (study,) = (s for s in json.loads(stored_studies.FILE.read_text())["studies"] if s["name"] == "damping")
    (row,) = (r for r in study["rows"] if r["label"] == "ρ∞ = 0.8")
    found = thesis("", 1.0 / 40.0, 0.01).measures
    assert thesis("", 1.0 / 40.0, 0.01).history.steps == row["steps"]
    for name in ("contact_length_error", "reaction_error", "lift", "lost_impact"):
        assert found[name] == pytest.approx(row[name], rel=1e-6), name


def test_a_small_picture_keeps_the_colours_of_thin_lines_and_a_grey_wall_grey(tmp_path: Path) -> None:
    """Lines one pixel wide on a smooth shade that has most of the pixels; a grey wall; and a patch of more random
    colours than are kept."""
    lines, colours = [20, 40, 60], np.array([[[31, 119, 180]], [[44, 160, 44]], [[214, 39, 40]]])
    shade = np.broadcast_to(np.linspace(120, 255, 300).astype(np.uint8)[None, :, None], (200, 300, 3)).copy()
    shade[lines], shade[80:120] = colours, 232
    shade[130:190, :60] = np.random.default_rng(1).integers(0, 256, (60, 60, 3))
    Image.fromarray(shade).save(tmp_path / "lines.png")
    with Image.open(BytesIO(stored_studies.small_picture(tmp_path / "lines.png"))) as picture:
        kept = np.asarray(picture.convert("RGB"), dtype=float)
    assert np.abs(kept[lines] - colours).max() <= 12.0 and np.abs(kept[80:120] - 232.0).max() <= 2.0


def test_stored_studies_carry_their_tables_and_pictures_and_say_what_was_lost(tmp_path, monkeypatch):
    given = case(10.0, 0.002)
    small = replace(given, impact=given.impact.replace(length=2.0))
    monkeypatch.setattr(stored_studies, "case_of", lambda name: small)
    file = tmp_path / "studies.json"
    two = {name: stored_studies.STUDIES[name] for name in ("restitution", "friction")}
    monkeypatch.setattr(stored_studies, "STUDIES", {"restitution": two["restitution"]})
    stored_studies.store_studies(file=file)
    (note,) = stored.read(file)["studies"]
    assert [row["label"] for row in note["rows"][:3]] == ["restitution 0", "restitution 0.5", "restitution 1"]
    assert note["columns"].keys() <= note["rows"][0].keys()
    assert not note["failed"] and note["reason"] == ""
    with Image.open(tmp_path / "restitution.png") as picture:
        assert picture.mode == "P"
    monkeypatch.setattr(stored_studies, "STUDIES", two)
    monkeypatch.setattr(stored_studies, "note_of", lambda name, folder: stored_studies.lost(name, "no luck"))
    stored_studies.store_studies(file=file)
    lost = stored.read(file)["studies"][1]
    assert lost["failed"] and lost["reason"] == "no luck" and lost["rows"] == []
