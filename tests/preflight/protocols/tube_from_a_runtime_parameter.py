# expect: cell_treatment pass
metadata = {"protocolName": "Staurosporine on HeLa", "apiLevel": "2.18"}


def add_parameters(parameters):
    parameters.add_str(
        variable_name="vehicle_well",
        display_name="Tube of vehicle",
        default="B2",
        choices=[{"display_name": "B2", "value": "B2"}, {"display_name": "C2", "value": "C2"}],
    )


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", "1")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", "2", "HeLa cells")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "3", "staurosporine tubes")
    untreated = cells["D6"]
    vehicle_control = cells["C6"]
    doses = [rack[name] for name in ("A1", "A2", "A3", "A4")]
    treated = [cells[name] for name in ("B2", "B3", "B4", "B5")]
    p20.transfer(10, rack[protocol.params.vehicle_well], vehicle_control)
    for dose, well in zip(doses, treated):
        p20.transfer(10, dose, well, new_tip="always")
    protocol.comment(f"{untreated} stays as it is")
