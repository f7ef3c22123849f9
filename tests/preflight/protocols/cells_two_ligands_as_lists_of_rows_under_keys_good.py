# expect: cell_treatment pass
"""EGF and HGF on keratinocytes; one tip climbs through the doses of one ligand."""

metadata = {"apiLevel": "2.15"}

CONTROL_WELLS = ["A1", "B1"]
# ligand -> (ng/mL, drug tube, treated wells)
LIGANDS = {
    "EGF": [(2, "A2", ["A2", "B2"]), (20, "A3", ["A3", "B3"]), (200, "A4", ["A4", "B4"])],
    "HGF": [(0.5, "B2", ["C2", "D2"]), (5, "B3", ["C3", "D3"]), (50, "B4", ["C4", "D4"])],
}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_filtertiprack_200ul", "7")
    cells = protocol.load_labware("corning_24_wellplate_3.4ml_flat", "2")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "1")
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    vehicle = tubes["A1"]

    p300.pick_up_tip()
    for name in CONTROL_WELLS:
        p300.aspirate(40, vehicle)
        p300.dispense(40, cells[name])
    p300.drop_tip()
    for ligand, ladder in LIGANDS.items():
        p300.pick_up_tip()
        for dose, tube, names in ladder:
            for name in names:
                p300.aspirate(40, tubes[tube])
                p300.dispense(40, cells[name])
        p300.drop_tip()
