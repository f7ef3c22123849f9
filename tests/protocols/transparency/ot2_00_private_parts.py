"""Reaches into private attributes, as old protocols do."""
metadata = {'apiLevel': '2.0'}


def run(protocol):
    tips = protocol.load_labware('opentrons_96_tiprack_20ul', 1)
    plate = protocol.load_labware('biorad_96_wellplate_200ul_pcr', 2)
    p20 = protocol.load_instrument('p20_single_gen2', 'right', tip_racks=[tips])

    state = p20.hw_pipette
    protocol.comment('%s, working volume %s' % (state['name'], state['working_volume']))
    protocol.comment('core %s' % type(p20._core).__name__)
    core = getattr(p20, '_implementation', p20._core)
    protocol.comment('channels %d' % core.get_channels())
    assert p20.name == 'p20_single_gen2' and p20.mount == 'right' and p20.type == 'single'
    assert protocol.loaded_instruments['right'] is p20

    p20.pick_up_tip()
    assert p20.hw_pipette['has_tip']
    p20.aspirate(12, plate['A1'])
    assert abs(p20._core.get_current_volume() - 12) < 1e-6
    assert abs(p20.current_volume - p20.hw_pipette['current_volume']) < 1e-6
    p20._core.set_flow_rate(aspirate=3.0)
    p20.dispense(12, plate['B1'])
    p20._core.home_plunger()
    p20.blow_out()
    protocol.comment(str(p20))
    protocol.comment(repr(p20.flow_rate.aspirate))
    p20.drop_tip()
