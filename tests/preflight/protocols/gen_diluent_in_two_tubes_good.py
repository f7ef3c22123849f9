# expect: generic pass
"""Normalise: the diluent stands in a column of tubes, the next one is taken when one runs dry."""

metadata = {"apiLevel": "2.13", "protocolName": "Normalization"}
VOLUMES = [400, 350, 480, 390, 410, 300]


def run(protocol):
    p300 = protocol.load_instrument(
        "p300_single_gen2",
        "left",
        tip_racks=[
            protocol.load_labware("opentrons_96_tiprack_300ul", 1),
            protocol.load_labware("opentrons_96_tiprack_300ul", 5),
        ],
    )
    tube_rack = protocol.load_labware("opentrons_24_tuberack_eppendorf_1.5ml_safelock_snapcap", 2)
    norm_plate = protocol.load_labware("nest_96_wellplate_2ml_deep", 3, "destination plate")
    src_plate = protocol.load_labware("nest_96_wellplate_2ml_deep", 4, "source plate")
    tubes = iter(tube_rack.columns()[-1])
    dil_src, left = next(tubes), 1500
    p300.pick_up_tip()
    for volume, dest in zip(VOLUMES, norm_plate.wells()):
        if left < volume:
            dil_src, left = next(tubes), 1500
        left -= volume
        p300.transfer(volume, dil_src, dest, new_tip="never")
    p300.drop_tip()
    for src, dest in zip(src_plate.wells()[:6], norm_plate.wells()):
        p300.transfer(100, src, dest, mix_after=(3, 100))
