"""A protocol is judged where it lies: its folder, the modules and the labware of its repository."""

from __future__ import annotations

from pathlib import Path

import pytest

from aegis_ot.errors import ConfigurationError
from aegis_ot.preflight import load_rules
from aegis_ot.workbench import CheckedProtocol, CheckSettings, check_files
from aegis_ot.workbench.files import read_labware
from aegis_ot.workbench.shelf import protocols_named
from aegis_ot.workbench.surroundings import data_named, root_of, surroundings_of

from .test_corpus import DEFINITION, HEAD, OWN_LABWARE, write

MOVES = """    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 1)
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 5)
    p300 = protocol.load_instrument("p300_single_gen2", "right", [tips])
    p300.transfer(50, plate["A1"], plate[WELL], new_tip="always")
"""


def build(repo: Path) -> None:
    """A checkout with helpers beside its protocols, above them, at its root and elsewhere."""
    protocols = repo / "lab" / "protocols"
    write(repo / "shared" / "__init__.py", "")
    write(repo / "shared" / "wells.py", "from .deep import WELL\n")
    write(repo / "shared" / "deep.py", 'WELL = "B1"\n')
    write(repo / "lib" / "far.py", "WELL = 'B1'\n")
    write(repo / "lab" / "above.py", "import shared.wells\nWELL = shared.wells.WELL\n")
    write(repo / "labware" / "trough.json", DEFINITION)
    write(repo / "labware" / "note.json", {"parameters": {"loadName": "our_trough"}})
    write(repo / "data" / "well.txt", "B1")
    write(repo / "data" / "twice.csv", "1")
    write(repo / "lib" / "twice.csv", "2")
    write(repo.parent / "stranger.py", "WELL = 'B1'\n")
    write(protocols / "beside.py", "from above import WELL\n")
    write(protocols / "json.py", "raise RuntimeError('not the library')\n")
    write(protocols / "decks.py", 'TROUGH = "our_trough"\n')
    write(protocols / "volumes.csv", "50\n")
    opens = "    open('volumes.csv').close()\n"
    trough = OWN_LABWARE.replace('"our_trough"', "TROUGH")
    for name, text in {
        "helped": "import json\nfrom beside import WELL\n" + HEAD + MOVES + opens,
        "older": "from opentrons.commands.commands import drop_tip\n" + HEAD + MOVES,
        "strange": "from stranger import WELL\n" + HEAD + MOVES,
        "far_off": "from far import WELL\n" + HEAD + MOVES,
        "trough": "from decks import TROUGH\n" + trough,
        "nowhere": OWN_LABWARE.replace("our_trough", "no_trough"),
        "nowhere_2_13": OWN_LABWARE.replace("our_trough", "no_trough").replace("2.15", "2.13"),
        "no_file": HEAD + '    open("missing.csv")\n',
        "elsewhere": HEAD + MOVES.replace("[WELL]", '[open("/Users/x/far/well.txt").read()]'),
        "windows": HEAD + '    open(r"C:\\lab\\well.txt")\n' + MOVES.replace("WELL", '"B1"'),
        "two_of_it": HEAD + '    open("/Users/x/twice.csv")\n',
        "late": HEAD + "    while True:\n        pass\n",
    }.items():
        write(protocols / f"{name}.py", text)
    for name, well in (("one", "B1"), ("two", "Z9")):
        write(repo / name / "helper.py", f"WELL = {well!r}\n")
        write(repo / name / f"{name}.py", "from helper import WELL\n" + HEAD + MOVES)


