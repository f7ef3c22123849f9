"""Every command in the documentation is one that exists; what can be run here is run."""

from __future__ import annotations

import importlib.util
import re
import shutil
import sys
from collections import Counter
from pathlib import Path

import pytest

from scripts.cli_reference import commands, root
from tests.cli.commands import Command

from .blocks import PAGES, ROOT, TUTORIAL, Block, blocks_of, words_of

WHY_NOT = {
    "Installs",
    "Needs a robot",
    "Needs robots",
    "Needs a camera",
    "Needs a model",
    "Needs answers from elsewhere",
    "Needs recordings",
    "Needs data sets",
    "Needs a clone",
    "Needs a container engine",
    "Needs the sidecar of the other terminal",
    "Runs until Ctrl-C",
    "Takes a minute",
    "Takes minutes",
    "As root",
}
"""Why a block is not run: said above it, where the reader sees it."""

ELSEWHERE = {
    "pip",
    "git",
    "python3",
    ".",
    "sudo",
    "podman",
    "ollama",
    "export",
    "opentrons_simulate",
}
"""Programs that only blocks with a title may call."""

SLOW = {
    "aegis-ot rules test examples/rules/luciferase.json",
    "aegis-ot corpus protocols/ --out new.csv --against results.csv",
    "aegis-ot check --roles-template roles.txt examples/demo/pcr_setup_contaminated.py",
    "aegis-ot corpus examples --out shelf.csv",
    "aegis-ot check --explain-roles examples/demo/pcr_setup_contaminated.py",
    "aegis-ot check --format sarif examples/demo/pcr_setup_contaminated.py",
    "aegis-ot check --format sarif --output findings.sarif protocols/*.py",
    "aegis-ot check --format junit --output findings.xml protocols/*.py",
    "aegis-ot wrap protocol.py --out guarded.py --set assay=pcr "
    "--set sidecar=http://192.168.1.20:7645",
    "aegis-ot simulate examples/demo/hello_guard.py --fault partial:50@B1 --report out/report.html",
    "aegis-ot simulate examples/demo/normalisation_plate.py --fault partial:50@3:D4 --on-fail stop "
    "--first-wells trust",
}
"""Lines of blocks that could be run, and are not: the like of them is run elsewhere, or on less."""

BLOCKS = [block for page in PAGES for block in blocks_of(page)]
SHELL = [block for block in BLOCKS if block.language == "sh"]
RUN = [block for block in SHELL if not block.title and not set(block.commands()) <= SLOW]
COMMANDS = dict(commands(root()))


def test_every_block_says_what_it_is():
    nameless = [block.place for block in BLOCKS if not block.language]
    assert nameless == []
    unknown = {block.title for block in SHELL if block.title} - WHY_NOT
    assert unknown == set()


def test_it_is_known_how_much_is_run(record_property):
    skipped = Counter(block.title for block in SHELL if block.title)
    record_property("blocks that are run", len(RUN))
    record_property("blocks that are not", dict(skipped))
    assert len(RUN) >= 12
    assert {line for block in SHELL for line in block.commands()} >= SLOW


@pytest.mark.parametrize("block", SHELL, ids=lambda block: block.place)
def test_every_command_and_option_exists(block: Block):
    for line in block.commands():
        _, words = words_of(line)
        if not words:  # variables alone
            continue
        program, *arguments = words
        if program == "aegis-ot":
            check_call(arguments)
        elif program == "make":
            assert re.search(rf"^{arguments[0]}:", (ROOT / "Makefile").read_text(), re.MULTILINE)
        elif program in ("python", "pytest"):
            check_python(["-m", program, *arguments] if program == "pytest" else arguments)
        else:
            assert program in ELSEWHERE, program
            assert block.title, f"{program} cannot be run by a test: say why, in a title"


