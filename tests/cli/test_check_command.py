from __future__ import annotations

import json
import textwrap
from pathlib import Path

import pytest

from aegis_ot.reports import FORMATS

from .commands import Command

DECK = """
    metadata = {{"apiLevel": "2.15", "protocolName": "qPCR set-up"}}
    {top}

    def run(protocol):
        print("this is the protocol's own output")
        tubes = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2)
        plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 1, "qPCR plate")
        tips = protocol.load_labware("opentrons_96_tiprack_20ul", 4)
        p20 = protocol.load_instrument("p20_single_gen2", "left", [tips])
        master_mix, water, templates = tubes["A1"], tubes["A2"], tubes.wells()[8:10]
        reactions, ntc = plate.wells()[:2], plate["H12"]
        p20.transfer(15, master_mix, reactions + [ntc], new_tip="always")
        p20.transfer(5, water, ntc)
        p20.transfer(5, templates, reactions, new_tip="{tips}"){beside}
"""


def protocol(path: Path, tips: str = "always", beside: str = "", top: str = "") -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    text = textwrap.dedent(DECK).format(tips=tips, beside=beside, top=top)
    path.write_text(text.lstrip(), encoding="utf-8")
    return path


BAD_LINE = 14


def test_every_verdict_at_once(aegis: Command, tmp_path: Path) -> None:
    """One call over a good, a bad, a waived, a stale and a broken protocol."""
    protocol(tmp_path / "good.py")
    protocol(tmp_path / "bad.py", tips="once")
    protocol(tmp_path / "waived.py", tips="once", beside="  # aegis: ignore[PCR-3] one donor")
    protocol(tmp_path / "stale.py", top="# aegis: ignore[PCR-5] long gone")
    (tmp_path / "broken.py").write_text("def run(p:\n", encoding="utf-8")
    names = ["good.py", "bad.py", "waived.py", "stale.py", "broken.py", "missing.py"]
    result = aegis("check", *names, "--format", "json")
    assert result.code == 2
    assert result.err == ""
    found = {entry["file"]: entry for entry in json.loads(result.out)["protocols"]}
    assert [found[name]["verdict"] for name in names] == [
        "pass", "fail", "pass", "pass", "error", "error",
    ]  # fmt: skip
    (finding,) = found["bad.py"]["findings"]
    assert finding["rule"] == "PCR-3"
    assert finding["lines"] == [BAD_LINE]
    assert {"2:A3", "2:B3", "1:B1"} <= set(finding["wells"])
    assert found["bad.py"]["family"] == "pcr"
    assert found["waived.py"]["waived"][0]["reason"] == "one donor"
    (remark,) = found["stale.py"]["remarks"]
    assert remark["line"] == 2
    assert "PCR-5 is stale" in remark["message"]
    assert found["broken.py"]["error"]["line"] == 1


def test_text_names_rule_place_and_roles_and_a_baseline_silences(
    aegis: Command, tmp_path: Path
) -> None:
    protocol(tmp_path / "p" / "bad.py", tips="once")
    (tmp_path / "p" / "broken.py").write_text("def run(p:\n", encoding="utf-8")
    first = aegis("check", "p/bad.py", "--explain-roles", "--write-baseline", "known.json")
    told = "known.json: 1 finding is known from now on."
    assert (first.code, first.out, first.err) == (0, "", told + "\n")
    second = aegis("check", "p/bad.py", "p/broken.py", "--write-baseline", "known.json")
    assert (second.code, second.out) == (2, "")
    assert second.err.splitlines()[:2] == [
        told,
        "p/broken.py:1: error: cannot be judged: not valid Python: '(' was never closed",
    ]
    shown = aegis("check", "p/bad.py", "--explain-roles")
    assert shown.code == 1
    assert f"--> p/bad.py:{BAD_LINE}" in shown.out
    assert "PCR-3" in shown.out
    assert "1:H12: ntc: name `ntc` at line 11" in shown.out
    assert "\x1b[" not in shown.out
    assert "protocol's own output" not in shown.out
    silenced = aegis("check", "p/bad.py", "--baseline", "known.json", "--output", "out/report.txt")
    assert silenced.code == 0
    assert silenced.out == ""
    assert "1 known finding" in (tmp_path / "out" / "report.txt").read_text(encoding="utf-8")


