metadata = {
    'protocolName': 'Cherrypicking',
    'author': 'automation group',
    'source': 'in-house',
    'apiLevel': '2.3',
}

TRANSFER_CSV = """Source Labware,Source Slot,Source Well,Source Aspiration Height Above Bottom (mm),Dest Labware,Dest Slot,Dest Well,Volume (ul)
biorad_96_wellplate_200ul_pcr,1,A1,1,nest_96_wellplate_200ul_flat,3,A11,2
biorad_96_wellplate_200ul_pcr,1,A2,1,nest_96_wellplate_200ul_flat,3,B11,5
biorad_96_wellplate_200ul_pcr,1,A3,1.5,nest_96_wellplate_200ul_flat,3,C11,4
biorad_96_wellplate_200ul_pcr,2,H6,1,nest_96_wellplate_200ul_flat,3,D11,9

biorad_96_wellplate_200ul_pcr,2,E9,1,nest_96_wellplate_200ul_flat,3,E11,10
biorad_96_wellplate_200ul_pcr,2,C1,2,nest_96_wellplate_200ul_flat,5,A1,12.5
"""


def run(ctx):
    tip_slots = ['4', '6']
    tip_type, pipette_type, mount = 'opentrons_96_filtertiprack_20ul', 'p20_single_gen2', 'right'
    transfer_info = [
        [val.strip().lower() for val in line.split(',')]
        for line in TRANSFER_CSV.splitlines()
        if line.split(',')[0].strip()
    ][1:]

    for line in transfer_info:
        for lw, slot in ((line[0], line[1]), (line[4], line[5])):
            if not int(slot) in ctx.loaded_labwares:
                ctx.load_labware(lw, slot)

    tipracks = [ctx.load_labware(tip_type, slot) for slot in tip_slots]
    pip = ctx.load_instrument(pipette_type, mount, tip_racks=tipracks)

    def parse_well(well):
        letter, number = well[0], well[1:]
        return letter.upper() + str(int(number))

    for line in transfer_info:
        _, s_slot, s_well, h, _, d_slot, d_well, vol = line
        source = ctx.loaded_labwares[int(s_slot)].wells_by_name()[parse_well(s_well)].bottom(float(h))
        dest = ctx.loaded_labwares[int(d_slot)].wells_by_name()[parse_well(d_well)]
        pip.pick_up_tip()
        pip.transfer(float(vol), source, dest, new_tip='never')
        pip.blow_out(dest.top(-2))
        pip.drop_tip()
