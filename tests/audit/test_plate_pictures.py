"""Colour changes against the record: the wells that contradict it, and no others."""

from __future__ import annotations

import numpy as np

from aegis_ot.audit.plate_pictures import contradictions
from aegis_ot.audit.plate_record import RecordedPlate, RecordedWell
from aegis_ot.vision.plate import FORMATS, Change


def test_a_skipped_a_halved_and_a_wrong_well_are_found_and_no_others() -> None:
    plate = FORMATS[96]
    filled = plate.names[:24]
    wells = {name: RecordedWell({"red": 100.0}, 100.0) for name in filled}
    absorbed = np.random.default_rng(1).normal(0, 0.02, (96, 3))
    for place in range(24):
        absorbed[place] += np.array([1.0, 1.1, 0.1]) * {3: 0.0, 7: 0.5}.get(place, 1.0)
    absorbed[40] += np.array([1.0, 1.1, 0.1])
    blinded = np.zeros(96, bool)
    found = contradictions(Change(absorbed, blinded), RecordedPlate("1", "plate", plate, wells))
    by_well = {one.well: one.share for one in found}
    assert set(by_well) == {plate.names[3], plate.names[7], plate.names[40]}
    assert by_well[plate.names[40]] is None
    assert abs((by_well[plate.names[7]] or 0) - 0.5) < 0.1
    blinded[3] = True
    again = contradictions(Change(absorbed, blinded), RecordedPlate("1", "plate", plate, wells))
    assert plate.names[3] not in {one.well for one in again}