def test_the_configuration_sets_severity_and_waives(aegis: Command, tmp_path: Path) -> None:
    pytest.importorskip("tomllib")
    protocol(tmp_path / "bad.py", tips="once")
    config = tmp_path / "pyproject.toml"
    config.write_text(
        '[tool.aegis-ot]\nassay = "pcr"\n[tool.aegis-ot.severity]\nPCR-3 = "warning"\n',
        encoding="utf-8",
    )
    (entry,) = json.loads(aegis("check", "bad.py", "-f", "json").out)["protocols"]
    assert entry["verdict"] == "warn"
    assert entry["findings"][0]["severity"] == "warning"
    config.write_text(
        '[[tool.aegis-ot.waivers]]\nrules = ["PCR-3"]\nfiles = ["bad.py"]\nreason = "known"\n',
        encoding="utf-8",
    )
    result = aegis("check", "bad.py", "--select", "pcr-3,PCR-1")
    assert (result.code, "PCR-3 waived: known" in result.out) == (0, True)


def test_a_wrong_name_in_the_configuration_is_told_with_its_place(
    aegis: Command, tmp_path: Path
) -> None:
    pytest.importorskip("tomllib")
    protocol(tmp_path / "good.py")
    config = tmp_path / "pyproject.toml"
    for line, words in [
        ('ignore = ["PCR-33"]', "tool.aegis-ot.ignore: there is no rule 'PCR-33'; did you mean"),
        ('select = ["SD-9"]', "tool.aegis-ot.select: there is no rule 'SD-9'"),
        ('assay = "qpcr"', "tool.aegis-ot.assay: there is no assay family 'qpcr'"),
    ]:
        config.write_text(f"[tool.aegis-ot]\n{line}\n", encoding="utf-8")
        result = aegis("check", "good.py")
        assert (result.code, result.out) == (2, "")
        assert result.err.startswith(f"aegis-ot: pyproject.toml: {words}")


def test_a_guard_that_leaves_no_rule_is_told(aegis: Command, tmp_path: Path) -> None:
    top = "from aegis_ot import guard\n@guard(ignore='PCR-1, PCR-2')"
    protocol(tmp_path / "good.py", top=top)
    assert aegis("check", "good.py").code == 0
    result = aegis("check", "good.py", "--select", "PCR-1")
    assert (result.code, "no rule is left to judge it by" in result.out) == (2, True)


def test_each_protocol_is_judged_as_its_own_project_says(aegis: Command, tmp_path: Path) -> None:
    pytest.importorskip("tomllib")
    for name, table in (
        ("strict", ""),
        ("lenient", 'ignore = ["PCR-3"]\nrules = ["luciferase.json"]\n'),
    ):
        protocol(tmp_path / name / "bad.py", tips="once")
        config = tmp_path / name / "pyproject.toml"
        config.write_text(f"[tool.aegis-ot]\n{table}", encoding="utf-8")
    (tmp_path / "lenient" / "luciferase.json").write_bytes(SIXTH.read_bytes())
    (tmp_path / "lenient" / "plate.py").write_text(PLATE, encoding="utf-8")
    files = ("lenient/plate.py", "strict/bad.py", "lenient/bad.py")
    result = aegis("check", *files, "-f", "json")
    found = json.loads(result.out)["protocols"]
    assert [entry["file"] for entry in found] == list(files)
    rules = [[finding["rule"] for finding in entry["findings"]] for entry in found]
    assert rules == [["LUC-2"], ["PCR-3"], []]
    assert "LUC-2 fresh-tip-per-sample" in aegis("check", *files).out
    config.write_text('[tool.aegis-ot]\nignore = ["PCR-33"]\n', encoding="utf-8")
    refused = aegis("check", *files)
    assert refused.err.startswith(
        "aegis-ot: lenient/pyproject.toml: tool.aegis-ot.ignore: there is"
    )


