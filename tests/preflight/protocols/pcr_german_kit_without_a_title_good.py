# expect: pcr pass
"""Erregernachweis aus Nasentupfern."""

from opentrons import protocol_api

metadata = {"protocolName": "Nachweis RSV", "apiLevel": "2.14"}

PLATZ = {"Tupfer 1": "A1", "Tupfer 2": "B1", "Tupfer 3": "C1", "Leerkontrolle": "D1"}


def run(protocol: protocol_api.ProtocolContext):
    spitzen = protocol.load_labware("opentrons_96_filtertiprack_20ul", "1")
    staender = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2")
    platte = protocol.load_labware("biorad_96_wellplate_200ul_pcr", "3")
    p20 = protocol.load_instrument("p20_single_gen2", "right", tip_racks=[spitzen])
    # Mastermix samt Primern in alle
    p20.transfer(15, staender["D6"], [platte[platz] for platz in PLATZ.values()])
    # je 5 ul, Leerkontrolle: Wasser
    for was, platz in PLATZ.items():
        p20.transfer(5, staender[platz], platte[platz])
