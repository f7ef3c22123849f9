metadata = {"apiLevel": "2.14", "protocolName": "Bring to 900 uL"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    bottle = protocol.load_labware("agilent_1_reservoir_290ml", 2)
    vials = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    p = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    ringer = protocol.define_liquid("Ringer's solution", "", "#00aaff")
    tears = protocol.define_liquid("tear fluid", "one vial a person", "#ffaa00")
    bottle["A1"].load_liquid(ringer, 200000)
    for vial in vials.wells()[:6]:
        vial.load_liquid(tears, 300)
        p.transfer(600, bottle["A1"], vial, mix_after=(2, 200), new_tip="once")
