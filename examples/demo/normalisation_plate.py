"""Brings 48 dye samples to one volume: red and yellow by worklist, then water.

The dye goes into dry wells, one tip per dye. Water follows from above the wells, so that the
same tip can serve them all without touching dye.
"""

import csv
from io import StringIO

from aegis_ot import guard

metadata = {
    "protocolName": "Normalise 48 wells to 200 uL",
    "author": "aegis_ot examples",
    "apiLevel": "2.16",
}
requirements = {"robotType": "OT-2"}

FINAL_UL = 200

# Columns 1 to 3 take red, columns 4 to 6 yellow; the volume comes from the photometer.
WORKLIST = """well,dye,ul
A1,red,150
B1,red,150
C1,red,150
D1,red,150
E1,red,150
F1,red,150
G1,red,120
H1,red,135
A2,red,160
B2,red,180
C2,red,110
D2,red,145
E2,red,150
F2,red,125
G2,red,140
H2,red,170
A3,red,155
B3,red,130
C3,red,165
D3,red,115
E3,red,175
F3,red,150
G3,red,140
H3,red,160
A4,yellow,150
B4,yellow,145
C4,yellow,135
D4,yellow,160
E4,yellow,120
F4,yellow,110
G4,yellow,180
H4,yellow,150
A5,yellow,165
B5,yellow,155
C5,yellow,125
D5,yellow,140
E5,yellow,130
F5,yellow,170
G5,yellow,115
H5,yellow,150
A6,yellow,175
B6,yellow,160
C6,yellow,145
D6,yellow,120
E6,yellow,150
F6,yellow,135
G6,yellow,110
H6,yellow,140
"""


@guard
def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    reservoir = protocol.load_labware("nest_12_reservoir_15ml", 2, label="Dyes and water")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3, label="Normalised plate")
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[tips])

    red = protocol.define_liquid("red", "food dye, 1:200", "#cc0000")
    yellow = protocol.define_liquid("yellow", "food dye, 1:200", "#ffcc00")
    water = protocol.define_liquid("water", "deionised", "#aaddff")
    sources = {"red": reservoir["A1"], "yellow": reservoir["A2"], "water": reservoir["A12"]}
    for liquid in (red, yellow, water):
        sources[liquid.name].load_liquid(liquid, 8000)

    rows = [
        (plate[row["well"]], row["dye"], float(row["ul"]))
        for row in csv.DictReader(StringIO(WORKLIST))
    ]

    for dye in ("red", "yellow"):
        p300.pick_up_tip()
        for well, wanted, volume in rows:
            if wanted == dye:
                p300.aspirate(volume, sources[dye])
                p300.dispense(volume, well)
        p300.drop_tip()

    p300.pick_up_tip()
    for well, _, volume in rows:
        if FINAL_UL - volume >= 20:
            p300.aspirate(FINAL_UL - volume, sources["water"])
            p300.dispense(FINAL_UL - volume, well.top())
    p300.drop_tip()
