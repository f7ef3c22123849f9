# Otter genotyping, batch 12
#
# Position 1   reagent rack, kept on ice by the operator until the run begins
# Position 2   PCR plate
# Position 3   extract plate
# Position 6   tips 20 uL
#
# Reagent rack
#   A1 master mix
#   B1 water
# Extract plate
#   A1-F1 otter DNA
# PCR plate
#   A1-F1 otters
#   G1 NTC
metadata = {"apiLevel": "2.14", "author": "Wildlife"}


def run(protocol):
    r = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    p = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 2)
    e = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 3)
    t = protocol.load_labware("opentrons_96_filtertiprack_20ul", 6)
    m = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[t])

    m.transfer(15, r["A1"], p.columns()[0][:7])
    for s, d in zip(e.columns()[0][:6], p.columns()[0]):
        m.transfer(5, s, d, mix_after=(2, 10))
    m.transfer(5, e["F1"], p["G1"])
