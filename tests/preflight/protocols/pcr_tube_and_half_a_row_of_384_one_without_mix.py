# expect: pcr fail PCR-1
"""Two genes on a 384 plate. A control is its tube and its row, of which 8 wells are used."""

metadata = {"apiLevel": "2.15", "protocolName": "qPCR, two genes"}
GENES = {"GAPDH": range(0, 4), "IL6": range(4, 8)}


def run(protocol):
    plate = protocol.load_labware("corning_384_wellplate_112ul_flat", 2, "qPCR")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    boxes = [protocol.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (4, 5)]
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=boxes)

    master_mix = {"GAPDH": tubes["A1"], "IL6": tubes["B1"]}
    samples = [(tube, row) for tube, row in zip(tubes.columns()[3], plate.rows()[1:])]
    positive_control = (tubes["C1"], plate.rows()[5])
    ntc = (tubes["D1"], plate.rows()[6])  # water
    all_rows = [row for _, row in [*samples, positive_control, ntc]]

    for gene, columns in GENES.items():
        targets = [row[c] for row in all_rows for c in columns][:-5]
        p20.transfer(8, master_mix[gene], targets, new_tip="once")
    for tube, row in [ntc, positive_control, *samples]:
        p20.transfer(2, tube, row[:8], new_tip="always")
