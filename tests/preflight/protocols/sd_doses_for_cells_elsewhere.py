# expect: serial_dilution fail SD-5
"""TNF-alpha dose curve for the HEK reporter assay. The cells get it tomorrow, by hand."""

metadata = {"protocolName": "Cytokine doses for HEK reporter", "apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    block = protocol.load_labware("nest_96_wellplate_2ml_deep", 2, "doses")
    trough = protocol.load_labware("nest_12_reservoir_15ml", 3)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    diluent = trough["A2"]  # DMEM
    row = block.rows()[1][:7]
    p300.transfer(200, diluent, row[1:])
    p300.pick_up_tip()
    for strong, weak in zip(row, row[1:]):
        p300.aspirate(100, strong)
        p300.dispense(100, weak)
        p300.mix(5, 150, weak)
    p300.drop_tip()
