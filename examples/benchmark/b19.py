"""Compound screen at a single dose with matched DMSO wells.

Plate map (96 wells, HepG2):
    columns 1-10  compounds, one per well, same position as on the source plate
    column 11     untreated
    column 12     DMSO controls
"""
from opentrons import protocol_api

metadata = {"protocolName": "HepG2 single-dose screen", "author": "Tox", "apiLevel": "2.16"}


def run(protocol: protocol_api.ProtocolContext):
    hepg2 = protocol.load_labware("corning_96_wellplate_360ul_flat", "D2", label="HepG2 cell plate")
    compounds = protocol.load_labware("nest_96_wellplate_200ul_flat", "C2", label="Compound plate 10x")
    dmso_tube = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "C3", label="DMSO")["A1"]
    multi_tips = [protocol.load_labware("opentrons_96_tiprack_20ul", s) for s in ("B1", "B2")]
    single_tips = protocol.load_labware("opentrons_96_tiprack_20ul", "B3")
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=multi_tips)
    p20 = protocol.load_instrument("p20_single_gen2", "right", tip_racks=[single_tips])

    seeded = protocol.define_liquid("HepG2", "in 135 uL medium", "#90ee90")
    for w in hepg2.wells():
        w.load_liquid(seeded, 135)
    dmso_tube.load_liquid(protocol.define_liquid("DMSO 1 %", "vehicle", "#cccccc"), 1000)
    compound = protocol.define_liquid("Compound", "drug, 10x in 1 % DMSO", "#ff9966")
    for w in compounds.wells()[:80]:
        w.load_liquid(compound, 60)

    dmso_controls = hepg2.columns()[11]
    p20.transfer(15, dmso_tube, dmso_controls, new_tip="always")

    for n in range(10):
        m20.transfer(
            15,
            compounds.columns()[n],
            hepg2.columns()[n],
            mix_after=(2, 15),
            new_tip="always",
        )