@pytest.fixture(scope="module")
def repo(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("work") / "repo"
    (folder / ".git").mkdir(parents=True)
    build(folder)
    return folder


@pytest.fixture(scope="module")
def checked(repo: Path) -> dict[str, CheckedProtocol]:
    """All of them, checked in one call."""
    files = protocols_named([repo])
    run = check_files(files, CheckSettings(timeout_s=60), load_rules())
    return {Path(one.file).stem: one for one in run.protocols}


def refusal(checked: CheckedProtocol) -> str:
    assert checked.problem is not None
    return checked.problem.message


def test_modules_of_the_repository_are_found_and_told(checked: dict[str, CheckedProtocol]) -> None:
    helped = checked["helped"]
    assert helped.problem is None
    assert helped.modules == {
        "beside": "beside.py", "above": "../above.py", "shared": "../../shared",
    }  # fmt: skip
    told = {r.message.split(",")[0]: r for r in helped.remarks if "imports" in r.message}
    assert told["It imports beside"].line == 2
    assert "It imports shared" in told
    assert all("for this rehearsal only" in remark.message for remark in told.values())


def test_nothing_is_found_above_the_checkout(checked: dict[str, CheckedProtocol]) -> None:
    told = refusal(checked["strange"])
    assert "it imports stranger, which is not installed" in told
    assert "PYTHONPATH=FOLDER aegis-ot check" in told


def test_a_module_that_another_opentrons_had_is_not_looked_for(
    checked: dict[str, CheckedProtocol],
) -> None:
    told = refusal(checked["older"])
    assert "opentrons.commands, which is not in this release of Opentrons" in told
    assert "PYTHONPATH" not in told


def test_of_a_module_elsewhere_in_the_repository_the_folder_is_told(
    checked: dict[str, CheckedProtocol], repo: Path
) -> None:
    assert f"PYTHONPATH={repo / 'lib'} aegis-ot check " in refusal(checked["far_off"])


def test_one_protocol_leaves_no_module_to_the_next(checked: dict[str, CheckedProtocol]) -> None:
    assert checked["one"].problem is None
    assert "Z9" in refusal(checked["two"])


def test_labware_that_a_helper_names_is_found_and_told(
    checked: dict[str, CheckedProtocol],
) -> None:
    trough = checked["trough"]
    assert trough.problem is None
    assert "our_trough is defined by ../../labware/trough.json" in " ".join(trough.notes)


@pytest.mark.parametrize("name", ["nowhere", "nowhere_2_13"])
def test_labware_that_is_nowhere_says_what_to_type(
    checked: dict[str, CheckedProtocol], name: str
) -> None:
    assert refusal(checked[name]).endswith("give its definition: --labware FOLDER.")


def test_a_file_that_is_not_there_says_where_the_rehearsal_runs(
    checked: dict[str, CheckedProtocol],
) -> None:
    assert refusal(checked["no_file"]).startswith("it reads missing.csv, which is not there")
    assert checked["no_file"].problem.line == 5  # type: ignore[union-attr]


@pytest.mark.parametrize("name", ["elsewhere", "windows"])
def test_a_file_of_the_repository_is_read_in_the_place_of_one_that_is_not_there(
    checked: dict[str, CheckedProtocol], name: str
) -> None:
    assert checked[name].report is not None
    (told,) = (one for one in checked[name].remarks if "well.txt" in one.message)
    assert "../../data/well.txt" in told.message
    assert told.line


def test_of_two_files_of_that_name_none_is_read(checked: dict[str, CheckedProtocol]) -> None:
    assert "/Users/x/twice.csv, which is not there" in refusal(checked["two_of_it"])


def test_a_late_protocol_is_told_with_its_line_and_the_option(
    checked: dict[str, CheckedProtocol],
) -> None:
    assert "--timeout SECONDS" in refusal(checked["late"])
    assert checked["late"].problem.line in (5, 6)  # type: ignore[union-attr]


def test_json_in_a_folder_that_is_no_labware_is_passed_over(tmp_path: Path) -> None:
    write(tmp_path / "a" / "trough.json", DEFINITION)
    other = write(tmp_path / "a" / "fields.json", [1])
    assert list(read_labware([tmp_path / "a"])) == ["custom_beta/our_trough/1"]
    with pytest.raises(ConfigurationError, match="this is no Opentrons labware"):
        read_labware([other])
    write(tmp_path / "b" / "fields.json", [1])
    with pytest.raises(
        ConfigurationError, match=r"no \*\.json in the folder is an Opentrons labware"
    ):
        read_labware([tmp_path / "b"])


def test_of_a_folder_the_protocols_are_checked_and_nothing_else(tmp_path: Path) -> None:
    protocol = write(tmp_path / "deep" / "er" / "p.py", OWN_LABWARE)
    write(tmp_path / "deep" / "helper.py", "WELL = 1\n")
    write(tmp_path / ".venv" / "q.py", OWN_LABWARE)
    write(tmp_path / "venv" / "q.py", OWN_LABWARE)
    assert protocols_named([tmp_path, protocol]) == [protocol]
    named = tmp_path / "deep" / "helper.py"
    assert protocols_named([named]) == [named]
    (tmp_path / "empty").mkdir()
    with pytest.raises(ConfigurationError, match="there is no protocol below this folder"):
        protocols_named([tmp_path / "empty"])


def test_the_root_is_the_checkouts_else_a_folder_of_the_call_else_its_own(tmp_path: Path) -> None:
    file = write(tmp_path / "a" / "b" / "p.py", "")
    assert root_of(file, []) == file.parent
    assert root_of(file, [tmp_path / "other", tmp_path]) == tmp_path
    (tmp_path / "a" / ".git").write_text("gitdir: elsewhere")
    assert root_of(file, [tmp_path]) == tmp_path / "a"


def test_what_a_verdict_rests_on_besides_the_protocol_is_known(repo: Path) -> None:
    text = "from beside import WELL\nTABLE = 'volumes.csv'\n"
    file = repo / "lab" / "protocols" / "p.py"
    around = surroundings_of(file, text, repo)
    names = {path.relative_to(repo).as_posix() for path in around.texts}
    assert names == {
        "lab/protocols/beside.py", "lab/above.py", "shared/__init__.py", "shared/wells.py",
        "shared/deep.py",
    }  # fmt: skip
    assert [path.name for path in data_named(file, text)] == ["volumes.csv"]
