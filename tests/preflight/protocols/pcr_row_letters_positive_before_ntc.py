# expect: pcr fail PCR-2 PCR-5
"""LAMP on two plates: positive control and NTC with one tip; rows by letter."""

metadata = {"apiLevel": "2.15", "protocolName": "LAMP, two plates"}
TEMPLATE_ROWS = ("A", "B", "C", "D", "E", "F")
POS_ROW, NTC_ROW = "G", "H"


def run(protocol):
    plates = [protocol.load_labware("biorad_96_wellplate_200ul_pcr", s) for s in (1, 2)]
    eluates = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 7, "RNA eluates")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5)
    tips = [protocol.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (3, 6)]
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    master_mix, pos, water = tubes["A1"], tubes["B1"], tubes["C1"]
    for plate in plates:
        p20.distribute(15, master_mix, [plate[f"{r}1"] for r in (*TEMPLATE_ROWS, POS_ROW, NTC_ROW)])
        for r in TEMPLATE_ROWS:
            p20.transfer(5, eluates[f"{r}1"], plate[f"{r}1"])
        p20.pick_up_tip()
        p20.transfer(5, pos, plate[f"{POS_ROW}1"], new_tip="never")
        p20.transfer(5, water, plate[f"{NTC_ROW}1"], new_tip="never")
        p20.drop_tip()
