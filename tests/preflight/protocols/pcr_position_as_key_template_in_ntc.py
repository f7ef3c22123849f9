# expect: pcr fail PCR-4 PCR-6?
metadata = {"apiLevel": "2.15", "protocolName": "two assays on four cDNA samples"}
MIXES = {"ACTB master mix": "A6", "TP53 master mix": "B6"}


def run(protocol):
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 2)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    water = tubes["D6"]
    cdnas = [tubes[name] for name in ("A1", "B1", "C1", "D1")]

    for column, (assay, pos) in enumerate(MIXES.items()):
        p20.pick_up_tip()
        for well in plate.columns()[column][:5]:
            p20.aspirate(16, tubes[pos])
            p20.dispense(16, well)
        p20.drop_tip()
    for ntc in plate.rows_by_name()["E"][:2]:
        p20.transfer(4, cdnas[0], ntc, new_tip="always")
    for row, cdna in enumerate(cdnas):
        for well in plate.rows()[row][:2]:
            p20.transfer(4, cdna, well, new_tip="always")
