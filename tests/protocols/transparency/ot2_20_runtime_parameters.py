from opentrons import protocol_api

metadata = {"protocolName": "parameters"}
requirements = {"robotType": "OT-2", "apiLevel": "2.20"}


def add_parameters(p: protocol_api.ParameterContext):
    p.add_int(variable_name="columns", display_name="columns", default=4, minimum=1, maximum=12)
    p.add_float(variable_name="volume", display_name="volume", default=60.5, minimum=20, maximum=200, unit="µL")
    p.add_bool(variable_name="mix", display_name="mix afterwards", default=True)
    p.add_str(variable_name="pipette", display_name="pipette", default="p300_multi_gen2",
              choices=[{"display_name": "8-channel", "value": "p300_multi_gen2"},
                       {"display_name": "old 8-channel", "value": "p300_multi"}])


def run(ctx: protocol_api.ProtocolContext):
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", "1")
    plate = ctx.load_labware("nest_96_wellplate_200ul_flat", "2")
    water = ctx.load_labware("nest_12_reservoir_15ml", "3")["A1"]
    pip = ctx.load_instrument(ctx.params.pipette, "left", tip_racks=[tips])
    options = {"mix_after": (2, 30)} if ctx.params.mix else {}
    for name, value in ctx.params.get_all().items():
        ctx.comment(f"{name} = {value}")
    pip.transfer(ctx.params.volume, water, plate.rows()[0][: ctx.params.columns], new_tip="always", **options)
