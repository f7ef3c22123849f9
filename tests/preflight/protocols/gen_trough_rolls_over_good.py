# expect: generic pass
metadata = {"protocolName": "Lysis buffer onto swabs", "apiLevel": "2.13"}

USABLE = 9000


def run(protocol):
    tips = protocol.load_labware("opentrons_96_filtertiprack_200ul", 7)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 3)
    swabs = protocol.load_labware("nest_96_wellplate_2ml_deep", 2, "swabs in medium")
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    channels = trough.wells()[:3]
    left = {channel: USABLE for channel in channels}

    def next_channel(volume):
        while left[channels[0]] < volume:
            channels.pop(0)
        left[channels[0]] -= volume
        return channels[0]

    m300.pick_up_tip()
    for column in swabs.rows()[0]:
        m300.aspirate(150, next_channel(8 * 150))
        m300.dispense(150, column.top())
    m300.drop_tip()
