"""Plain facts of a labware: where its wells are."""

from __future__ import annotations

from aegis_ot.adapters.opentrons.instrumentation.labware import LabwareInfo, WellInfo


def test_of_two_wells_at_one_place_the_first_is_found_there() -> None:
    wells = {
        "A1": WellInfo(200.0, 10.0, x=14.38, y=74.24, diameter=6.8),
        "A2": WellInfo(200.0, 10.0, x=23.38, y=74.24, diameter=6.8),
        "inlet": WellInfo(20.0, 2.0, x=14.38, y=74.24, diameter=2.0),
    }
    plate = LabwareInfo("labware-1", "plate", "Plate", "", "1", False, False, wells=wells)
    assert plate.middles == {(14.38, 74.24): "A1", (23.38, 74.24): "A2"}
