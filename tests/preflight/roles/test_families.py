"""Which assay a protocol is taken for: a word that many assays use decides nothing alone."""

from __future__ import annotations

from pathlib import Path

import pytest

from aegis_ot.preflight import Database, Script, check_script, load_database

PROTOCOL = """
metadata = {{"protocolName": "{title}", "apiLevel": "2.13"}}

def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", 1)
    one = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 2, "{label}")
    other = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 3)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    p20.transfer(5, one["A1"], other["A1"])
"""


@pytest.fixture(scope="module")
def database() -> Database:
    return load_database()


@pytest.mark.parametrize(
    ("title", "label", "family"),
    [
        ("Dose plates", "compounds in DMSO", "generic"),
        ("Move amplicons", "PCR plate", "generic"),
        ("Primer aliquots", "primer stocks", "generic"),
        ("Clear cell lysates", "lysates", "generic"),
        ("Blocking with BSA", "buffer", "generic"),
        ("Dilute 1:10", "stock", "generic"),
        ("qPCR", "cDNA", "pcr"),
        ("Dose response of HeLa cells", "vehicle and drug", "cell_treatment"),
        ("Bradford assay", "lysates", "bradford"),
    ],
)
def test_the_family_is_what_defines_it(title, label, family, database: Database) -> None:
    report = check_script(Script(PROTOCOL.format(title=title, label=label), "p.py"), database)
    assert report.family == family


def test_the_makers_name_of_a_plate_is_no_evidence(database: Database) -> None:
    report = check_script(Script(PROTOCOL.format(title="", label=""), "p.py"), database)
    assert all(not one.score for one in report.families if one.family == "pcr")


def test_roles_that_a_text_places_make_a_pcr_of_master_mix(database: Database) -> None:
    """No word says "PCR"; but extracts and an NTC stand where master mix goes."""
    text = (Path(__file__).parent.parent / "protocols" / "pcr_drawn_codes_good.py").read_text()
    report = check_script(Script(text.partition("\n")[2], "p.py"), database)
    assert report.family == "pcr"
