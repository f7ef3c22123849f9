# expect: pcr pass PCR-2! PCR-3!
"""Direct PCR for E. coli on filtered river water."""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", "7")
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", "1", "PCR plate")
    rivers = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2", "river water")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "3", "reagents")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mix, pcr_water, ntc = rack["A1"], rack["B1"], plate["H1"]
    for well in plate.columns()[0]:
        p20.transfer(15, master_mix, well, new_tip="always")
    for tube, well in zip(rivers.wells()[:7], plate.columns()[0]):
        p20.transfer(5, tube, well, new_tip="always")
    p20.transfer(5, pcr_water, ntc)
