# expect: pcr pass
"""A helper called after what it makes draws the parts of it: none of them is the mix."""

from opentrons import protocol_api

metadata = {"apiLevel": "2.14", "protocolName": "PCR of two clones"}


def run(protocol: protocol_api.ProtocolContext):
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "1")
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", "2")
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", "3")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    mix_tube = tubes["A6"]

    def combine_master_mix_into(tube):
        for part in ("B6", "C6", "D6"):
            p20.transfer(20, tubes[part], tube, new_tip="always")

    def clone(tube, name):
        p20.transfer(4, tubes[tube], plate[name], mix_after=(2, 10), new_tip="always")

    combine_master_mix_into(mix_tube)
    p20.transfer(16, mix_tube, [plate["A1"], plate["B1"]], new_tip="once")
    clone("A1", "A1")
    clone("B1", "B1")
