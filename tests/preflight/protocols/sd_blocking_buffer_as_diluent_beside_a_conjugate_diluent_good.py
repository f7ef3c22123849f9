# expect: serial_dilution pass
"""Primary antibody titrated in blocking buffer; the conjugate is thinned in its own diluent."""

metadata = {"protocolName": "ELISA, titration of the primary", "apiLevel": "2.13"}


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "titration plate")
    trough = protocol.load_labware("nest_12_reservoir_15ml", 2)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 4)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    blocking_buffer, conjugate_diluent = trough["A1"], trough["A2"]
    antibody_stock, conjugate, working_conjugate = rack["A1"], rack["A2"], rack["B1"]
    wells = plate.rows()[3][:10]

    p300.transfer(120, blocking_buffer, wells, new_tip="once")
    for here, there in zip([antibody_stock, *wells], wells):
        p300.transfer(60, here, there, mix_after=(5, 90), new_tip="always")
    p300.transfer(900, conjugate_diluent, working_conjugate)
    p300.transfer(100, conjugate, working_conjugate, mix_after=(5, 200))
