"""How long a protocol simulates, and what is said of one that does not."""

from __future__ import annotations

from pathlib import Path

import pytest

from aegis_ot.errors import ProtocolRejected, RehearsalError
from aegis_ot.robot.timing import simulation_s
from aegis_ot.robot.wrapping import wrap

from .protocols import BAD, GOOD

DEMO = Path(__file__).parents[2] / "examples" / "demo"


def test_the_time_of_a_simulation_is_told(tmp_path: Path) -> None:
    (tmp_path / "good.py").write_text(GOOD)
    assert 0 < simulation_s(tmp_path / "good.py", "good.py") < 60


def test_a_protocol_that_raises_is_told_as_the_app_tells_it(tmp_path: Path) -> None:
    (tmp_path / "bad.py").write_text(BAD)
    with pytest.raises(RehearsalError) as told:
        simulation_s(tmp_path / "bad.py", "bad.py")
    assert "no such thing" in str(told.value)
    assert "[line 5]" in str(told.value)
    assert "ErrorOccurrence" not in str(told.value)


def test_a_protocol_that_layer_1_refuses_is_no_broken_one(tmp_path: Path) -> None:
    text = (DEMO / "pcr_setup_contaminated.py").read_text(encoding="utf-8")
    (tmp_path / "wrapped.py").write_text(wrap(text, {}).text, encoding="utf-8")
    with pytest.raises(ProtocolRejected) as told:
        simulation_s(tmp_path / "wrapped.py", "wrapped.py")
    assert "PCR-2" in str(told.value)
