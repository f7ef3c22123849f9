# expect: cell_treatment pass
metadata = {"protocolName": "Ribavirin on A549, two plates", "apiLevel": "2.13"}

# V = vehicle control, U = untreated control, N1 / N2 = ribavirin 5 / 50 uM
PLATE = """
,1,2,3,4
A,V,N1,N2,U
B,V,N1,N2,U
C,V,N1,N2,U
"""
TUBES = {"V": "A1", "N1": "B1", "N2": "B2"}


def wells_by_code():
    head, *rows = [line.split(",") for line in PLATE.strip().splitlines()]
    found = {}
    for row in rows:
        for column, code in zip(head[1:], row[1:]):
            found.setdefault(code, []).append(row[0] + column)
    return found


def run(protocol):
    tips = protocol.load_labware("opentrons_96_filtertiprack_200ul", "1")
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "4", "solutions")
    plates = [
        protocol.load_labware("corning_96_wellplate_360ul_flat", slot, f"A549 plate {slot}")
        for slot in ("2", "3")
    ]
    wells = wells_by_code()
    # V first, then the drug
    for code, tube in TUBES.items():
        for plate in plates:
            p300.pick_up_tip()
            for name in wells[code]:
                p300.aspirate(40, rack[tube])
                p300.dispense(40, plate[name].bottom(3))
            p300.drop_tip()
