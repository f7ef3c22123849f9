"""What a recorded run says of its plate's wells."""

from __future__ import annotations

from pathlib import Path

import pytest

from aegis_ot.audit.plate_record import recorded_plate
from aegis_ot.errors import ConfigurationError
from aegis_ot.sidecar.overview import run_overview
from aegis_ot.sidecar.store import Store


def test_each_well_got_what_was_delivered_and_unclear_questions_are_asked(passed: Path) -> None:
    overview = run_overview(Store(passed), "run-1")
    plate = recorded_plate(overview, "", 96)
    assert set(plate.wells) == {f"{row}1" for row in "ABCDEFGH"}
    assert {tuple(one.gained.items()) for one in plate.wells.values()} == {(("red dye", 150.0),)}
    with pytest.raises(ConfigurationError, match="none stood in slot 5"):
        recorded_plate(overview, "5", 96)
    with pytest.raises(ConfigurationError, match="--plate-wells"):
        recorded_plate(overview, "", None)
