# expect: serial_dilution fail SD-4
metadata = {"protocolName": "Endotoxin curve 1:2", "apiLevel": "2.13"}

# the trough as it was filled this morning, 12 mL each
TROUGH_MAP = {
    "LAL water (diluent)": "A3",
    "rinse buffer": "A4",
    "substrate": "A5",
}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", slot) for slot in ("7", "8")]
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=tips)
    trough = protocol.load_labware("nest_12_reservoir_15ml", "1")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "2", "endotoxin series")
    stock = protocol.load_labware("nest_96_wellplate_2ml_deep", "3", "standard 5 EU/mL")["A1"]

    series = plate.rows()[0][:8]
    m300.pick_up_tip()
    for well in series[1:]:
        m300.aspirate(100, trough["A4"])
        m300.dispense(100, well)
    m300.drop_tip()
    m300.transfer(200, stock, series[0])
    for source, target in zip(series, series[1:]):
        m300.transfer(100, source, target, mix_after=(4, 80))
