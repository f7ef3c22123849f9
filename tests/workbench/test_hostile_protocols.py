"""Protocols that end, crash, hang or flood the process that rehearses them."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from aegis_ot.preflight import load_rules
from aegis_ot.vocabulary import VerdictWord
from aegis_ot.workbench import CheckedProtocol, CheckSettings, check_files, rehearser
from aegis_ot.workbench.link import LinkAnswer
from aegis_ot.workbench.rehearsal_process import CAN_FORK

HEAD = 'metadata = {"apiLevel": "2.15"}\n'

# Every open pipe that it can find gets a message's head and no message, then a whole one.
WRITES = (
    HEAD
    + """
import os, pickle, stat, struct
def run(p):
    forged = pickle.dumps("forged")
    for number in range(3, 64):
        try:
            if stat.S_ISFIFO(os.fstat(number).st_mode):
                for data in (b"junk", forged):
                    os.write(number, struct.pack("!Q", len(data)) + data)
        except OSError:
            pass
"""
)
GOOD = HEAD + "def run(protocol):\n    print('hello')\n"

VANDAL = (
    HEAD
    + """
import opentrons.protocol_api as api
def run(p):
    api.ProtocolContext.load_labware = None
    for n in range(10_000):
        print("storm", n)
"""
)

AFTER = HEAD + "def run(p):\n    p.load_labware('nest_12_reservoir_15ml', 1)\n"

# name: text, line at which it stops, words of the message
HOSTILE: dict[str, tuple[str, int | None, str]] = {
    "endless.py": (HEAD + "def run(p):\n    while True: pass\n", 3, "did not end"),
    "stubborn.py": (
        HEAD
        + "def run(p):\n    while True:\n        try:\n            n = 1\n"
        + "        except BaseException:\n            pass\n",
        None,
        "did not end",
    ),
    # Blocks inside C code, where no interruption reaches it.
    "blocks.py": (
        HEAD + "import os\ndef run(p):\n    os.read(os.pipe()[0], 1)\n",
        4,
        "did not end",
    ),
    "exits.py": (HEAD + "import sys\ndef run(p):\n    sys.exit(0)\n", 4, "ends the Python process"),
    "leaves.py": (HEAD + "import os\ndef run(p):\n    os._exit(0)\n", None, "ended the Python"),
    "crashes.py": (
        HEAD + "import os, signal\ndef run(p):\n    os.kill(os.getpid(), signal.SIGSEGV)\n",
        4,
        "ended the Python process",
    ),
    "raises.py": (HEAD + "def run(p):\n    x = 1\n    1 / 0\n", 4, "ZeroDivisionError"),
    "asks.py": (HEAD + "def run(p):\n    input('name?')\n", 3, "EOFError"),
    "labware.py": (
        HEAD + "def run(p):\n    p.load_labware('my_plate', 1)\n",
        3,
        "give its definition: --labware FOLDER",
    ),
    "newer.py": (
        '\nmetadata = {"apiLevel": "2.99"}\ndef run(p):\n    pass\n',
        2,
        "apiLevel 2.99, which no engine that this aegis-ot knows takes",
    ),
    "syntax.py": (HEAD + "def run(p:\n    pass\n", 2, "not valid Python"),
    "deep.py": (HEAD + f"x = {'-' * 200_000}1\ndef run(p): ...\n", None, "nested too deeply"),
    "long.py": (HEAD + f"x = {'1+' * 100_000}1\ndef run(p): ...\n", None, "nested too deeply"),
    "no_run.py": (HEAD + "x = 1\n", 1, "defines no function run(protocol) at its"),
    "nested_run.py": (
        HEAD + "class P:\n    def run(self, p):\n        pass\n",
        3,
        "inside something",
    ),
    "lambda_run.py": (HEAD + "x = 1\nrun = lambda p: None\n", 3, "this is no def"),
    "two_runs.py": (HEAD + "def run(p): ...\ndef run(p): ...\n", 3, "More than one run function"),
    "bare_run.py": (HEAD + "x = 1\ndef run():\n    pass\n", 3, "takes 0 positional arguments"),
    "generator.py": (
        HEAD + "x = 1\ndef run(p):\n    p.comment('never said')\n    yield 1\n",
        3,
        "run is never executed, since it is a generator",
    ),
    "passed_on.py": (
        HEAD + "def steps(p):\n    yield 1\ndef run(p):\n    return steps(p)\n",
        2,
        "what run returns, steps, is never executed",
    ),
    "awaits.py": (
        HEAD + "async def steps(p): ...\ndef run(p):\n    return steps(p)\n",
        2,
        "is never executed, since it is async",
    ),
    "no_level.py": ("x = 1\n\ndef run(p):\n    pass\n", 1, "apiLevel not declared"),
    "number_level.py": (
        '"""Doc."""\nmetadata = {"apiLevel": 2.15}\ndef run(p):\n    pass\n',
        2,
        "must be strings",
    ),
    "version_1.py": (
        "from opentrons import labware, robot, instruments\nplate = labware.load('96-flat', '1')\n",
        1,
        "is written for version 1",
    ),
    "at_import.py": (
        HEAD + "assert False, 'no good'\ndef run(p):\n    pass\n",
        2,
        "AssertionError: no good",
    ),
    "endless_import.py": (HEAD + "while True: pass\ndef run(p): ...\n", 2, "did not end"),
    "occupied.py": (
        HEAD
        + "def run(p):\n    for _ in '12':\n        p.load_labware('nest_12_reservoir_15ml', 1)\n",
        4,
        "LocationIsOccupiedError: Labware nest_12",
    ),
    "no_tips.py": (
        HEAD + "def run(p):\n    p.load_instrument('p20_single_gen2', 'left').pick_up_tip()\n",
        3,
        "the pipette has no tip rack",
    ),
    "imports.py": (
        HEAD + "import no_such_thing\ndef run(p):\n    pass\n",
        2,
        "it imports no_such_thing, which is not",
    ),
}


@pytest.mark.skipif(not CAN_FORK, reason="protocols share a process here")
@pytest.mark.parametrize(
    "text", [WRITES, HEAD + "import os\ndef run(p):\n    os.kill(os.getppid(), 9)\n"]
)
def test_what_a_protocol_does_to_its_rehearser_spoils_its_own_result_only(
    tmp_path: Path, text: str
) -> None:
    files = [tmp_path / name for name in ("before.py", "writes.py", "after.py", "last.py")]
    for file in files:
        file.write_text(text if file.stem == "writes" else AFTER, encoding="utf-8")
    run = check_files(files, CheckSettings(timeout_s=20), load_rules())
    words = [protocol.verdict for protocol in run.protocols]
    assert words == [VerdictWord.PASS, VerdictWord.ERROR, VerdictWord.PASS, VerdictWord.PASS]


def test_where_there_is_no_fork_it_spoils_no_other_result_either(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    alone = rehearser._MAIN.replace(
        "import main", "import main\nmain.__globals__['CAN_FORK'] = False"
    )
    monkeypatch.setattr(rehearser, "_MAIN", alone)
    monkeypatch.setenv("AEGIS_OT_WARM", "0")  # nor does a process outlive its command there
    forges = WRITES.replace('(b"junk", forged)', "(forged,)")
    for name, text in [("a", WRITES), ("b", AFTER), ("c", forges), ("d", AFTER)]:
        (tmp_path / f"{name}.py").write_text(text, encoding="utf-8")
    run = check_files(sorted(tmp_path.iterdir()), CheckSettings(timeout_s=20), load_rules())
    words = [protocol.verdict for protocol in run.protocols]
    assert words == [VerdictWord.ERROR, VerdictWord.PASS, VerdictWord.ERROR, VerdictWord.PASS]


def test_an_installation_that_changes_all_the_time_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "p.py").write_text(AFTER, encoding="utf-8")
    answers = {True: LinkAnswer("ready"), False: LinkAnswer(stale=True)}
    monkeypatch.setattr(
        rehearser.Rehearser, "_ask", lambda self, task, limit_s: answers[task is None]
    )
    (protocol,) = check_files([tmp_path / "p.py"], CheckSettings(), load_rules()).protocols
    assert protocol.problem is not None
    assert "changed just now" in protocol.problem.message


def test_a_variable_that_a_protocol_needs_is_named_and_passed_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PLATE_KEY", "A1")
    file = tmp_path / "p.py"
    file.write_text(HEAD + "import os\ndef run(p):\n    os.environ['PLATE_KEY']\n", "utf-8")
    (protocol,) = check_files([file], CheckSettings(), load_rules()).protocols
    assert protocol.problem is not None
    assert "AEGIS_OT_PROTOCOL_ENV=PLATE_KEY" in protocol.problem.message
    assert protocol.problem.line == 4
    monkeypatch.setenv("AEGIS_OT_PROTOCOL_ENV", "OTHER, PLATE_KEY")
    (protocol,) = check_files([file], CheckSettings(), load_rules()).protocols
    assert protocol.problem is None


def test_a_protocol_gets_no_keys(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    secret = ("ANTHROPIC_API_KEY", "MY_LAB", "AEGIS_OT_TOKEN", "GITHUB_TOKEN", "OT_PASSWORD")
    for name in (*secret, "OT_API_CONFIG_DIR_OF_MINE"):
        monkeypatch.setenv(name, "x")
    text = f"import os\ndef run(p):\n    assert not set({secret}) & set(os.environ)\n"
    text += "    assert os.environ['OT_API_CONFIG_DIR_OF_MINE'] and os.environ['PATH']\n"
    (tmp_path / "p.py").write_text(HEAD + text, encoding="utf-8")
    (protocol,) = check_files([tmp_path / "p.py"], CheckSettings(), load_rules()).protocols
    assert protocol.problem is None


@pytest.fixture(scope="module")
def checked(tmp_path_factory: pytest.TempPathFactory) -> dict[str, CheckedProtocol]:
    folder = tmp_path_factory.mktemp("hostile")
    files = []
    for name, (text, _, _) in HOSTILE.items():
        files.append(folder / name)
        files[-1].write_text(text, encoding="utf-8")
    for name, text in (("vandal.py", VANDAL), ("after.py", AFTER)):
        files.append(folder / name)
        files[-1].write_text(text, encoding="utf-8")
    # Good ones between and after the bad ones: they must not be harmed.
    for n in (1, 7, len(files)):
        good = folder / f"good{n}.py"
        good.write_text(GOOD, encoding="utf-8")
        files.insert(n, good)
    run = check_files(files, CheckSettings(timeout_s=1.5), load_rules())
    assert run.exit_code == 2
    return {Path(protocol.file).name: protocol for protocol in run.protocols}


@pytest.mark.parametrize("name", HOSTILE)
def test_it_is_reported_with_its_line_and_never_as_clean(
    checked: dict[str, CheckedProtocol], name: str
) -> None:
    _, line, words = HOSTILE[name]
    protocol = checked[name]
    assert protocol.verdict is VerdictWord.ERROR
    assert protocol.problem is not None
    assert words in protocol.problem.message
    if line is not None:
        assert protocol.problem.line == line
    assert protocol.family == ""
    assert protocol.findings == ()


@pytest.mark.parametrize(
    ("content", "line", "words"),
    [
        (b"# Stra\xc3\x9fe\n# caf\xe9\n", 2, "not UTF-8"),
        (b"\x89PNG\r\n\x1a\n\0\0\0", None, "binary"),
        (b" \n", None, "empty"),
        (b'{"schemaVersion": 8}', None, "holds JSON"),
    ],
)
def test_what_is_no_text_of_a_protocol_is_told_apart(
    tmp_path: Path, content: bytes, line: int | None, words: str
) -> None:
    file = tmp_path / "p.py"
    file.write_bytes(content)
    (protocol,) = check_files([file], CheckSettings(), load_rules()).protocols
    assert protocol.verdict is VerdictWord.ERROR
    assert protocol.problem is not None
    assert words in protocol.problem.message
    assert protocol.problem.line == line


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes with names here")
def test_a_pipe_is_refused_and_not_waited_for(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe.py"
    os.mkfifo(pipe)
    (protocol,) = check_files([pipe], CheckSettings(), load_rules()).protocols
    assert protocol.problem is not None
    assert "no regular file" in protocol.problem.message


def test_a_module_beside_the_protocol_is_found_for_the_rehearsal_and_told(tmp_path: Path) -> None:
    (tmp_path / "my_layout.py").write_text("WELL = 'A1'\n", encoding="utf-8")
    file = tmp_path / "p.py"
    file.write_text(HEAD + "from my_layout import WELL\ndef run(p): ...\n", encoding="utf-8")
    (protocol,) = check_files([file], CheckSettings(), load_rules()).protocols
    assert protocol.problem is None
    assert protocol.modules == {"my_layout": "my_layout.py"}


def test_the_others_are_still_checked(checked: dict[str, CheckedProtocol]) -> None:
    good = [protocol for name, protocol in checked.items() if name.startswith("good")]
    assert [protocol.verdict for protocol in good] == [VerdictWord.PASS] * 3


def test_one_protocol_cannot_spoil_the_next(checked: dict[str, CheckedProtocol]) -> None:
    assert checked["vandal.py"].problem is None
    assert checked["after.py"].problem is None


def test_a_folder_of_modules_named_like_the_library_does_no_harm(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "json.py").write_text("raise RuntimeError('the wrong json')\n", encoding="utf-8")
    (tmp_path / "good.py").write_text(GOOD, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    run = check_files([Path("good.py")], CheckSettings(timeout_s=60), load_rules())
    assert run.exit_code == 0
