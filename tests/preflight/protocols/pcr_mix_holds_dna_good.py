# expect: pcr pass
"""qPCR primer matrix: the same DNA in every reaction, so it is put into the mix beforehand."""

metadata = {"apiLevel": "2.13", "protocolName": "qPCR primer matrix"}


def run(protocol):
    p20 = protocol.load_instrument(
        "p20_single_gen2", "left", tip_racks=[protocol.load_labware("opentrons_96_tiprack_20ul", 1)]
    )
    p300 = protocol.load_instrument(
        "p300_single_gen2",
        "right",
        tip_racks=[protocol.load_labware("opentrons_96_tiprack_300ul", 5)],
    )
    rack = protocol.load_labware("opentrons_24_aluminumblock_nest_1.5ml_screwcap", 2)
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 3)
    master_mix, std_dna, dna_mix = rack["A1"], rack["A2"], rack["A3"]
    rev_primer, fwd_primer = rack["B1"], rack["B2"]
    r_mixes = [rack["C1"], rack["C2"], rack["C3"]]
    p300.transfer(900, master_mix, dna_mix)
    p20.transfer(20, std_dna, dna_mix, mix_after=(2, 20))
    p300.pick_up_tip()
    for tube in r_mixes:
        for _ in range(2):
            p300.aspirate(140, dna_mix)
            p300.dispense(140, tube.bottom(5))
            p300.blow_out(tube.bottom(10))
    p300.drop_tip()
    for tube, volume in zip(r_mixes, (4, 8, 12)):
        p20.pick_up_tip()
        p20.aspirate(volume, rev_primer)
        p20.dispense(volume, tube)
        p20.mix(2, volume, tube)
        p20.drop_tip()
    for tube, row in zip(r_mixes, plate.rows()):
        p300.pick_up_tip()
        p300.mix(3, 150, tube)
        p300.distribute(20, tube, row, new_tip="never", disposal_volume=0)
        p300.drop_tip()
    for column in plate.columns()[:12]:
        for well in column[:3]:
            p20.transfer(1, fwd_primer, well.bottom(1), new_tip="always")
