"""Texts from outside, made fit to be shown."""

from __future__ import annotations

import pytest

from aegis_ot.vocabulary import csv_cell, from_csv_cell, no_commands, printable


def test_what_would_repaint_a_terminal_is_a_space():
    assert printable("A1\x1b[2J of\nplate µL 板") == "A1 [2J of plate µL 板"
    assert printable("a\nb\tc", "\n") == "a\nb c"


@pytest.mark.parametrize("line", ["::error::x", "  ::stop-commands::t", "name ##[error]x"])
def test_no_line_is_a_command_to_a_runner(line):
    told = no_commands(f"first\n{line}\nlast: 1::2")
    assert not any(each.lstrip().startswith("::") for each in told.splitlines())
    assert "##[" not in told
    assert told.endswith("\nlast: 1::2")


@pytest.mark.parametrize("text", ["=1+1", "+x", "-x", "@x", "\tx", "'=quoted", "'plain"])
def test_a_cell_that_a_spreadsheet_would_run_is_a_text_and_comes_back(text):
    cell = csv_cell(text)
    assert str(cell).startswith("'")
    assert from_csv_cell(str(cell)) == text


@pytest.mark.parametrize("value", ["plain", "-1.50", "+3", -1.5, 7, "", "1-2"])
def test_other_cells_stay_as_they_are(value):
    assert csv_cell(value) == value
    assert from_csv_cell(str(value)) == str(value)
