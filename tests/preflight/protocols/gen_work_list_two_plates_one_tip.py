"""Hit picking: each hit goes into two wells, with one tip for both."""

metadata = {"protocolName": "hit picking", "apiLevel": "2.15"}

PICKS = [
    ("LIB-01", "A04", "A1"),
    ("LIB-01", "A04", "A2"),
    ("LIB-02", "C07", "B1"),
    ("LIB-02", "C07", "B2"),
    ("LIB-01", "E10", "C1"),
    ("LIB-01", "E10", "C2"),
    ("LIB-02", "E10", "D1"),
    ("LIB-02", "E10", "D2"),
]


def plain(name):
    return name[0] + str(int(name[1:]))


def run(protocol):
    plates = {
        "LIB-01": protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 1, "LIB-01"),
        "LIB-02": protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2, "LIB-02"),
    }
    picked = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 3, "picked")
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", 4)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    last = None
    for plate, src_well, dst_well in PICKS:
        if src_well != last:
            if p20.has_tip:
                p20.drop_tip()
            p20.pick_up_tip()
        p20.aspirate(5, plates[plate][plain(src_well)])
        p20.dispense(5, picked[dst_well])
        p20.blow_out(picked[dst_well].top())
        last = src_well
    p20.drop_tip()
