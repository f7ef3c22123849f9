"""Codes that a comment explains, and lines that look like codes and explain none."""

from __future__ import annotations

import pytest

from aegis_ot.preflight.text import legend_of, read_source


@pytest.mark.parametrize(
    ("comment", "legend"),
    [
        (
            "# m: mock, u: untreated, s1..s2: strychnine",
            {"m": "mock", "u": "untreated", "s1": "strychnine", "s2": "strychnine"},
        ),
        ("# m   mock\n# u   no virus", {"m": "mock", "u": "no virus"}),
        ("# m   mock   mock   virus\n# u   mock   virus   virus", {}),  # a drawn plate
        ("# m -> (see below)\n# u -> --", {}),
    ],
)
def test_what_codes_stand_for(comment: str, legend: dict[str, str]) -> None:
    assert legend_of(read_source(f"{comment}\nx = 1\n")) == legend
