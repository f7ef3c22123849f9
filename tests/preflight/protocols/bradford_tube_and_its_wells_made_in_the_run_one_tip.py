# expect: bradford fail BRD-2
"""Bradford: standards and eluates in one rack, a dict of each."""

metadata = {"apiLevel": "2.14", "protocolName": "Bradford eluates"}
# ug/mL -> tube
STANDARD_TUBES = {0: "A1", 125: "A2", 500: "A3", 1000: "A4"}
STANDARD_WELLS = {0: ("A1", "A2"), 125: ("B1", "B2"), 500: ("C1", "C2"), 1000: ("D1", "D2")}
ELUATES = {
    f"eluate{n}": (tube, (f"{row}4", f"{row}5"))
    for n, (tube, row) in enumerate(zip(["C1", "C2", "D1", "D2"], "ABCD"), start=1)
}


def run(protocol):
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1, "BSA and eluates")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "Bradford plate")
    dye = protocol.load_labware("nest_12_reservoir_15ml", 3, "Bradford dye")["A1"]
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", 4)
    large = protocol.load_labware("opentrons_96_tiprack_300ul", 7)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[large])

    def copy(tube, wells):
        for name in wells:
            p20.aspirate(5, rack[tube])
            p20.dispense(5, plate[name])

    for replicate in (0, 1):
        p20.pick_up_tip()
        for conc, tube in STANDARD_TUBES.items():
            copy(tube, [STANDARD_WELLS[conc][replicate]])
        p20.drop_tip()
    p20.pick_up_tip()
    for tube, wells in ELUATES.values():
        copy(tube, wells)
    p20.drop_tip()
    wells = [w for pair in STANDARD_WELLS.values() for w in pair]
    wells += [w for _, pair in ELUATES.values() for w in pair]
    for name in wells:
        p300.transfer(250, dye, plate[name], mix_after=(3, 150))
