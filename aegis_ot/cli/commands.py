"""The commands by name, and how each is loaded when it is called.

A command's module owns a Typer, ``app``, in which the command is registered. The laboratory's
commands join by entry points, so that this package knows their names only.
"""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from ..errors import ConfigurationError

if TYPE_CHECKING:
    from importlib import metadata

GROUP = "aegis_ot.commands"
"""Entry points of commands: ``name = module:Typer``."""

_LAB = ""


@dataclass(frozen=True)
class CommandEntry:
    """One command of the first level.

    Attributes:
        summary: Its line in ``aegis-ot --help``: the first sentence of its own help.
        extra: Of the package, with all that it needs.
        module: Of this room; none if the command joins by an entry point.
    """

    summary: str
    extra: str
    module: str = _LAB

    @property
    def group(self) -> str:
        """The heading under which help shows it."""
        return _GROUPS.get(self.module, "Measure and make (laboratory)")


_GROUPS = {
    **dict.fromkeys(("checks", "corpora", "engines", "rulebook", "editors"), "Before a run"),
    **dict.fromkeys(("demo", "dryruns"), "Without a robot"),
    **dict.fromkeys(("robots", "onto_robot", "qualifications", "fleets"), "On robots"),
    **dict.fromkeys(("sidecars", "services", "aiming"), "The sidecar"),
    **dict.fromkeys(("audits", "inspections", "rests", "runs", "worldmodels"), "After a run"),
}
"""Headings of help, by the module that owns a command."""


COMMANDS = {
    "check": CommandEntry(
        "Check protocols before they run: rehearse them, and judge them by the rules.",
        "check",
        "checks",
    ),
    "corpus": CommandEntry(
        "Judge every protocol below some folders, and keep what came of each in a table.",
        "check",
        "corpora",
    ),
    "engines": CommandEntry(
        "The releases of opentrons that protocols are rehearsed with.", "check", "engines"
    ),
    "demo": CommandEntry(
        "Show a protocol rejected, a run watched, and a run paused at the failed well.",
        "sidecar",
        "demo",
    ),
    "simulate": CommandEntry(
        "Run a protocol with both layers on this machine: no robot, no camera, no key.",
        "sidecar",
        "dryruns",
    ),
    "aim": CommandEntry(
        "Say how well a run's camera is known, which tips it sees whole, and when it was moved.",
        "sidecar",
        "aiming",
    ),
    "run": CommandEntry(
        "Run a protocol on a robot: upload, analysis, Layer 1, start, verdicts, report.",
        "sidecar",
        "robots",
    ),
    "watch": CommandEntry(
        "Watch the run on a robot whose protocol carries no guard; waits until one begins.",
        "sidecar",
        "robots",
    ),
    "qualify": CommandEntry(
        "Let the robot fail on purpose, and count what its camera catches.",
        "sidecar",
        "qualifications",
    ),
    "install": CommandEntry(
        "Install the guard on an OT-2 or Flex over ssh, and try it there.", "sidecar", "onto_robot"
    ),
    "wrap": CommandEntry(
        "Write a protocol with the guard inside, for a robot on which nothing may be installed.",
        "sidecar",
        "onto_robot",
    ),
    "reproduce": CommandEntry(
        "Measure every table and figure of the paper again, and show ours beside the paper's.",
        "lab",
    ),
    "lsp": CommandEntry(
        "Serve an editor: findings as you type, and quick fixes (Language Server Protocol, stdio).",
        "editor",
        "editors",
    ),
    "mcp": CommandEntry(
        "Serve an agent: check, explain, simulate, runs (Model Context Protocol, stdio).",
        "check",
        "editors",
    ),
    "explain": CommandEntry(
        "Say what a rule demands, why, how to mend a violation, and show examples.",
        "check",
        "rulebook",
    ),
    "doctor": CommandEntry(
        "Look at camera, light, detector, disk, store, token, models, clock and robot.",
        "sidecar",
        "services",
    ),
    "sidecar": CommandEntry(
        "Watch the robot's tips: capture, score, judge, and show a page.", "sidecar", "sidecars"
    ),
    "audit": CommandEntry(
        "Read every well of a finished run again with all that the run tells, and rank what "
        "passed.",
        "sidecar",
        "audits",
    ),
    "inspect": CommandEntry(
        "Write a page that shows frames, boxes, columns, scores and routes, well by well.",
        "sidecar",
        "inspections",
    ),
    "fit": CommandEntry(
        "Build the world model of a lab from its recorded normal runs.", "sidecar", "worldmodels"
    ),
    "world-model": CommandEntry(
        "Verify a world model, and say what it was made from.", "sidecar", "worldmodels"
    ),
    "dataset": CommandEntry("Make trajectory data sets.", "lab"),
    "rest": CommandEntry(
        "Say what a stopped run left, and write the protocol that finishes it.", "sidecar", "rests"
    ),
    "runs": CommandEntry(
        "What a sidecar has kept: list, show, export, verify, trends, remove.", "sidecar", "runs"
    ),
    "evaluate": CommandEntry("Score a layer on labelled data.", "lab"),
    "fleet": CommandEntry("Many robots: one agent each.", "fleet", "fleets"),
    "llm": CommandEntry("Export requests to a model, and import answers got elsewhere.", "lab"),
    "rules": CommandEntry("The rule database: list, test, document.", "check", "rulebook"),
    "train": CommandEntry("Train the tip detector.", "train"),
}
"""In the order in which help shows them."""


def load_command(name: str) -> Any:
    """The command itself, as Click sees it.

    Raises:
        ConfigurationError: It joins from a package that is not installed.
        ModuleNotFoundError: A library that it needs is not installed.
    """
    known = COMMANDS[name]
    app = import_module(f".{known.module}", __package__).app if known.module else joined(name)
    return typer.main.get_group(app).commands[name]


def joined(name: str, group: str = GROUP) -> Any:
    """What another package of the distribution adds under this name.

    Raises:
        ConfigurationError: Nothing does.
        ModuleNotFoundError: It, or a library that it needs, is not installed.
    """
    from importlib import metadata

    found = metadata.entry_points(group=group) or _of_checkout(group)
    for entry in found:
        if entry.name == name:
            return entry.load()
    raise ConfigurationError(
        f"{name} is a command of the laboratory, which is not installed. Install it with: "
        "pip install 'aegis-ot[lab]'"
    )


def _of_checkout(group: str) -> list[metadata.EntryPoint]:
    """The entry points of a checkout that was installed at an older commit."""
    from importlib import metadata

    file = Path(__file__).parents[2] / "pyproject.toml"
    try:
        tomllib = import_module("tomllib")
        project = tomllib.loads(file.read_text(encoding="utf-8"))["project"]
    except (ModuleNotFoundError, OSError, KeyError):  # Python 3.10; no checkout
        return []
    table = project.get("entry-points", {}).get(group, {})
    return [metadata.EntryPoint(name, value, group) for name, value in table.items()]


def what_to_install(name: str, missing: ModuleNotFoundError) -> str:
    """One sentence on a library that a command needs."""
    library = (missing.name or "").partition(".")[0]
    if library.startswith("opentrons"):
        return (
            f"{name} needs opentrons, which is not installed. Install your robot's with: "
            "pip install 'aegis-ot[ot2]' (OT-2) or 'aegis-ot[flex]' (Flex)"
        )
    extra = COMMANDS[name].extra
    if extra == "check":  # all of it is here, or no command would be
        extra = "sidecar"
    return (
        f"{name} needs the package {library!r}, which is not installed. Install what it needs "
        f"with: pip install 'aegis-ot[{extra}]'"
    )
