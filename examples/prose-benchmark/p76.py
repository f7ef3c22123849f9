metadata = {"protocolName": "Sirius Red viability after siRNA", "apiLevel": "2.13"}

LAYOUT = """
| to  | from | content   |
| B02 | A6   | untreated |
| B03 | A1   | vehicle   |
| C03 | A1   | vehicle   |
| D03 | A1   | vehicle   |
| B04 | A2   | inhibitor |
| C04 | A2   | inhibitor |
| D04 | A2   | inhibitor |
"""


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 1)
    vials = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 4)
    cells = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "stellate cells")
    p20 = ctx.load_instrument("p20_single_gen2", "right", tip_racks=[tips])
    for line in LAYOUT.strip().splitlines()[1:]:
        to, start, content = [cell.strip() for cell in line.strip("|").split("|")]
        well = f"{to[0]}{int(to[1:])}"
        if content != "untreated":
            p20.transfer(10, vials[start], cells[well], new_tip="always")
