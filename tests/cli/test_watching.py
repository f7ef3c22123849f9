"""``check --watch``: what lies around a protocol is looked at, also while a check is under way."""

from __future__ import annotations

from pathlib import Path

import pytest

from aegis_ot.cli.watching import watch
from aegis_ot.errors import ConfigurationError


def test_a_change_of_what_lies_around_a_protocol_is_checked(tmp_path: Path) -> None:
    place = tmp_path / "protocols" / "p.py"
    place.parent.mkdir()
    place.write_text("", encoding="utf-8")
    changes = [place, place.parent / "plate.csv", tmp_path / "pyproject.toml"]
    checks: list[int] = []

    def check() -> None:
        checks.append(1)
        if not changes:
            raise KeyboardInterrupt
        changes.pop(0).write_text("changed", encoding="utf-8")
        raise ConfigurationError("it is told of, and looked at again")

    with pytest.raises(KeyboardInterrupt):
        watch([place], check)
    assert len(checks) == 4
