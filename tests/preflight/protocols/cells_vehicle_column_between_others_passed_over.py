# expect: cell_treatment warn CELL-2
"""siRNAs on hepatocytes, a set of tips for each column."""

metadata = {
    "apiLevel": "2.15",
    "protocolName": "knockdown",
    "description": "col 2-3 siApoB, 4-5 siPCSK9, 6 Lipofectin vehicle (mock), 7 untreated, 8 siTTR",
}

COLUMNS = {"siApoB": (2, 3), "siPCSK9": (4, 5), "siTTR": (8,)}
MOCK = 6


def run(ctx):
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 5, "hepatocytes")
    strips = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 6, "complexes")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    m20 = ctx.load_instrument("p20_multi_gen2", "right", tip_racks=[tips])
    lipofectin_only = strips["A12"]  # vehicle: Lipofectin in medium

    def give(source, column):
        m20.pick_up_tip()
        m20.aspirate(12, source)
        m20.dispense(12, plate[f"A{column}"])
        m20.drop_tip()

    give(lipofectin_only, MOCK + 1)
    for columns in COLUMNS.values():
        for column in columns:
            give(strips[f"A{columns[0]}"], column)
