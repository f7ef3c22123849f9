"""A CSV runtime parameter, with values of its own where no file was given."""
metadata = {"protocolName": "csv"}
requirements = {"robotType": "OT-2", "apiLevel": "2.20"}


def add_parameters(parameters):
    parameters.add_csv_file(variable_name="picks", display_name="Picks", description="well,volume")
    parameters.add_int(variable_name="wells", display_name="Wells", default=3, minimum=1, maximum=8)


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "2")
    pipette = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    try:
        rows = protocol.params.picks.parse_as_csv()[1:]
    except Exception as error:
        protocol.comment(type(error).__name__)
        rows = [[f"{row}1", 20 + 10 * n] for n, row in enumerate("ABCDEFGH")]
    for name, volume in rows[: protocol.params.wells]:
        pipette.transfer(float(volume), plate[name], plate[name.replace("1", "2")])
