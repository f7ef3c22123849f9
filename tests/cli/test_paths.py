"""What a command says of a place where it cannot write."""

from __future__ import annotations

from pathlib import Path

import pytest

EXAMPLE = Path(__file__).resolve().parents[2] / "examples/demo/pcr_setup_contaminated.py"


@pytest.mark.parametrize(
    "arguments",
    [
        ("check", EXAMPLE, "--output"),
        ("simulate", EXAMPLE, "--report"),
        ("wrap", EXAMPLE, "--out"),
    ],
    ids=lambda arguments: arguments[0],
)
def test_a_folder_in_the_place_of_a_file_is_one_sentence(aegis, tmp_path: Path, arguments) -> None:
    (tmp_path / "folder").mkdir()
    result = aegis(*arguments, "folder")
    assert result.code == 2
    assert "folder cannot be written: Is a directory." in result.err
