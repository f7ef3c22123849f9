"""Eosin standard curve: the first well of the row holds the undiluted stock, one tip for all steps."""

metadata = {"apiLevel": "2.13", "protocolName": "Eosin linearity"}


def run(protocol):
    troughs = protocol.load_labware("nest_12_reservoir_15ml", 1)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 2)
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 3)
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])

    buffer = troughs["A1"]
    eosin_stock = troughs["A2"]
    undiluted, *diluted = [column[0] for column in plate.columns()[:6]]

    m300.transfer(100, buffer, diluted)
    m300.transfer(200, eosin_stock, undiluted)
    before = undiluted
    m300.pick_up_tip()
    for well in diluted:
        m300.aspirate(100, before)
        m300.dispense(100, well)
        m300.mix(4, 80, well)
        before = well
    m300.drop_tip()
