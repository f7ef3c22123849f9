# expect: pcr fail PCR-5
"""qPCR of four templates, SYBR chemistry."""

metadata = {"protocolName": "qPCR, four templates", "apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", 1)
    rack = protocol.load_labware("opentrons_24_tuberack_eppendorf_1.5ml_safelock_snapcap", 2)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 3)
    pcr = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 5)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    sybr = rack["A1"]
    pos = rack["A2"]  # positive control
    templates = [rack[name] for name in ("B1", "B2", "B3", "B4")]
    water, waste = trough["A1"], trough["A2"]

    p20.pick_up_tip()
    for well in pcr.wells()[:8]:
        p20.aspirate(5, sybr)
        p20.dispense(5, well)
    p20.drop_tip()
    for template, well in zip(templates, pcr.wells()):
        p20.pick_up_tip()
        p20.aspirate(10, template)
        p20.dispense(10, well)
        p20.drop_tip()
    p20.pick_up_tip()
    for well in pcr.wells()[4:8]:
        p20.aspirate(10, pos)
        p20.dispense(10, well.top())
        p20.aspirate(20, water)  # rinse
        p20.dispense(20, waste.top())
    p20.drop_tip()
