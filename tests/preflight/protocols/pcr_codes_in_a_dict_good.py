# expect: pcr pass
metadata = {"protocolName": "SNP PCR", "apiLevel": "2.13"}
CODES = {"S": "sample", "N": "no template control"}
LAYOUT = {"S": ["A1", "B1", "C1", "D1"], "N": ["H1"]}


def run(protocol):
    dna = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 1, "gDNA templates")
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 2)
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 7)
    pip = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mix, water = tubes["A1"], tubes["A2"]
    for code, wells in LAYOUT.items():
        for name in wells:
            pip.transfer(15, master_mix, plate[name], new_tip="always")
            source = water if code == "N" else dna[name]
            pip.transfer(5, source, plate[name], new_tip="always")
