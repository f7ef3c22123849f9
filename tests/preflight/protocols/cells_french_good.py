# expect: cell_treatment pass
"""Traitement des cellules HeLa : colonnes 2-5 composés, colonne 1 témoin solvant."""

metadata = {"protocolName": "HeLa composés", "apiLevel": "2.13"}


def run(protocol):
    pointes = protocol.load_labware("opentrons_96_filtertiprack_20ul", 5)
    plaque = protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "HeLa")
    portoir = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    p = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[pointes])
    solvant = portoir["A1"]
    composes = [portoir["B1"], portoir["B2"], portoir["B3"], portoir["B4"]]
    temoin_solvant = plaque.columns()[0]
    p.transfer(5, solvant, temoin_solvant)
    for k, c in enumerate(composes, 1):
        p.transfer(5, c, plaque.columns()[k], new_tip="once")
