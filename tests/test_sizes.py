"""Size is a cost: the package and its largest rooms have budgets, with some room in them.

``make check`` prints the figures (``python -m scripts.sizes``). This test only says when one is
spent, so that somebody decides what goes before more comes.
"""

from __future__ import annotations

import pytest

from scripts.sizes import BUDGETS, lines_of


@pytest.mark.parametrize("room", BUDGETS)
def test_a_room_keeps_to_its_budget(room: str) -> None:
    assert lines_of(room) <= BUDGETS[room]
