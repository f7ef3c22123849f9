# expect: cell_treatment pass
"""Ensaio de citotoxicidade, 96 poços: excipiente, inibidor, e um grupo sem nada."""

from opentrons import protocol_api

metadata = {"protocolName": "Citotoxicidade do inibidor", "apiLevel": "2.14"}


def run(protocolo: protocol_api.ProtocolContext):
    placa = protocolo.load_labware("corning_96_wellplate_360ul_flat", "1")
    tubos = protocolo.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2")
    ponteiras = protocolo.load_labware("opentrons_96_tiprack_20ul", "3")
    p20 = protocolo.load_instrument("p20_single_gen2", "right", tip_racks=[ponteiras])
    excipiente, inibidor = tubos["A1"], tubos["B1"]
    sem_nada = placa.columns()[1]
    com_excipiente = placa.columns()[2]
    tratados = placa.columns()[3]
    p20.transfer(5, excipiente, com_excipiente, new_tip="always")
    p20.transfer(5, inibidor, tratados, new_tip="always")
    protocolo.comment(f"{len(sem_nada)} ficam como estao")
