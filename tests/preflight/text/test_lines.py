"""Lines are numbered as Python numbers them, whatever else ends a line elsewhere."""

from __future__ import annotations

import ast

from hypothesis import given
from hypothesis import strategies as st

from aegis_ot.preflight.text import source_lines

ODD = st.text(alphabet=st.sampled_from("ab\n\r\f\v\x1c\x85\u2028"), max_size=12)


@given(st.lists(ODD, max_size=4))
def test_the_statement_after_odd_characters_is_found_in_its_line(comments: list[str]) -> None:
    text = "".join(f"'''{comment}'''\n" for comment in comments) + "here = 1\n"
    statement = ast.parse(text).body[-1]
    assert source_lines(text)[statement.lineno - 1] == "here = 1"


def test_the_end_of_the_last_line_begins_no_other() -> None:
    assert source_lines("a\nb\n") == source_lines("a\nb") == ["a", "b"]
    assert source_lines("") == []