def check_call(arguments: list[str]) -> None:
    """The command exists, knows these options, and has what it requires."""
    path = next((p for p in COMMANDS if tuple(arguments[: len(p)]) == p), None)
    assert path, f"no command {' '.join(arguments)}"
    command, rest = COMMANDS[path], arguments[len(path) :]
    options = {
        name: parameter
        for parameter in command.params
        if parameter.param_type_name == "option"
        for name in (*parameter.opts, *parameter.secondary_opts)
    }
    given, positional = set(), []
    while rest:
        word = rest.pop(0)
        if not word.startswith("-"):
            positional.append(word)
            continue
        assert word in options, f"{' '.join(path)} has no option {word}"
        given.add(options[word].name)
        if not options[word].is_flag:
            values = options[word].nargs
            assert len(rest) >= values, f"{word} without its value"
            del rest[:values]
    required = {p.name for p in options.values() if p.required}
    assert required <= given, f"{' '.join(path)} requires {required - given}"
    places = [p for p in command.params if p.param_type_name == "argument"]
    assert len(positional) >= sum(p.required for p in places)
    assert len(positional) <= len(places) or any(p.nargs == -1 for p in places)


def check_python(arguments: list[str]) -> None:
    """The module, and test files that are named, exist."""
    assert arguments[0] == "-m"
    assert importlib.util.find_spec(arguments[1]), arguments[1]
    for word in arguments[2:]:
        assert not word.startswith("tests/") or (ROOT / word).exists(), word


class Reader:
    """Types what a page shows, in a folder where a clone's files and some protocols lie."""

    def __init__(self, folder: Path, aegis: Command, monkeypatch: pytest.MonkeyPatch) -> None:
        self.folder, self.aegis = folder, aegis
        for name in ("examples", "rules", "tests"):
            (folder / name).symlink_to(ROOT / name)
        demo = ROOT / "examples" / "demo"
        shutil.copy(ROOT / "examples" / "benchmark" / "b01.py", folder / "protocol.py")
        (folder / "protocols").mkdir()
        shutil.copy(demo / "hello_guard.py", folder / "protocols")
        monkeypatch.setattr(sys, "stdin", None)
        for variable in ("AEGIS_OT_MODEL", "AEGIS_OT_SIDECAR", "AEGIS_OT_CONFIG"):
            monkeypatch.delenv(variable, raising=False)

    def read(self, page: Path) -> int:
        """How many blocks were run."""
        done = 0
        for block in blocks_of(page):
            if block.language == "python" and block.title:
                (self.folder / block.title).write_text(block.body, encoding="utf-8")
            if block in RUN:
                self.type(block)
                done += 1
        return done

    def type(self, block: Block) -> None:
        printed = ""
        for line in sorted(set(block.commands()) - SLOW, key=block.commands().index):
            _, (program, *arguments) = words_of(line)
            assert program == "aegis-ot", f"{block.place}: a title has to say why it is not run"
            result = self.aegis(*(found for word in arguments for found in self.expand(word)))
            assert result.code in (0, 1), f"{block.place}: {line}\n{result.out}{result.err}"
            assert "Traceback" not in result.err, f"{block.place}: {line}\n{result.err}"
            printed += result.out
        for part in re.split(r"^\s*\.\.\.\s*$", block.shows, flags=re.MULTILINE):
            assert flat(part) in flat(printed), f"{block.place} shows what is not printed"

    def expand(self, word: str) -> list[str]:
        if "*" not in word:
            return [word]
        return sorted(str(p.relative_to(self.folder)) for p in self.folder.glob(word))


def flat(text: str) -> str:
    return " ".join(text.split())


@pytest.fixture
def reader(
    tmp_path: Path, capfdbinary: pytest.CaptureFixture[bytes], monkeypatch: pytest.MonkeyPatch
) -> Reader:
    monkeypatch.chdir(tmp_path)
    return Reader(tmp_path, Command(capfdbinary), monkeypatch)


@pytest.mark.timeout(400)  # a busy machine takes several times as long
def test_the_tutorial_can_be_followed(reader: Reader):
    assert sum(map(reader.read, TUTORIAL)) >= 7
    assert (reader.folder / "guarded_for_robot.py").exists()
    assert (reader.folder / "first-run.html").exists()


@pytest.mark.parametrize(
    "page",
    [p for p in PAGES if p not in TUTORIAL and any(b.page == p for b in RUN)],
    ids=lambda page: page.stem,
)
def test_what_a_page_shows_can_be_run(reader: Reader, page: Path):
    assert reader.read(page) > 0
