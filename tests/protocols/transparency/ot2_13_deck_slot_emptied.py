"""A plate taken off the deck by `del`, another loaded in its slot after a pause."""
metadata = {"apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    source = protocol.load_labware("nest_12_reservoir_15ml", "3")
    pipette = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    for number in range(2):
        plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "2", f"plate {number}")
        pipette.transfer(60, source["A1"], plate.columns()[0][:2])
        protocol.pause(f"Take plate {number} away and put the next one in slot 2.")
        del protocol.deck["2"]
