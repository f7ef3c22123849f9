# expect: cell_treatment fail CELL-1
"""Dose response on adherent cells."""
metadata = {"protocolName": "Dose response", "author": "x"}
requirements = {"robotType": "OT-2", "apiLevel": "2.18"}


def add_parameters(parameters):
    parameters.add_int(variable_name="dmso_column", display_name="DMSO column", default=11, minimum=1, maximum=12)
    parameters.add_int(variable_name="untreated_column", display_name="Untreated column", default=12, minimum=1, maximum=12)
    parameters.add_int(variable_name="doses", display_name="Doses", default=10, minimum=1, maximum=10)


def run(protocol):
    p = protocol.params
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", s) for s in ("1", "4")]
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", "2", "cells, 50 uL medium per well")
    compounds = protocol.load_labware("nest_12_reservoir_15ml", "3", "compound dilutions, one channel per dose")
    troughs = protocol.load_labware("nest_12_reservoir_15ml", "6", "medium A1, DMSO medium A2")
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=tips)
    for d in range(p.doses):
        m300.pick_up_tip()
        m300.transfer(50, compounds.wells()[d], cells[f"A{d + 1}"], new_tip="never")
        m300.drop_tip()
    m300.transfer(50, troughs["A2"], cells[f"A{p.dmso_column}"])
    m300.transfer(50, compounds["A10"], cells[f"A{p.untreated_column}"])
