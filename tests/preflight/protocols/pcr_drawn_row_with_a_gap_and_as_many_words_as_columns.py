# expect: pcr pass
"""Two genes in six patients, drawn as on the bench; column 4 is left out (scratched).

        1    2    3    4    5    6    7    8
A-B    c1   c2   c3        c4   c5   c6   NTC     GAPDH
C-D    c1   c2   c3        c4   c5   c6   NTC     IL8
"""

metadata = {"protocolName": "qPCR, IL8 and GAPDH", "apiLevel": "2.13"}


def run(protocol):
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 1)
    cdna = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2, "cDNA")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    tips = [protocol.load_labware("opentrons_96_filtertiprack_20ul", slot) for slot in (4, 5)]
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=tips)

    used = [0, 1, 2, 4, 5, 6]
    mixes = {"AB": rack["A1"], "CD": rack["A2"]}
    for rows, master_mix in mixes.items():
        for row in rows:
            wells = plate.rows_by_name()[row]
            p20.transfer(15, master_mix, [wells[n] for n in [*used, 7]], new_tip="once")
            for source, at in zip(cdna.rows()[0], used):
                p20.transfer(5, source, wells[at], new_tip="always")
            p20.transfer(5, rack["D6"], wells[7])
