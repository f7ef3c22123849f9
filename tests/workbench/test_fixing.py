"""What ``check --fix`` and an editor's quick fixes write."""

from __future__ import annotations

from pathlib import Path

import pytest

import aegis_ot
from aegis_ot.workbench.mending import Mend, applied, mends_of
from tests.cli.commands import Command
from tests.cli.conftest import aegis as aegis
from tests.cli.test_check_command import protocol

UNNAMED = """\
from opentrons import protocol_api

metadata = {"apiLevel": "2.15", "protocolName": "PCR"}


def run(protocol):
    rack = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2)
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 1)
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", 4)
    p20 = protocol.load_instrument("p20_single_gen2", "left", [tips])
    master_mix, templates = rack["A1"], rack.wells()[8:10]
    for well in plate.wells()[:3]:
        p20.transfer(15, master_mix, well)
    for template, well in zip(templates, plate.wells()):
        p20.transfer(5, template, well)
"""


def mend_of(text: str, kind: str, rule: str) -> Mend:
    (mend,) = [
        m for m in mends_of(text, aegis_ot.check(text)) if (m.kind, m.rules[0]) == (kind, rule)
    ]
    return mend


def test_a_fresh_tip_is_written_only_where_it_is_the_whole_cause(
    aegis: Command, tmp_path: Path
) -> None:
    good = protocol(tmp_path / "one.py", tips="once")
    good.write_bytes(b"\xef\xbb\xbf" + good.read_bytes().replace(b"\n", b"\r\n"))
    # The master mix is drawn with a tip that was in samples: a fresh tip here does not mend that.
    other = (
        protocol(tmp_path / "two.py", tips="never")
        .read_text()
        .replace(
            "        p20.transfer(5, water",
            "        p20.pick_up_tip()\n        p20.transfer(5, water",
        )
    )
    (tmp_path / "two.py").write_text(other)
    before = good.read_bytes()
    result = aegis("check", "one.py", "two.py", "--fix", "--format", "json")
    assert good.read_bytes() == before.replace(b'new_tip="once"', b'new_tip="always"')
    assert (tmp_path / "two.py").read_text() == other
    assert result.err.splitlines()[0].startswith("one.py: mended: Take a fresh tip")
    assert result.code != 0, "the other file stays as it is"
    assert aegis("check", "one.py").code == 0


def test_an_offered_role_and_a_waiver_are_edits_of_the_text() -> None:
    report = aegis_ot.check(UNNAMED)
    assert "PCR-2" in {one.rule for one in report.undecided}
    mend = mend_of(UNNAMED, "role", "PCR-2")
    text = applied(UNNAMED, mend.edits)
    assert "from aegis_ot import guard\n" in text
    assert '@guard(roles={"ntc": ["' in text
    assert "\ndef run(protocol):" in text
    assert "PCR-2" not in {one.rule for one in aegis_ot.check(text).undecided}
    bare = UNNAMED.replace("def run", "from aegis_ot import guard\n\n\n@guard\ndef run")
    assert "@guard(roles={" in applied(bare, mend_of(bare, "role", "PCR-2").edits)
    shared = UNNAMED.replace(
        "p20.transfer(5, template, well)",
        "p20.transfer(5, templates, plate.wells()[:2], new_tip='once')",
    )
    waiver = next(m for m in mends_of(shared, aegis_ot.check(shared)) if m.kind == "waiver")
    waived = applied(shared, waiver.edits)
    assert f"        # aegis: ignore[{waiver.rules[0]}] \n" in waived
    told = [one.message for one in aegis_ot.check(waived).remarks]
    assert any("gives no reason" in one for one in told), "its reason is the author's to write"


def test_a_role_is_written_if_one_well_alone_can_have_it_and_it_brings_no_finding(
    aegis: Command, tmp_path: Path
) -> None:
    water = UNNAMED + "    water = rack['A2']\n    p20.transfer(5, water, plate['C1'])\n"
    texts = {
        "sound.py": water,
        "short.py": UNNAMED,  # what would be its control gets less than the other wells
        "several.py": water.replace("[:3]", "[:5]"),
    }
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
    result = aegis("check", *texts, "--fix")
    assert '@guard(roles={"ntc": ["1:C1"]})\ndef run' in (tmp_path / "sound.py").read_text()
    told = result.err.splitlines()
    assert told[0].startswith("sound.py: mended: Give the guard ntc: 1:C1")
    for name in ("short.py", "several.py"):
        assert (tmp_path / name).read_text() == texts[name]
        assert any(one.startswith(f"{name}: left to you: Give the guard ntc:") for one in told)


@pytest.mark.parametrize(
    ("had", "has"),
    [
        ('@guard(assay="pcr")', '@guard(assay="pcr", roles={"ntc": ['),
        ('@guard(roles={"standard": ["1:H1"]})', '@guard(roles={"ntc": ['),
        ("@guard()", '@guard(roles={"ntc": ['),
    ],
)
def test_a_guard_keeps_what_it_says(had: str, has: str) -> None:
    text = UNNAMED.replace("def run", f"from aegis_ot import guard\n\n\n{had}\ndef run")
    report = aegis_ot.check(UNNAMED)
    mend = next(m for m in mends_of(text, report) if m.rules[0] == "PCR-2")
    assert has in applied(text, mend.edits)
    compile(applied(text, mend.edits), "p.py", "exec")
