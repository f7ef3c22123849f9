"""A thread beside the run, a tip log in a file; it looks at its stack and its broker."""
import inspect
import json
import os
import tempfile
import threading

metadata = {"apiLevel": "2.20"}
requirements = {"robotType": "Flex"}
FOLDER = "/data" if os.path.isdir("/data") and os.access("/data", os.W_OK) else tempfile.gettempdir()


def add_parameters(parameters):
    parameters.add_int("Wells", "wells", default=3, minimum=1, maximum=8)


def caller():
    return inspect.stack()[1].function


def run(protocol):
    tips = protocol.load_labware("opentrons_flex_96_tiprack_50ul", "B2")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "C2")
    protocol.load_trash_bin("A3")
    pipette = protocol.load_instrument("flex_1channel_50", "left", tip_racks=[tips])
    log = os.path.join(FOLDER, "aegis_test_flex_tip_log.json")
    heard, stop, ticks = [], threading.Event(), []
    forget = protocol.broker.subscribe("command", lambda message: heard.append(message["name"]))

    def blink():
        while not stop.wait(0.001):
            ticks.append(1)

    light = threading.Thread(target=blink, daemon=True)
    light.start()
    try:
        pipette.configure_for_volume(3)
        for target in plate.columns()[1][: protocol.params.wells]:
            pipette.transfer(3, plate["A1"], target)
    finally:
        stop.set()
        light.join()
        forget()
    with open(log, "w") as file:
        json.dump({"tips_used": protocol.params.wells}, file)
    with open(log) as file:
        protocol.comment(f"tips used: {json.load(file)['tips_used']}")
    os.remove(log)
    protocol.comment(f"{caller()} {inspect.currentframe().f_code.co_name} {len(heard) > 0}")
    protocol.comment(f"{list(inspect.signature(run).parameters)} {len(protocol.commands()) > 0}")
