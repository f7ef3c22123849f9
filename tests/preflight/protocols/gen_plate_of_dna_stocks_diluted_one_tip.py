# expect: generic fail GEN-1 GEN-2
"""DNA with fresh tips into a plate, then Tris into all of its wells with one tip."""

metadata = {"apiLevel": "2.13", "protocolName": "DNA normalisation"}
JOBS = {"A1": (10, 20), "B1": (15, 15), "C1": (20, 10), "D1": (12, 18)}


def run(protocol):
    stocks = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 1, "gDNA stocks")
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 2, "normalised DNA")
    trough = protocol.load_labware("nest_12_reservoir_15ml", 3, "10 mM Tris")
    tips = protocol.load_labware("opentrons_96_filtertiprack_200ul", 5)
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[tips])

    for name, (dna, _) in JOBS.items():
        p300.transfer(dna, stocks[name], plate[name], new_tip="always", mix_after=(3, 15))
    p300.pick_up_tip()
    for name, (_, buffer) in JOBS.items():
        p300.aspirate(buffer, trough["A1"])
        p300.dispense(buffer, plate[name])
    p300.drop_tip()
