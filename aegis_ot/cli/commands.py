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
class Command:
    """One command of the first level.

    Attributes:
        summary: Its line in ``aegis-ot --help``: the first sentence of its own help.
        extra: Of the package, with all that it needs.
        module: Of this room; none if the command joins by an entry point.
    """

    summary: str
    extra: str
    module: str = _LAB


COMMANDS = {
    "check": Command(
        "Check protocols before they run: rehearse them, and judge them by the rules.",
        "check",
        "checks",
    ),
    "audit": Command(
        "Read every well of a finished run again with all that the run tells, and rank what "
        "passed.",
        "sidecar",
        "audits",
    ),
    "corpus": Command(
        "Judge every protocol below some folders, and keep what came of each in a table.",
        "check",
        "corpora",
    ),
    "demo": Command(
        "Show a protocol rejected, a run watched, and a run paused at the failed well.",
        "sidecar",
        "demo",
    ),
    "simulate": Command(
        "Run a protocol with both layers on this machine: no robot, no camera, no key.",
        "sidecar",
        "dryruns",
    ),
    "inspect": Command(
        "Write a page that shows frames, boxes, columns, scores and routes, well by well.",
        "sidecar",
        "inspections",
    ),
    "run": Command(
        "Run a protocol on a robot: upload, analysis, Layer 1, start, verdicts, report.",
        "sidecar",
        "robots",
    ),
    "watch": Command(
        "Watch the run on a robot whose protocol carries no guard; waits until one begins.",
        "sidecar",
        "robots",
    ),
    "install": Command(
        "Install the guard on an OT-2 or Flex over ssh, and try it there.", "sidecar", "onto_robot"
    ),
    "wrap": Command(
        "Write a protocol with the guard inside, for a robot on which nothing may be installed.",
        "sidecar",
        "onto_robot",
    ),
    "reproduce": Command(
        "Measure every table and figure of the paper again, and show ours beside the paper's.",
        "lab",
    ),
    "explain": Command(
        "Say what a rule demands, why, how to mend a violation, and show examples.",
        "check",
        "rulebook",
    ),
    "doctor": Command(
        "Look at camera, light, detector, disk, store, token, models, clock and robot.",
        "sidecar",
        "services",
    ),
    "sidecar": Command(
        "Watch the robot's tips: capture, score, judge, and show a page.", "sidecar", "sidecars"
    ),
    "fit": Command(
        "Build the world model of a lab from its recorded normal runs.", "sidecar", "worldmodels"
    ),
    "world-model": Command(
        "Verify a world model, and say what it was made from.", "sidecar", "worldmodels"
    ),
    "dataset": Command("Make trajectory data sets.", "lab"),
    "runs": Command("What a sidecar has kept: list, show, export, remove.", "sidecar", "runs"),
    "evaluate": Command("Score a layer on labelled data.", "lab"),
    "fleet": Command("Many robots: one agent each.", "fleet", "fleets"),
    "llm": Command("Export requests to a model, and import answers got elsewhere.", "lab"),
    "rules": Command("The rule database: list, test, document.", "check", "rulebook"),
    "train": Command("Train the tip detector.", "train"),
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
