"""HepG2 cells; the plan says what goes where, and the run says it too."""

metadata = {"protocolName": "Cytotoxicity of staurosporine, HepG2", "apiLevel": "2.15"}
PLAN = "10,A1,3;1,A2,4;0.1,A3,5".split(";")


def run(protocol):
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3, "HepG2 cells")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    p20.pick_up_tip()
    for line in PLAN:
        um, tube, column = line.split(",")
        protocol.comment(f"staurosporine {um} uM")
        for well in plate.columns_by_name()[column]:
            p20.aspirate(5, rack[tube])
            p20.dispense(5, well)
    p20.drop_tip()
