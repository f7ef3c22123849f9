# expect: bradford pass BRD-1! BRD-2!
"""Bradford: two racks, two tables of the same columns, one helper for both."""

metadata = {"apiLevel": "2.13", "protocolName": "Bradford membranes"}
# BSA, ug/mL: tube on the standards rack, row on the plate
STANDARDS = {
    0: {"tube": "A1", "row": "A"},
    250: {"tube": "A2", "row": "B"},
    500: {"tube": "A3", "row": "C"},
    1000: {"tube": "A4", "row": "D"},
}
FRACTIONS = {
    "fraction_1": {"tube": "A1", "row": "A"},
    "fraction_2": {"tube": "A2", "row": "B"},
    "fraction_3": {"tube": "A3", "row": "C"},
}


def run(protocol):
    rack = "opentrons_24_tuberack_nest_1.5ml_snapcap"
    std_rack = protocol.load_labware(rack, 1, "BSA standards rack")
    frac_rack = protocol.load_labware(rack, 2, "membrane fractions")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3, "assay plate")
    dye = protocol.load_labware("nest_12_reservoir_15ml", 6, "dye reagent")["A1"]
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", 4)
    large = protocol.load_labware("opentrons_96_tiprack_300ul", 5)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[large])

    def ordered(table):
        return [table[key] for key in sorted(table)]

    for column in (1, 2):
        p20.pick_up_tip()
        for entry in ordered(STANDARDS):
            p20.aspirate(10, std_rack[entry["tube"]])
            p20.dispense(10, plate[f"{entry['row']}{column}"])
        p20.drop_tip()
    for entry in ordered(FRACTIONS):
        p20.pick_up_tip()
        p20.aspirate(10, frac_rack[entry["tube"]])
        p20.dispense(10, plate[f"{entry['row']}5"])
        p20.drop_tip()
    used = [f"{e['row']}{c}" for e in STANDARDS.values() for c in (1, 2)]
    used += [f"{e['row']}5" for e in FRACTIONS.values()]
    for name in used:
        p300.transfer(200, dye, plate[name], mix_after=(2, 150))
