"""Ponatinib titration on K562, 48 h readout with CellTiter-Glo.

Columns 1 and 12 of the assay plate carry DMSO only; columns 2 to 9 carry eight
concentrations, lowest in column 2. Columns 10 and 11 stay untreated.
"""
from opentrons import protocol_api

metadata = {
    "protocolName": "K562 kinase inhibitor titration",
    "author": "Hematology core",
    "apiLevel": "2.15",
}

DOSES_NM = [0.3, 1, 3, 10, 30, 100, 300, 1000]


def run(ctx: protocol_api.ProtocolContext):
    tips = ctx.load_labware("opentrons_96_tiprack_20ul", 4)
    cells = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, label="K562 assay plate")
    drug_plate = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2, label="Drug dilutions")
    m20 = ctx.load_instrument("p20_multi_gen2", "right", tip_racks=[tips])

    k562 = ctx.define_liquid("K562 cells", "10,000 cells per well in RPMI", "#c0ffc0")
    dmso = ctx.define_liquid("DMSO 1 % in medium", "vehicle", "#dddddd")
    for well in cells.wells():
        well.load_liquid(k562, 90)
    for well in drug_plate.columns()[0]:
        well.load_liquid(dmso, 80)
    for nm, column in zip(DOSES_NM, drug_plate.columns()[1:9]):
        inhibitor = ctx.define_liquid(f"Ponatinib {nm} nM", "10x, matched DMSO", "#ff8800")
        for well in column:
            well.load_liquid(inhibitor, 60)

    vehicle_controls = [cells.columns()[0], cells.columns()[11]]
    treated = cells.columns()[1:9]

    # controls first
    m20.pick_up_tip()
    for col in vehicle_controls:
        m20.aspirate(10, drug_plate["A1"])
        m20.dispense(10, col[0])
        m20.blow_out(col[0].top())
    m20.drop_tip()

    # one set of tips, rising dose
    m20.pick_up_tip()
    for source, col in zip(drug_plate.columns()[1:9], treated):
        m20.aspirate(10, source[0])
        m20.dispense(10, col[0])
        m20.mix(2, 15, col[0])
        m20.blow_out(col[0].top())
    m20.drop_tip()
