from opentrons.protocol_api.labware import OutOfTipsError

metadata = {'apiLevel': '2.12', 'protocolName': 'runs out of tips on purpose'}


def run(ctx):
    rack = ctx.load_labware('opentrons_96_filtertiprack_20ul', 10)
    source = ctx.load_labware('nest_96_wellplate_100ul_pcr_full_skirt', 1)
    target = ctx.load_labware('nest_96_wellplate_100ul_pcr_full_skirt', 2)
    m20 = ctx.load_instrument('p20_multi_gen2', 'left', tip_racks=[rack])
    refills = 0

    def pick_up():
        nonlocal refills
        try:
            m20.pick_up_tip()
        except OutOfTipsError as error:
            refills += 1
            ctx.pause('Replace the 20 uL tips (%s)' % type(error).__name__)
            m20.reset_tipracks()
            m20.pick_up_tip()

    for repeat in range(2):
        for a, b in zip(source.columns(), target.columns()):
            pick_up()
            m20.aspirate(6 + repeat, a[0])
            m20.dispense(6 + repeat, b[0])
            m20.drop_tip()
    assert refills == 1, refills
