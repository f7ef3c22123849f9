# expect: generic pass
"""Exchange buffer is added to proteins in concentrators in two portions; then they are recovered."""

metadata = {"apiLevel": "2.13", "protocolName": "Buffer exchange"}


def run(protocol):
    concentrators = protocol.load_labware(
        "opentrons_24_tuberack_eppendorf_2ml_safelock_snapcap", 1, "concentrators"
    )
    buffers = protocol.load_labware("opentrons_6_tuberack_falcon_50ml_conical", 2, "HEPES buffer")
    recovered = protocol.load_labware("opentrons_24_aluminumblock_nest_1.5ml_screwcap", 3)
    tips = protocol.load_labware("opentrons_96_filtertiprack_1000ul", 4)
    p1000 = protocol.load_instrument("p1000_single_gen2", "right", tip_racks=[tips])

    buffer = buffers["A1"]
    proteins = concentrators.wells()[:4]
    for protein in proteins:
        for portion in range(2):
            p1000.pick_up_tip()
            p1000.aspirate(400, buffer)
            p1000.dispense(400, protein)
            p1000.mix(2, 200, protein)
            p1000.drop_tip()
    protocol.pause("Spin 10 min, empty the flow-through")
    for protein, tube in zip(proteins, recovered.wells()):
        p1000.transfer(100, protein, tube, new_tip="always")
