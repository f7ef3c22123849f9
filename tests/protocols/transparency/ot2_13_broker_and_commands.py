"""A protocol that listens at the broker, and reads its own list of commands."""
metadata = {"apiLevel": "2.13"}


def run(protocol):
    heard = []
    unsubscribe = protocol.broker.subscribe(
        "command", lambda message: heard.append((message["$"], message["name"]))
    )
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "2")
    pipette = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    pipette.transfer(50, plate["A1"], plate["A2"])
    unsubscribe()
    names = [name for stage, name in heard if stage == "before"]
    protocol.comment(" ".join(name for name in names if name != "command.COMMENT"))
    commands = [line for line in protocol.commands() if not line.startswith("aegis_ot")]
    protocol.comment(f"{len(commands)} {commands[0]}")
    protocol.clear_commands()
    pipette.transfer(50, plate["B1"], plate["B2"])
    protocol.comment(str(len(protocol.commands()) > 3))
