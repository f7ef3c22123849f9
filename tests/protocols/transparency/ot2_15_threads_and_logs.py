"""A thread of the protocol's own beside the run, and a tip log kept in a file."""
import json
import os
import tempfile
import threading

metadata = {"apiLevel": "2.15"}
FOLDER = "/data" if os.path.isdir("/data") and os.access("/data", os.W_OK) else tempfile.gettempdir()


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "2")
    pipette = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    log = os.path.join(FOLDER, "aegis_test_tip_log.json")
    used = 0
    if os.path.exists(log) and not protocol.is_simulating():
        with open(log) as file:
            used = json.load(file)["tips_used"]
    pipette.starting_tip = tips.wells()[used]
    stop, ticks = threading.Event(), []

    def blink():
        while not stop.wait(0.001):
            ticks.append(1)

    light = threading.Thread(target=blink, daemon=True)
    light.start()
    try:
        for target in ("A2", "B2"):
            pipette.transfer(50, plate["A1"], plate[target])
            used += 1
    finally:
        stop.set()
        light.join()
    if not protocol.is_simulating():
        with open(log, "w") as file:
            json.dump({"tips_used": used}, file)
    protocol.comment(f"tips used: {used}")
