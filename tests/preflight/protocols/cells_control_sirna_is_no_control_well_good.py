# expect: cell_treatment pass
"""siRNA complexes are made in a deep-well plate, one per siRNA, and then given to HeLa cells."""

metadata = {"apiLevel": "2.13", "protocolName": "siRNA knock-down in HeLa"}

SIRNAS = ["siCtrl", "siGAPDH", "siKIF11"]
UNTREATED = ["B8", "C8", "D8"]


def run(protocol):
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "HeLa cells")
    prep = protocol.load_labware("nest_96_wellplate_2ml_deep", 2, "complexes")
    tubes = protocol.load_labware(
        "opentrons_24_tuberack_nest_1.5ml_snapcap", 4, "siRNA 200 nM in Opti-MEM"
    )
    tips = protocol.load_labware("opentrons_96_filtertiprack_200ul", 5)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])

    lipid = tubes["D6"]
    sirna = {name: tubes.wells()[at] for at, name in enumerate(SIRNAS)}
    complexes = {name: prep.rows()[0][at] for at, name in enumerate(SIRNAS)}

    for name in SIRNAS:
        p300.transfer(50, lipid, complexes[name], new_tip="always")
        p300.transfer(50, sirna[name], complexes[name], mix_after=(3, 60), new_tip="always")
    for at, name in enumerate(SIRNAS):
        for row in "BCD":
            p300.transfer(20, complexes[name], cells[f"{row}{at + 3}"], new_tip="always")
    for name in UNTREATED:
        p300.transfer(20, tubes["C6"], cells[name], new_tip="always")  # Opti-MEM
