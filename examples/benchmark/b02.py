from opentrons import protocol_api

metadata = {'protocolName': 'cDNA replicate check, GAPDH', 'apiLevel': '2.16'}
requirements = {'robotType': 'OT-2'}

N_REPLICATES = 7


def run(protocol: protocol_api.ProtocolContext):
    tips20 = protocol.load_labware('opentrons_96_tiprack_20ul', '1')
    tubes = protocol.load_labware('opentrons_24_tuberack_nest_1.5ml_snapcap', '2')
    qpcr = protocol.load_labware('biorad_96_wellplate_200ul_pcr', '3', 'qPCR plate')
    p20 = protocol.load_instrument('p20_single_gen2', 'left', tip_racks=[tips20])

    # tube rack: A1 = SYBR master mix incl. GAPDH primers, A2 = nuclease-free water, B1 = cDNA
    master_mix, water, cdna = tubes['A1'], tubes['A2'], tubes['B1']

    reactions = qpcr.columns_by_name()['1'][:N_REPLICATES]
    ntc = qpcr['H1']

    # 15 uL mix everywhere
    p20.transfer(15, master_mix, reactions + [ntc])

    # water instead of template
    p20.transfer(5, water, ntc, mix_after=(2, 10))

    # cDNA, then homogenise the whole column
    p20.pick_up_tip()
    for well in reactions:
        p20.aspirate(5, cdna)
        p20.dispense(5, well)
    for well in reactions + [ntc]:
        p20.mix(3, 10, well)
        p20.blow_out(well.top(-1))
    p20.drop_tip()
