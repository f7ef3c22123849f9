# expect: serial_dilution fail SD-1
"""Standards are diluted from tube to tube; what is left of the last one is thrown away."""

metadata = {"apiLevel": "2.13", "protocolName": "Serial dilution of a DNA standard"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    p = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    te_buffer, te_buffer_2, dna_standard = rack["D1"], rack["D2"], rack["C1"]
    liquid_trash = rack["B1"]
    std_1, std_2, std_3, std_4, std_5 = (rack[name] for name in ("A2", "A3", "A4", "A5", "A6"))
    standards = [std_1, std_2, std_3, std_4, std_5]
    p.transfer(180, te_buffer, std_1)
    p.transfer(100, te_buffer, [std_2, std_3, std_4])
    p.transfer(100, te_buffer_2, std_5)
    p.transfer(20, dna_standard, std_1, mix_after=(3, 100))
    for one, other in zip(standards, standards[1:]):
        p.transfer(100, one, other, new_tip="always")
    p.transfer(100, std_5, liquid_trash)
