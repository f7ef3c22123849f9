# expect: cell_treatment fail CELL-2
from opentrons import protocol_api

metadata = {"apiLevel": "2.15", "protocolName": "Three donors, dexamethasone"}

VEHICLE_COLUMN = 0
DEX_COLUMNS = slice(1, 4)


def run(protocol: protocol_api.ProtocolContext):
    """Monocytes of three donors, one plate each, the same wells on all of them."""
    plates = [
        protocol.load_labware("corning_24_wellplate_3.4ml_flat", slot, donor)
        for slot, donor in ((1, "donor Kim"), (2, "donor Ada"), (3, "donor Lou"))
    ]
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5)
    trough = protocol.load_labware("nest_1_reservoir_195ml", 4)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 6)
    large = protocol.load_labware("opentrons_96_filtertiprack_200ul", 7)
    p20 = protocol.load_instrument("p20_single_gen2", "right", tip_racks=[tips])
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[large])
    ethanol, dexamethasone = rack["A1"], rack["A2"]
    medium = trough["A1"]

    for plate in plates:
        p300.transfer(190, medium, [well.top() for well in plate.wells()[:16]], new_tip="once")
    targets = []
    for plate in plates:
        targets.extend(plate.columns()[VEHICLE_COLUMN])
    p20.transfer(10, ethanol, targets[1:], new_tip="always")
    for plate in plates:
        for column in plate.columns()[DEX_COLUMNS]:
            p20.transfer(10, dexamethasone, column, new_tip="always")
