"""
Tamoxifen on T47D, two replicate plates

both plates:
col 1     untreated
col 2-5   tamoxifen, rising
col 6     ethanol vehicle
"""

metadata = {"protocolName": "Tamoxifen on T47D", "apiLevel": "2.13"}


def run(protocol):
    plates = [
        protocol.load_labware("corning_96_wellplate_360ul_flat", slot, f"T47D replicate {n}")
        for n, slot in enumerate(("2", "5"), 1)
    ]
    doses = protocol.load_labware("nest_96_wellplate_2ml_deep", "3", "tamoxifen dilutions")
    tips = [protocol.load_labware("opentrons_96_filtertiprack_20ul", s) for s in ("7", "8")]
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=tips)
    etoh = doses["A12"]
    for plate in plates:
        for source, column in zip(doses.rows()[0][:4], plate.columns()[1:5]):
            m20.transfer(20, source, column[0], mix_after=(2, 15), new_tip="always")
    m20.transfer(20, etoh, plates[0]["A6"], mix_after=(2, 15), new_tip="always")
