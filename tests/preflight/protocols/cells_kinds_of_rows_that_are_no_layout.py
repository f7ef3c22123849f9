# expect: cell_treatment pass
"""Six-well plate, order from the worklist."""
metadata = {'apiLevel': '2.13'}
ROW_KINDS = ("vehicle", "drug")        # what a row of the worklist may say
WORKLIST = "drug:A1,drug:A2,vehicle:A3,drug:B1,drug:B2,vehicle:B3"

def run(protocol):
    tips = [protocol.load_labware('opentrons_96_tiprack_1000ul', '10')]
    plate = protocol.load_labware('corning_6_wellplate_16.8ml_flat', '1', 'cells')
    rack = protocol.load_labware('opentrons_24_tuberack_nest_1.5ml_snapcap', '4', 'tubes')
    p1000 = protocol.load_instrument('p1000_single_gen2', 'left', tip_racks=tips)

    source = {"drug": rack['A1'], "vehicle": rack['A2']}
    for entry in WORKLIST.split(","):
        kind, name = entry.split(":")
        assert kind in ROW_KINDS
        p1000.transfer(200, source[kind], plate[name], new_tip='always')
