"""Which files of a folder are custom labware."""

from __future__ import annotations

from pathlib import Path

import pytest

from aegis_ot.errors import ConfigurationError
from aegis_ot.workbench.files import labware_files


def test_hidden_files_of_an_archive_are_no_labware(tmp_path: Path) -> None:
    (tmp_path / "__MACOSX").mkdir()
    (tmp_path / "__MACOSX" / "._plate.json").write_bytes(b"\x00\x05")
    with pytest.raises(ConfigurationError, match="holds no"):
        labware_files([tmp_path])
    (tmp_path / "plate.json").write_text("{}")
    assert labware_files([tmp_path]) == [tmp_path / "plate.json"]
