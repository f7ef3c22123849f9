"""A shelf of protocols: found, judged once, taken up again, compared with an older table."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Sequence
from pathlib import Path

import pytest

from aegis_ot.errors import ConfigurationError
from aegis_ot.preflight import load_rules
from aegis_ot.workbench import CheckSettings, Project
from aegis_ot.workbench.corpus import check_corpus
from aegis_ot.workbench.corpus_changes import changes
from aegis_ot.workbench.corpus_table import CorpusRow, Results, Told, findings_path, read_results
from aegis_ot.workbench.shelf import Shelved, find_protocols, sample

HEAD = 'metadata = {"apiLevel": "2.15"}\n\n\ndef run(protocol):\n'

SOUND = HEAD + '    protocol.load_labware("nest_12_reservoir_15ml", 1)\n'

OVERFULL = (
    HEAD
    + """    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 1)
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2)
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 5)
    p300 = protocol.load_instrument("p300_single_gen2", "right", [tips])
    p300.transfer(900, tubes["A1"], plate["B1"])
"""
)
OVERFULL_LINE = 9

FIRST_API = "from opentrons import labware, instruments\n\nplate = labware.load('96-flat', '1')\n"

OWN_LABWARE = HEAD + '    protocol.load_labware("our_trough", 1)\n'

WITH_FIELDS = (
    HEAD
    + """    [volume, plate_type, table] = get_values("volume", "plate_type", "table")  # noqa: F821
    assert volume == 900.0
    assert table.splitlines() == ["well,volume", "A1,5"]
    protocol.load_labware(plate_type, 1)
