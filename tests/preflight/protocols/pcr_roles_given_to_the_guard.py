from aegis_ot import guard

metadata = {"apiLevel": "2.15"}


@guard(
    assay="pcr",
    roles={
        "master_mix": ["2:A1"],
        "template": ["2:B1-B4"],
        "water": ["2:C1"],
        "ntc": ["qPCR plate:A12", "qPCR plate:B12"],
    },
)
def run(protocol):
    rack = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2)
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 1, "qPCR plate")
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", 4)
    p20 = protocol.load_instrument("p20_single_gen2", "left", [tips])

    wells = plate.rows()[0][:4] + [plate["A12"], plate["B12"]]
    p20.transfer(15, rack["A1"], wells, new_tip="once")
    for n in range(4):
        p20.pick_up_tip()
        p20.aspirate(5, rack.rows()[1][n])
        p20.dispense(5, wells[n])
        if n == 3:
            p20.mix(2, 10, plate["B12"])
        p20.drop_tip()
    p20.transfer(5, rack["C1"], plate["A12"])
    p20.transfer(5, rack["C1"], plate["B12"])
