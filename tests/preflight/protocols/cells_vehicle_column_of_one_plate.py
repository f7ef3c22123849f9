# expect: cell_treatment warn CELL-2
"""One compound per column on two replicate plates, vehicle in column 4, after the loop by mistake."""

metadata = {"apiLevel": "2.14", "protocolName": "Inhibitors, two replicate plates"}


def run(protocol):
    library = protocol.load_labware("nest_96_wellplate_200ul_flat", 1, "compounds 10x")
    replicates = [
        protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "HCT116 replicate 1"),
        protocol.load_labware("corning_96_wellplate_360ul_flat", 3, "HCT116 replicate 2"),
    ]
    trough = protocol.load_labware("nest_12_reservoir_15ml", 4)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 7)
    m20 = protocol.load_instrument("p20_multi_gen2", "right", tip_racks=[tips])
    vehicle = trough["A1"]

    for plate in replicates:
        for source, well in zip(library.rows()[0][:3], plate.rows()[0][:3]):
            m20.transfer(10, source, well.bottom(2), new_tip="always")

    # vehicle control column
    m20.pick_up_tip()
    m20.aspirate(10, vehicle)
    m20.dispense(10, plate.columns()[3][0].bottom(2))
    m20.drop_tip()