"""
)
FIELDS = [
    {"type": "float", "name": "volume", "default": 900.0},
    {"type": "dropDown", "name": "plate_type", "options": [{"value": "nest_12_reservoir_15ml"}]},
    {"type": "textFile", "name": "table", "default": "well,volume\\nA1,5"},
]

DEFINITION = {
    "ordering": [["A1"]],
    "brand": {"brand": "Ours"},
    "metadata": {
        "displayName": "Our trough",
        "displayCategory": "reservoir",
        "displayVolumeUnits": "mL",
    },
    "dimensions": {"xDimension": 127.8, "yDimension": 85.5, "zDimension": 40},
    "wells": {
        "A1": {
            "depth": 35,
            "totalLiquidVolume": 90000,
            "shape": "rectangular",
            "xDimension": 100,
            "yDimension": 70,
            "x": 63.9,
            "y": 42.7,
            "z": 5,
        }
    },
    "groups": [{"metadata": {}, "wells": ["A1"]}],
    "parameters": {
        "format": "irregular",
        "isTiprack": False,
        "isMagneticModuleCompatible": False,
        "loadName": "our_trough",
    },
    "namespace": "custom_beta",
    "version": 1,
    "schemaVersion": 2,
    "cornerOffsetFromSlot": {"x": 0, "y": 0, "z": 0},
}


def write(path: Path, content: object) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    text = content if isinstance(content, str) else json.dumps(content)
    path.write_text(text, encoding="utf-8")
    return path


@pytest.fixture
def shelf(tmp_path: Path) -> Path:
    folder = tmp_path / "shelf"
    write(folder / "sound.py", SOUND)
    write(folder / "old" / "first.py", FIRST_API)
    write(folder / "old" / "overfull.py", OVERFULL)
    write(folder / "ours" / "trough.py", OWN_LABWARE)
    write(folder / "labware" / "our_trough.json", DEFINITION)
    write(folder / "library" / "fields.json", FIELDS)
    write(folder / "library" / "fields.py", WITH_FIELDS)
    write(folder / "bare" / "no_fields.py", WITH_FIELDS)
    write(folder / "hangs.py", HEAD + "    while True:\n        pass\n")
    write(folder / "plot.py", "def run(data):\n    return data\n")
    write(folder / ".venv" / "hidden.py", SOUND)
    return folder


def projects(protocols: Sequence[Shelved]) -> list[Project]:
    settings = CheckSettings(timeout_s=2.0, definitions=lambda _: ())
    return [Project([one.path for one in protocols], settings, load_rules())]


def judge(folder: Path, table: Path, jobs: int = 1) -> tuple[Results, list[str]]:
    """The results, and the files that were judged anew."""
    anew: list[str] = []

    def done(row: CorpusRow, kept: bool) -> None:
        if not kept:
            anew.append(Path(row.file).name)

    protocols = find_protocols([folder])
    results = check_corpus(protocols, [folder], table, projects(protocols), jobs, done)
    return {Path(file).name: result for file, result in results.items()}, anew


def test_a_shelf_is_judged_once_and_then_only_what_has_changed(shelf: Path, tmp_path: Path) -> None:
    table = tmp_path / "out" / "results.csv"
    results, anew = judge(shelf, table, jobs=2)
    verdicts = {name: row.verdict for name, (row, _) in results.items()}
    assert verdicts == {
        "no_fields.py": "skipped",
        "hangs.py": "error",
        "fields.py": "pass",
        "first.py": "skipped",
        "overfull.py": "fail",
        "trough.py": "pass",
        "sound.py": "pass",
    }
    assert sorted(anew) == sorted(verdicts)
    row, told = results["overfull.py"]
    assert row.rules == "GEN-3:error*1"
    (finding,) = [one for one in told if one.severity == "error"]
    assert (finding.wells, finding.lines) == (("1:B1",), (OVERFULL_LINE,))
    assert row.rehearsal_s > 0 < row.verdict_s
    assert "did not end" in results["hangs.py"][0].reason
    assert results["hangs.py"][0].line in ("5", "6")
    assert "first API" in results["first.py"][0].reason
    assert "no fields.json lies beside it" in results["no_fields.py"][0].reason
    before = read_results(table)
    assert {Path(file).name: result for file, result in before.items()} == results

    write(shelf / "old" / "overfull.py", OVERFULL.replace("900", "90"))
    write(shelf / "labware" / "our_trough.json", {**DEFINITION, "brand": {"brand": "Yours"}})
    (shelf / "hangs.py").unlink()
    results, anew = judge(shelf, table)
    assert sorted(anew) == ["overfull.py", "trough.py"]
    assert "hangs.py" not in results
    assert len(table.read_text().splitlines()) == 1 + len(results)
    assert {file: row for file, (row, _) in read_results(table).items()} == {
        row.file: row for row, _ in results.values()
    }

    (change,) = changes(before, read_results(table))
    assert Path(change.after.file).name == "overfull.py"
    assert (change.before.verdict, change.after.verdict) == ("fail", "pass")
    assert [one.rule for one in change.gone if one.severity == "error"] == ["GEN-3"]


def test_an_interrupted_run_keeps_what_was_done(tmp_path: Path) -> None:
    folder, table = tmp_path / "shelf", tmp_path / "results.csv"
    for name in ("a.py", "b.py", "c.py", "d.py"):  # none is rehearsed, so it takes no time
        write(folder / name, f"{FIRST_API}# {name}\n")
    protocols = find_protocols([folder])
    anew: list[str] = []

    def stop(row: CorpusRow, kept: bool) -> None:
        if row.file.endswith("b.py"):
            raise KeyboardInterrupt

    def note(row: CorpusRow, kept: bool) -> None:
        if not kept:
            anew.append(Path(row.file).name)

    with pytest.raises(KeyboardInterrupt):
        check_corpus(protocols, [folder], table, projects(protocols), done=stop)
    assert [Path(file).name for file in read_results(table)] == ["a.py", "b.py"]
    # The power fails in the middle of a row.
    with table.open("a") as file:
        file.write("x.py,pass,gen")
    with findings_path(table).open("a") as file:
        file.write('{"file": "x.py", "ru')
    check_corpus(protocols, [folder], table, projects(protocols), done=note)
    assert anew == ["c.py", "d.py"]
    assert [Path(file).name for file in read_results(table)] == ["a.py", "b.py", "c.py", "d.py"]


def test_rows_of_other_folders_stay(tmp_path: Path) -> None:
    one, two = (
        write(tmp_path / "one" / "a.py", FIRST_API),
        write(tmp_path / "two" / "b.py", FIRST_API),
    )
    table = tmp_path / "results.csv"
    judge(one.parent, table)
    judge(two.parent, table)
    assert [Path(file).name for file in read_results(table)] == ["a.py", "b.py"]


def test_labware_that_a_designer_protocol_carries_is_found(tmp_path: Path) -> None:
    plain = {**DEFINITION, "namespace": "opentrons", "parameters": {"loadName": "plain"}}
    carried = {"custom_beta/our_trough/1": DEFINITION, "opentrons/plain/1": plain}
    write(tmp_path / "designed.json", {"schemaVersion": 8, "labwareDefinitions": carried})
    write(tmp_path / "odd.json", {"labwareDefinitions": ["loadName", "wells"]})
    write(tmp_path / "protocol.py", OWN_LABWARE + "    # plain\n")
    (found,) = [p for p in find_protocols([tmp_path]) if p.path.suffix == ".py"]
    assert list(found.labware) == ["custom_beta/our_trough/1"]


def test_of_two_definitions_of_one_name_the_nearest_is_taken(tmp_path: Path) -> None:
    far = {**DEFINITION, "brand": {"brand": "Far"}}
    write(tmp_path / "x" / "labware" / "our_trough.json", far)
    write(tmp_path / "lab" / "labware" / "our_trough.json", DEFINITION)
    write(tmp_path / "lab" / "labware" / "other.json", {**DEFINITION, "version": 2, "wells": {}})
    write(tmp_path / "lab" / "labware" / "note.json", ["no definition", "loadName", "wells"])
    write(tmp_path / "lab" / "protocols" / "trough.py", OWN_LABWARE)
    (found,) = find_protocols([tmp_path])
    assert found.labware["custom_beta/our_trough/1"]["brand"] == {"brand": "Ours"}


def test_a_table_of_something_else_is_refused_and_left_alone(tmp_path: Path) -> None:
    table = write(tmp_path / "plates.csv", "well,volume\nA1,5\n")
    write(tmp_path / "shelf" / "first.py", FIRST_API)
    with pytest.raises(ConfigurationError, match="is no table that aegis-ot corpus"):
        judge(tmp_path / "shelf", table)
    assert table.read_text() == "well,volume\nA1,5\n"


def test_a_sample_is_the_same_each_time_even_over_folders_and_without_copies(
    tmp_path: Path,
) -> None:
    for folder, count in (("large", 20), ("small", 2), ("middle", 9)):
        for number in range(count):
            write(tmp_path / folder / f"{number:02}.py", f"{SOUND}# {folder} {number}\n")
    write(tmp_path / "copies" / "copy.py", f"{SOUND}# large 3\n")
    write(tmp_path / "old" / "first.py", FIRST_API)
    protocols = find_protocols([tmp_path])
    drawn = sample(protocols, [tmp_path], 10)
    assert drawn == sample(protocols, [tmp_path], 10)
    folders = [shelved.path.parent.name for shelved in drawn]
    assert folders.count("small") == 2
    assert len({shelved.text for shelved in drawn}) == 10
    assert abs(folders.count("large") - folders.count("middle")) <= 1
    assert len(sample(protocols, [tmp_path], 1000)) == 31


def told(rule: str, severity: str, well: str, line: int, message: str = "Bad.") -> Told:
    return Told("a.py", rule, severity, (well,), (line,), message)


ROW = CorpusRow("a.py", "fail", "pcr", "PCR-2:error*1", 1)


@pytest.mark.parametrize(
    ("after", "finding", "changed"),
    [
        (ROW, told("PCR-2", "error", "1:H12", 7, "Very bad."), False),
        (dataclasses.replace(ROW, rehearsal_s=9.0), told("PCR-2", "error", "1:H12", 7), False),
        (ROW, told("PCR-2", "error", "1:H11", 7), True),
        (ROW, told("PCR-2", "warning", "1:H12", 7), True),
        (ROW, None, False),  # the older run kept no findings
        (dataclasses.replace(ROW, family="generic"), told("PCR-2", "error", "1:H12", 7), True),
    ],
    ids=["words", "time", "well", "severity", "not kept", "family"],
)
def test_a_change_is_of_verdict_family_or_finding_not_of_words_or_time(
    after: CorpusRow, finding: Told | None, changed: bool
) -> None:
    before: Results = {"a.py": (ROW, (told("PCR-2", "error", "1:H12", 7),))}
    now: Results = {"a.py": (after, (finding,) if finding else ())}
    assert bool(list(changes(before, now))) is changed
