# expect: generic fail GEN-1
"""Two antibodies from two troughs with one set of tips."""

metadata = {"apiLevel": "2.13", "protocolName": "Reagent addition"}


def run(protocol):
    m300 = protocol.load_instrument(
        "p300_multi_gen2",
        "left",
        tip_racks=[protocol.load_labware("opentrons_96_filtertiprack_200ul", 7)],
    )
    plate = protocol.load_labware("nest_96_wellplate_200ul_flat", 4)
    reservoir = protocol.load_labware("nest_12_reservoir_15ml", 1)
    capture_antibody = reservoir["A8"]
    detection_antibody = reservoir["A9"]
    m300.pick_up_tip()
    for antibody, wells in (
        (capture_antibody, plate.rows()[0][:6]),
        (detection_antibody, plate.rows()[0][6:]),
    ):
        for well in wells:
            m300.aspirate(25, antibody)
            m300.dispense(25, well)
    m300.drop_tip()
