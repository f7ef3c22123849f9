# expect: cell_treatment fail CELL-4
"""Two statins on HepG2 in two plates; for each of them the doses begin anew."""

metadata = {"apiLevel": "2.14", "protocolName": "Statins"}

STATINS = [("simvastatin", "A"), ("atorvastatin", "B")]
DOSES_UM = (8, 2, 0.5)


def run(ctx):
    plates = [
        ctx.load_labware("corning_24_wellplate_3.4ml_flat", slot, f"HepG2 cells {slot}")
        for slot in (5, 6)
    ]
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 8, "statins; vehicle in D6")
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 9)
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[tips])
    vehicle = rack["D6"]
    statins = {"simvastatin": rack.rows()[0][:3], "atorvastatin": rack.rows()[1][:3]}

    for plate in plates:
        p300.transfer(60, vehicle, [plate["D1"], plate["D2"]])
    for statin, row in STATINS:
        p300.pick_up_tip()
        for _dose, tube, column in zip(DOSES_UM, statins[statin], (2, 3, 4), strict=True):
            for plate in plates:
                p300.aspirate(60, tube)
                p300.dispense(60, plate[f"{row}{column}"])
        p300.drop_tip()
