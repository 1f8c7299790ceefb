"""When stored numbers are stale."""

import json

from bent_beam import stored

CODE = '''"""What it is about."""


def area(width, height):
    """In m²."""
    total = 0.0
    for _ in range(2):
        if width < 0.0:
            raise ValueError(f"width: is negative (got {width})")
        total += width * height / 2.0  # {}
    return total
'''


def test_numbers_are_stale_once_code_or_settings_change_and_not_for_words(tmp_path, monkeypatch):
    monkeypatch.setattr(stored, "ROOT", tmp_path)
    (room := tmp_path / "room").mkdir()

    def with_code(*change):
        (room / "area.py").write_text(CODE.replace(*change) if change else CODE)
        stored._code.cache_clear()

    with_code()
    file = stored.write(tmp_path / "n.json", "areas", "python -m room.area", ["room"], {"mesh": 3}, {"areas": [6.0]})
    assert not stored.is_stale(file) and stored.read(file)["areas"] == [6.0]
    module = stored.write(tmp_path / "m.json", "areas", "python -m room.area", ["room.area"], {}, {"areas": [6.0]})
    for old, new, stale in (
        ("# {}", "# another remark", False),
        ("In m².", "In square metres.\n\n    Of a rectangle.", False),
        ("width: is negative (got {width})", "width: {width:g} m is below 0", False),
        ("        total +=", "    total +=", True),  # out of the loop: half of the area
        ("/ 2.0", "/ 3.0", True),
        ("width < 0.0", "width <= 0.0", True),
    ):
        with_code(old, new)
        assert stored.is_stale(file) == stored.is_stale(module) == stale, new
    stored.confirm(file)
    assert not stored.is_stale(file) and "confirmed" in stored.read(file)
    stored.confirm(module, ["room.area"])
    (room / "another.py").write_text("NUMBER = 1\n")
    assert stored.is_stale(file) and not stored.is_stale(module)
    stored.confirm(module, ["room"])
    assert stored.read(module)["packages"] == ["room"] and not stored.is_stale(module)
    (room / "another.py").unlink()
    file.write_text(json.dumps(stored.read(file) | {"settings": {"mesh": 4}}))
    assert stored.is_stale(file)
