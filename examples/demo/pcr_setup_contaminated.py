"""A PCR set-up with a mistake that no simulator sees: the guard rejects it before it runs.

The last tip that carried template also mixes the no-template control.
"""

from aegis_ot import guard

metadata = {
    "protocolName": "PCR set-up",
    "author": "aegis_ot examples",
    "apiLevel": "2.15",
}


@guard(assay="pcr")
def run(protocol):
    tips20 = protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)
    reagents = protocol.load_labware(
        "opentrons_24_tuberack_nest_1.5ml_snapcap", 2, label="Reagents"
    )
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 3, label="PCR plate")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips20])

    master_mix = reagents["A1"]
    water = reagents["A2"]
    template = reagents["B1"]
    master_mix.load_liquid(protocol.define_liquid("Master mix", "with primers", "#33cc33"), 500)
    water.load_liquid(protocol.define_liquid("Water", "nuclease-free", "#66bbff"), 500)
    template.load_liquid(
        protocol.define_liquid("Template DNA", "genomic, 10 ng/uL", "#ffaa00"), 200
    )

    replicates = plate.columns()[0][:7]
    ntc = plate["H1"]

    p20.transfer(15, master_mix, [*replicates, ntc])
    p20.transfer(5, water, ntc)

    p20.pick_up_tip()
    for well in replicates:
        p20.aspirate(5, template)
        p20.dispense(5, well)
    for well in [*replicates, ntc]:
        p20.mix(3, 10, well)
    p20.drop_tip()
