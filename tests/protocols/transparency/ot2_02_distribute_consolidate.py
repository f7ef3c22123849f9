metadata = {'apiLevel': '2.2'}


def run(protocol_context):
    tips = protocol_context.load_labware('opentrons_96_tiprack_300ul', '1')
    plate = protocol_context.load_labware('corning_24_wellplate_3.4ml_flat', '2')
    rack = protocol_context.load_labware('opentrons_15_tuberack_falcon_15ml_conical', '3')
    pip = protocol_context.load_instrument('p300_single', 'right', tip_racks=[tips])

    pip.distribute(45, rack['A1'], plate.rows()[0])
    pip.distribute(45, rack['A1'], plate.rows()[1], disposal_volume=0, air_gap=10)
    pip.distribute([20, 30, 40, 50, 60, 70], rack['A2'], plate.rows()[2], touch_tip=True, new_tip='always')
    pip.distribute([20, 30, 40, 50, 60, 70], rack['A2'], [w.top(-2) for w in plate.rows()[3]], mix_before=(1, 100), blow_out=True)
    pip.consolidate(40, plate.rows()[0], rack['B1'])
    pip.consolidate([20, 40, 60, 80], plate.columns()[0], rack['B2'], air_gap=5, mix_after=(2, 150))
    pip.consolidate(30, plate.rows()[1], rack['B3'], blow_out=True, touch_tip=True, trash=False)
    pip.pick_up_tip()
    pip.consolidate(100, plate.columns()[2], rack['B4'], new_tip='never', mix_before=(2, 50))
    pip.return_tip()
