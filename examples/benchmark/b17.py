"""Cherry-pick sequence-verified clones into a fresh deep-well plate."""
import csv
import io

from opentrons import protocol_api

metadata = {"protocolName": "Clone re-array", "author": "Strain engineering", "apiLevel": "2.14"}

REARRAY_CSV = """\
plate,from,to,volume_ul
P1,B3,A1,40
P1,B9,B1,40
P1,D11,C1,40
P1,G2,D1,40
P2,A6,E1,40
P2,C1,F1,40
P2,C2,G1,40
P2,E12,H1,40
P2,H7,A2,40
P3,A1,B2,40
P3,F5,C2,40
"""


def parse(text):
    return [
        (r["plate"], r["from"], r["to"], float(r["volume_ul"]))
        for r in csv.DictReader(io.StringIO(text))
    ]


def run(ctx: protocol_api.ProtocolContext):
    glycerols = {
        name: ctx.load_labware("nest_96_wellplate_2ml_deep", slot, label=f"Glycerol stocks {name}")
        for name, slot in (("P1", 1), ("P2", 4), ("P3", 7))
    }
    target = ctx.load_labware("nest_96_wellplate_2ml_deep", 2, label="Re-array plate")
    lb = ctx.load_labware("nest_1_reservoir_195ml", 3, label="LB medium")
    small = ctx.load_labware("opentrons_96_filtertiprack_200ul", 5)
    large = ctx.load_labware("opentrons_96_filtertiprack_1000ul", 6)
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[small])
    p1000 = ctx.load_instrument("p1000_single_gen2", "right", tip_racks=[large])

    picks = parse(REARRAY_CSV)

    # medium into the empty target plate, same tip
    p1000.distribute(
        400, lb["A1"], [target[to] for _, _, to, _ in picks], disposal_volume=100, new_tip="once"
    )

    for plate, src, to, volume in picks:
        p300.transfer(
            volume,
            glycerols[plate][src],
            target[to],
            mix_before=(2, 50),
            mix_after=(2, 100),
            new_tip="always",
        )
