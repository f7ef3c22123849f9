# expect: pcr fail PCR-1
"""What each helper pipettes is only said by its name, without a verb. C1 is forgotten."""

from opentrons import protocol_api

metadata = {"apiLevel": "2.14", "protocolName": "Wolbachia screen"}


def run(protocol: protocol_api.ProtocolContext):
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "1")
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", "2")
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", "3")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])

    def master_mix_into(names):
        p20.transfer(16, tubes["A6"], [plate[n] for n in names], new_tip="once")

    def mosquito(tube, name):
        p20.transfer(4, tubes[tube], plate[name], mix_after=(2, 10), new_tip="always")

    def water_instead_of_template(name):
        p20.transfer(4, tubes["D6"], plate[name], mix_after=(2, 10), new_tip="always")

    master_mix_into(["A1", "B1", "D1", "E1"])
    mosquito("A1", "A1")
    mosquito("B1", "B1")
    mosquito("C1", "C1")
    water_instead_of_template("D1")
