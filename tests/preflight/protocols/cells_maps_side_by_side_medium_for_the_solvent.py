# expect: cell_treatment warn CELL-2
# Estradiol on MCF-7
#
# Trough (slot 5)                  Plate of cells (slot 1)
# A1   charcoal-stripped medium    columns 1, 2     no hormone
# A2   ethanol 0.1 %               columns 3, 4     solvent control
# A3   estradiol 0.1 nM            columns 5, 6     low
# A4   estradiol 10 nM             columns 7, 8     high

metadata = {"protocolName": "Estradiol, MCF-7", "apiLevel": "2.13"}


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 5)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 4)
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])

    for number, lane in enumerate(("A1", "A1", "A3", "A4")):
        for column in plate.columns()[2 * number : 2 * number + 2]:
            m20.transfer(10, trough[lane], column[0], new_tip="always")
