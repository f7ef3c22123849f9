metadata = {"apiLevel": "2.15", "protocolName": "End-point PCR, 8-channel"}


def run(protocol):
    n = 3
    tr = [protocol.load_labware("opentrons_96_tiprack_20ul", s) for s in (4, 5)]
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=tr)
    dna_plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 2, "DNA extracts")
    pcr_plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 1, "PCR plate")
    strips = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 3, "reagents")
    master_mix = strips["A1"]
    water_for_ntc = strips["A2"]
    sample_cols = pcr_plate.rows()[0][:n]
    ntc_col = pcr_plate["A12"]
    m20.distribute(15, master_mix, sample_cols + [ntc_col], disposal_volume=0)
    for src, dst in zip(dna_plate.rows()[0][: n + 1], sample_cols + [ntc_col]):
        m20.transfer(5, src, dst, mix_after=(2, 10))
