# expect: pcr fail PCR-3
"""PCR set-up on a deck whose slots are called A1 to D4: the positives stand in column 4."""

metadata = {"apiLevel": "2.13", "protocolName": "PCR set-up"}
POS_CONTROLS = ["B4", "C4", "D4"]


def run(protocol):
    m20 = protocol.load_instrument(
        "p20_multi_gen2", "left", tip_racks=[protocol.load_labware("opentrons_96_tiprack_20ul", 1)]
    )
    reagents = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 3)
    templates = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 4, "DNA template plate")
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 5, "reaction plate")
    for column in range(3):
        m20.pick_up_tip()
        m20.aspirate(10, reagents["A4"])
        m20.dispense(10, plate.rows()[0][column])
        m20.drop_tip()
    for source, destination, further in zip(
        templates.rows()[0][:3], plate.rows()[0], plate.rows()[0][6:]
    ):
        m20.pick_up_tip()
        m20.aspirate(5, reagents["A4"])
        m20.dispense(5, destination)
        m20.aspirate(5, source)
        m20.dispense(5, further)
        m20.drop_tip()
