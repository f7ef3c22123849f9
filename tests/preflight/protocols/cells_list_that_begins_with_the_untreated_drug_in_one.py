# expect: cell_treatment fail CELL-1
"""Two kinase inhibitors on A375; the list is kept as it was mailed."""

metadata = {"protocolName": "A375, inhibitors", "apiLevel": "2.13"}
# compound; conc; tube; wells
LIST = """
untreated; -; -; A1 B1 C1 D1
DMSO; 0.1 %; D1; A2 B2 C2 D2
trametinib; 1 nM; A1; A3 B3 C3 D3
trametinib; 10 nM; A2; A4 B4 C4 D4
dabrafenib; 10 nM; B1; A5 B5 C5 D5
dabrafenib; 100 nM; B2; A6 B6 C6 D6
"""


def run(protocol):
    cells = protocol.load_labware("corning_24_wellplate_3.4ml_flat", 1, "A375 cells")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])

    for line in LIST.strip().splitlines():
        compound, conc, tube, wells = (cell.strip() for cell in line.split(";"))
        if tube == "-":
            continue
        for well in wells.split():
            p20.transfer(10, rack[tube], cells[well], new_tip="always")
        if compound == "dabrafenib":
            p20.transfer(10, rack[tube], cells["A1"])  # to be seen under the microscope