SIXTH = Path(__file__).parents[2] / "examples" / "rules" / "luciferase.json"
PLATE = """
metadata = {"apiLevel": "2.15", "protocolName": "Luciferase reporter assay"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    luciferase_plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 2)
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    p300 = protocol.load_instrument("p300_single_gen2", "left", [tips])
    cell_samples = tubes.rows()[0][:3]
    p300.transfer(50, cell_samples, luciferase_plate.columns()[0][:3], new_tip="once")
"""


def test_a_family_of_ones_own_is_a_file(aegis: Command, tmp_path: Path) -> None:
    (tmp_path / "plate.py").write_text(PLATE, encoding="utf-8")
    result = aegis("check", "plate.py", "--rules", SIXTH, "-f", "json")
    (entry,) = json.loads(result.out)["protocols"]
    assert (result.code, entry["family"]) == (1, "luciferase")
    assert [finding["rule"] for finding in entry["findings"]] == ["LUC-2"]
    assert {undecided["rule"] for undecided in entry["undecided"]} == {"LUC-1", "LUC-3"}
    assert "LUC-2" in aegis("explain", "luc-2", "--rules", SIXTH).out


WRONG: list[tuple[list[str], str]] = [
    (["check"], "Name protocols, folders, or a run"),
    (["check", "good.py", "--format", "xml"], "'xml' is not one of github, html, json"),
    (["check", "good.py", "--timeout", "soon"], "--timeout"),
    (["check", "good.py", "--timeout", "0"], "greater than 0"),
    (["check", "good.py", "--timeout", "nan"], "greater than 0"),
    (["check", "good.py", "--select", "PCR-22"], "did you mean PCR-2"),
    (["check", "good.py", "--ignore", "XYZ"], "there is no rule 'XYZ'"),
    (["check", "good.py", "--assay", "qpcr"], "there is no assay family 'qpcr'; did you mean pcr"),
    (["check", "good.py", "--assay", ""], "--assay: names nothing"),
    (["check", "good.py", "--select", " , "], "--select: names nothing"),
    (["check", "good.py", "--select", "PCR-1", "--ignore", "pcr-1"], "No rule is left to judge by"),
    (["check", "good.py", "--parameter", "5"], "write it as NAME=VALUE"),
    (["check", "good.py", "--parameter", "a=1", "--parameter", "a=2"], "given twice"),
    (["check", "good.py", "--csv", "plate=none.csv"], "there is no file none.csv"),
    (["check", "good.py", "--labware", "nowhere"], "--labware nowhere"),
    (["check", "good.py", "--labware", "notes.json"], "no Opentrons labware definition"),
    (["check", "good.py", "--rules", "nowhere"], "no such file or folder of rules"),
    (["check", "good.py", "--rules", "notes.json"], "notes.json"),
    (["check", "good.py", "--baseline", "nowhere.json"], "--write-baseline"),
    (["check", "good.py", "--baseline", "notes.json"], "no baseline file"),
    (["check", "good.py", "--baseline", "a", "--write-baseline", "b"], "together"),
    (["check", "good.py", "--output", "a", "--write-baseline", "b"], "together"),
    (["check", "good.py", "--no-such-option"], "No such option"),
    (["chekc", "good.py"], "No such command"),
    (["explain", "PCR-22"], "did you mean PCR-2"),
    (["rules", "test", "nowhere"], "no such file or folder of rules"),
    (["rules", "list", "--format", "xml"], "'xml' is not one of text, json"),
    (["evaluate", "layer1", "nowhere"], "there is no such folder"),
    (["evaluate", "layer1", "."], "holds no labels.json"),
    (["evaluate", "layer1", ".", "--config", "magic"], "'magic' is not one of"),
    (["evaluate", "layer1", ".", "--seed", "-1"], "-1 is not in the range"),
]


