"""Private parts that real protocols reach for: _core, _tip_racks, hw_pipette."""
metadata = {"apiLevel": "2.14"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "2")
    pipette = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    racks = getattr(pipette, "_tip_racks", pipette.tip_racks)
    protocol.comment(str([rack.load_name for rack in racks]))
    pipette.pick_up_tip()
    protocol.comment(f"{pipette.hw_pipette.get('has_tip')} {pipette.hw_pipette.get('working_volume')}")
    core = pipette._core
    protocol.comment(f"{core.get_pipette_name()} {core.get_mount().name} {core is pipette._core}")
    pipette.aspirate(50, plate["A1"])
    protocol.comment(f"{core.get_current_volume()} {pipette.current_volume}")
    pipette.dispense(50, plate["A2"])
    pipette.drop_tip()
