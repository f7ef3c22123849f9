# raises: KeyError
"""Its run is a partial; an error crosses a helper with a finally."""
import functools, traceback
metadata = {"apiLevel": "2.14"}
def helper(p, a, b):
    try:
        p.transfer(20, a, b)
        raise ValueError("from helper")
    finally:
        p.comment_count = getattr(p, "comment_count", 0) + 1
def _run(volume, protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3)
    p = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[tips])
    for i in range(2):
        try:
            helper(p, plate["A1"], plate.wells()[i + 1])
        except ValueError:
            lines = [f.lineno for f in traceback.extract_tb(__import__("sys").exc_info()[2])]
            protocol.comment(f"lines {lines}")
    protocol.comment(str(p.comment_count))
    p.transfer(volume, plate["A1"], plate["H12"])
    plate["Z99"]
def run(protocol):
    pass
run = functools.partial(_run, 30)
