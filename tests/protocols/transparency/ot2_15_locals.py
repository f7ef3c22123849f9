"""Keeps, changes and walks through the dict of its own local names."""
metadata = {"apiLevel": "2.15"}
import sys
def settings():
    volume = 50
    tips = 3
    found = locals()
    return found
def gen():
    one = 1
    two = 2
    for name in locals():
        yield name
def settings2():
    volume = 10
    ns = locals()
    ns["volume"] = 77
    return ns
def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3)
    p = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[tips])
    s = settings()
    protocol.comment(f"keys {sorted(s)} {sorted(k for k in settings2())} {settings2()['volume']}")
    protocol.comment(f"gen {list(gen())}")
    p.transfer(s["volume"], plate["A1"], plate["B1"])
    def inner():
        frame = sys._getframe()
        return frame.f_code.co_name, frame.f_lineno, frame.f_code.co_firstlineno
    protocol.comment(f"{inner()}")
