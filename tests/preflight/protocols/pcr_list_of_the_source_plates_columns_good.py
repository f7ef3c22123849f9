# expect: pcr pass
"""qPCR of tissues; codes by column.

N = NTC, s = sample
"""

metadata = {"protocolName": "qPCR of tissues", "apiLevel": "2.13"}
# column by column of the RNA plate
COLUMNS = "s s s s s s s s s s s N".split()


def run(protocol):
    rna = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2, "RNA")
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 1)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 3)
    tips = [protocol.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (4, 5)]
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=tips)
    master_mix = trough["A1"]
    # the control goes first, to the left
    order = sorted(range(12), key=lambda n: COLUMNS[n])
    m20.transfer(15, master_mix, plate.rows()[0], new_tip="once")
    for place, n in enumerate(order):
        m20.transfer(5, rna.rows()[0][n], plate.rows()[0][place])
