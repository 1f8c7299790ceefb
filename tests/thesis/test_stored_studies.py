"""Studies that are stored for the report."""

from __future__ import annotations

import json
from contextlib import nullcontext
from pathlib import Path

import pytest
from PIL import Image

from bent_beam.cases import Case
from bent_beam.impact import Impact
from comparison import stored
from thesis import stored_studies


def test_stored_studies_carry_their_tables_and_pictures_and_are_confirmed_by_a_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    impact = Impact(1.0, 1.0, length=2.0, curvature=10.0, velocity=20.0)
    small = Case("short", impact, end_time=0.01 * impact.time_scale, mesh=None, tables={})
    monkeypatch.setattr(stored_studies, "case_of", lambda name: small)
    file = tmp_path / "studies.json"
    stored_studies.store_studies(["restitution"], file=file)
    (note,) = stored.read(file)["studies"]
    assert [row["label"] for row in note["rows"][:3]] == ["restitution 0", "restitution 0.5", "restitution 1"]
    assert note["columns"].keys() <= note["rows"][0].keys()
    assert not note["failed"] and note["reason"] == ""
    with Image.open(tmp_path / "restitution.png") as picture:
        assert len(picture.getcolors()) <= 64
    monkeypatch.setattr(stored_studies, "note_of", lambda name, folder: stored_studies.lost(name, "no luck"))
    stored_studies.store_studies(["friction"], file=file)
    kept, lost = stored.read(file)["studies"]
    assert kept == note and lost["failed"] and lost["reason"] == "no luck" and lost["rows"] == []
    document = stored.read(file) | {"digest": "of yesterday"}
    file.write_text(json.dumps(document))
    with pytest.raises(ValueError, match="other code or settings"):
        stored_studies.store_studies(["friction"], file=file)
    with pytest.raises(ValueError, match="no study is called mess"):
        stored_studies.store_studies(["mess"], file=tmp_path / "none.json")
    with pytest.raises(ValueError, match=r"restitution: .*no luck"):
        stored_studies.confirm_studies(["restitution"], file=file)
    for worse, refused in ((0.0, False), (1.0, True)):
        rows = [{**row, "reaction_error": row["reaction_error"] + worse} for row in note["rows"]]
        monkeypatch.setattr(stored_studies, "note_of", lambda name, folder, rows=rows: {**note, "rows": rows})
        file.write_text(json.dumps(document))
        with pytest.raises(ValueError, match="reaction_error") if refused else nullcontext():
            stored_studies.confirm_studies(["restitution"], file=file)
        assert stored.is_stale(file) == refused
