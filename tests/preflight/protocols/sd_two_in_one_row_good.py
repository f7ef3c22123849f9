# expect: serial_dilution pass
metadata = {"apiLevel": "2.13", "protocolName": "Serial dilution of two peptides"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    plate = protocol.load_labware("nest_96_wellplate_200ul_flat", 2)
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 3)
    p = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    diluent = tubes["D6"]
    for start, peptide in ((0, tubes["A1"]), (6, tubes["A2"])):
        wells = plate.rows()[1][start : start + 6]
        p.transfer(60, diluent, wells[1:], new_tip="once")
        p.transfer(120, peptide, wells[0], new_tip="always")
        for a, b in zip(wells, wells[1:]):
            p.transfer(60, a, b, mix_after=(3, 50), new_tip="always")
