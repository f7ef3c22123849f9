# expect: cell_treatment fail CELL-3
metadata = {"protocolName": "Zytotoxizität HepG2", "apiLevel": "2.13"}


def run(ctx):
    spitzen = ctx.load_labware("opentrons_96_filtertiprack_20ul", 5)
    zellplatte = ctx.load_labware("corning_96_wellplate_360ul_flat", 2)
    gestell = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    p = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[spitzen])
    loesungsmittel = gestell["A1"]
    wirkstoff = gestell["A2"]
    loesungsmittelkontrolle = zellplatte.columns()[0]
    behandelt = zellplatte.columns()[1]
    p.pick_up_tip()
    for w in behandelt:
        p.aspirate(5, wirkstoff)
        p.dispense(5, w)
        p.mix(1, 5, w)
    for w in loesungsmittelkontrolle:
        p.aspirate(5, loesungsmittel)
        p.dispense(5, w)
    p.drop_tip()
