"""Trial run: tips are put back; when the rack runs out, the old ones are taken again."""

metadata = {"apiLevel": "2.13", "protocolName": "Amplicon plate copies"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 1)
    m20 = ctx.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])
    amplicon_plates = [
        ctx.load_labware("biorad_96_wellplate_200ul_pcr", slot, f"sample plate {slot}")
        for slot in (2, 3)
    ]
    copies = [
        ctx.load_labware("biorad_96_wellplate_200ul_pcr", slot, f"copy {slot}") for slot in (5, 6)
    ]
    for number, plate in enumerate(amplicon_plates):
        for source, dest in zip(plate.rows()[0], copies[number].rows()[0]):
            m20.pick_up_tip()
            m20.aspirate(5, source.bottom(0.5))
            m20.dispense(5, dest.bottom(0.5))
            m20.return_tip()
        if number == 0:
            ctx.pause("First plate done. Press resume.")
            m20.reset_tipracks()
