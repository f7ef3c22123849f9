"""RT-qPCR for three cytokine genes on seven cDNAs.

Three master mixes (one per gene) stand in strip tubes, columns 1-3. Each gene gets a column
of the plate: rows A-G take the cDNAs, row H is the no-template control.
"""
from opentrons import protocol_api

metadata = {"protocolName": "Cytokine RT-qPCR", "author": "Inflammation group", "apiLevel": "2.15"}

GENES = ["IL1B", "TNF", "CXCL8"]


def run(ctx: protocol_api.ProtocolContext):
    cycler = ctx.load_module("thermocyclerModuleV1")
    plate = cycler.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", label="qPCR plate")
    strips = ctx.load_labware("opentrons_96_aluminumblock_generic_pcr_strip_200ul", "4", label="Master mix strips")
    cdna_strip = ctx.load_labware("opentrons_96_aluminumblock_generic_pcr_strip_200ul", "5", label="cDNA strip")
    filter20 = [ctx.load_labware("opentrons_96_filtertiprack_20ul", s) for s in ("1", "2")]
    m20 = ctx.load_instrument("p20_multi_gen2", "left", tip_racks=filter20)

    cdna = ctx.define_liquid("cDNA", "1:5", "#ddaa00")
    water = ctx.define_liquid("Water", "for the NTC", "#4488ff")
    for well in cdna_strip.columns()[0][:7]:
        well.load_liquid(cdna, 50)
    cdna_strip["H1"].load_liquid(water, 50)  # eighth tube of the strip

    cycler.open_lid()
    for gene, column in zip(GENES, range(3)):
        mix = ctx.define_liquid(f"{gene} master mix", "SYBR and primers", "#33cc33")
        for well in strips.columns()[column]:
            well.load_liquid(mix, 60)
        ntc = plate.columns()[column][7]
        reactions = plate.columns()[column][:7]
        m20.transfer(16, strips.columns()[column][0], plate.columns()[column][0])

    for column in range(3):
        m20.pick_up_tip()
        m20.aspirate(4, cdna_strip["A1"])
        m20.dispense(4, plate.columns()[column][0])
        m20.mix(4, 12, plate.columns()[column][0])
        m20.drop_tip()

    cycler.close_lid()
    cycler.set_lid_temperature(105)
    cycler.execute_profile(
        steps=[{"temperature": 95, "hold_time_seconds": 10}, {"temperature": 60, "hold_time_seconds": 30}],
        repetitions=40,
        block_max_volume=20,
    )
    cycler.deactivate_lid()
    cycler.open_lid()