@pytest.mark.parametrize(("arguments", "words"), WRONG, ids=[" ".join(a) for a, _ in WRONG])
def test_a_wrong_call_is_one_line_and_code_2(
    aegis: Command, tmp_path: Path, arguments: list[str], words: str
) -> None:
    protocol(tmp_path / "good.py")
    (tmp_path / "notes.json").write_text("{}", encoding="utf-8")
    result = aegis(*arguments)
    assert result.code == 2
    assert result.out == ""
    assert words in result.err
    assert len(result.err.splitlines()) == 1


@pytest.mark.parametrize("option", ["--output", "--write-baseline"])
@pytest.mark.parametrize("written", ["good.py", "sub/../good.py", "table.csv"])
def test_nothing_that_the_call_reads_is_written_over(
    aegis: Command, tmp_path: Path, option: str, written: str
) -> None:
    (tmp_path / "sub").mkdir()
    (tmp_path / "table.csv").write_text("a,b", encoding="utf-8")
    text = protocol(tmp_path / "good.py").read_text(encoding="utf-8")
    result = aegis("check", "good.py", "--csv", "table=table.csv", option, written)
    told = f"aegis-ot: {option} {Path(written)}: the call reads this file"
    assert (result.code, result.out) == (2, "")
    assert result.err.startswith(told)
    assert (tmp_path / "good.py").read_text(encoding="utf-8") == text
    exported = aegis("llm", "export", "good.py", "--out", "good.py")
    assert (exported.code, "would be overwritten" in exported.err) == (2, True)


def test_roles_that_somebody_completes_are_not_written_over(aegis: Command, tmp_path: Path) -> None:
    protocol(tmp_path / "good.py")
    assert aegis("check", "good.py", "--roles-template", "roles.txt").code == 0
    (tmp_path / "roles.txt").write_text("completed", encoding="utf-8")
    again = aegis("check", "good.py", "--roles-template", "roles.txt")
    assert (again.code, again.out) == (2, "")
    assert "may have been completed: give another name" in again.err
    assert (tmp_path / "roles.txt").read_text(encoding="utf-8") == "completed"


@pytest.mark.parametrize("name", FORMATS)
def test_a_format_without_roles_says_so_where_they_are_asked_for(
    aegis: Command, tmp_path: Path, name: str
) -> None:
    protocol(tmp_path / "good.py")
    result = aegis("check", "good.py", "--explain-roles", "--format", name)
    shown = "name `ntc` at line" in result.out
    assert result.code == 0
    assert shown == ("--explain-roles" not in result.err)
    assert ("text, json, html show them" in result.err) != shown


UNREADABLE: list[tuple[str, bytes | None, str]] = [
    ("missing.py", None, "there is no such file"),
    ("empty.py", b" \n", "is empty"),
    ("binary.py", b"\x7fELF\x02\xff\xfe", "is a binary file"),
    ("nul.py", b"def run(p):\n\0", "is a binary file"),
    ("protocol.json", b"{}", "neither of Protocol Designer nor an analysis"),
    ("bundle.zip", b"PK", "is a bundle"),
]


@pytest.mark.parametrize(("name", "data", "words"), UNREADABLE)
def test_what_is_no_protocol_is_told_in_one_line(
    aegis: Command, tmp_path: Path, name: str, data: bytes | None, words: str
) -> None:
    (tmp_path / "folder").mkdir()
    if data is not None:
        (tmp_path / name).write_bytes(data)
    result = aegis("check", name)
    assert result.code == 2
    assert result.out.splitlines()[0].startswith(f"{name}: error: cannot be judged: ")
    assert words in result.out.splitlines()[0]


def test_a_protocol_that_moves_no_liquid_is_told(aegis: Command, tmp_path: Path) -> None:
    (tmp_path / "idle.py").write_text(
        'metadata = {"apiLevel": "2.15"}\n'
        "def run(protocol):\n"
        '    protocol.load_labware("opentrons_96_tiprack_300ul", "1")\n'
    )
    result = aegis("check", "idle.py")
    assert "It moves no liquid: there is nothing to judge." in result.out
    assert "undecided" not in result.out
    assert result.code == 0
