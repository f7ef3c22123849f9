"""What is settled before a run starts: its analysis, its inputs, the deck, the labware offsets."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..adapters.opentrons.rehearsal import undeclared
from ..errors import ConfigurationError, RobotError
from .client import RobotClient, Values
from .deck_needs import lacking
from .offsets import known_offsets, offsets_in_file, tell_offsets
from .server_answers import Analysis


@dataclass
class Inputs:
    """What a protocol is run with.

    Attributes:
        labware: Files of custom labware.
        values: Of runtime parameters.
        files: Of CSV runtime parameters.
        uploaded: What the robot calls those files, once it has them.
        offsets: Of the labware, as the robot takes them.
    """

    labware: tuple[Path, ...] = ()
    values: Values = field(default_factory=dict)
    files: Mapping[str, Path] = field(default_factory=dict)
    uploaded: dict[str, str] = field(default_factory=dict)
    offsets: Sequence[Mapping[str, Any]] = ()


def analyse(
    robot: RobotClient,
    protocol: Path,
    waiting: Callable[[float], None],
    timeout_s: float,
    inputs: Inputs | None = None,
) -> tuple[str, Analysis]:
    """Upload a protocol and have it analysed anew, as the robot is set now.

    Args:
        robot: Where.
        protocol: The file.
        waiting: Told now and then how many seconds have gone by.
        timeout_s: How long the robot may take.
        inputs: What it is analysed with; takes down what its files are called there.

    Returns:
        Its identifier on the robot, and the analysis.

    Raises:
        RobotError: The robot cannot be reached, refuses a file, or takes too long.
        ConfigurationError: A value is given for a parameter that the protocol does not have.
        OSError: A file cannot be read.
    """
    inputs = inputs or Inputs()
    inputs.uploaded = {name: robot.upload_data(path) for name, path in inputs.files.items()}
    identifier, was_known = robot.upload(protocol, inputs.labware, inputs.values, inputs.uploaded)
    # Values and files make a new analysis by themselves.
    if was_known and not (inputs.values or inputs.uploaded):
        robot.analysis(identifier, timeout_s, waiting)
        robot.analyse_again(identifier)
    analysis = robot.analysis(identifier, timeout_s, waiting)
    given = (*inputs.values, *inputs.files)
    unknown = [name for name in given if name not in analysis.parameters]
    if unknown and (analysis.ok or analysis.parameters):  # else it has worse errors
        raise ConfigurationError(f"{protocol.name}: {undeclared(unknown, analysis.parameters)}")
    return identifier, analysis


def refuse_what_is_not_there(robot: RobotClient, analysis: Analysis) -> None:
    """Compare the deck that the protocol needs with the robot's own, before anything moves.

    Raises:
        RobotError: A module is not connected, or the deck is configured otherwise; each named.
    """
    needs = analysis.needs
    modules = robot.modules() if needs.modules else ()
    lacks = lacking(needs, modules, robot.deck_configuration() if analysis.flex else {})
    if lacks:
        raise RobotError(
            f"The protocol does not fit the robot's deck, and was not started. {' '.join(lacks)} "
            "Plug in what is missing, and set the deck configuration (in the Opentrons App or on "
            "the robot's screen) to what the deck really is."
        )


def take_offsets(
    robot: RobotClient, analysis: Analysis, inputs: Inputs, which: str
) -> Sequence[str]:
    """Settle which labware offsets the run has.

    Args:
        robot: Where it is to be.
        analysis: Of its protocol.
        inputs: Takes them down.
        which: ``"known"`` to the robot, ``"none"``, or a JSON file.

    Returns:
        What to show before the start.

    Raises:
        RobotError: The robot does not tell what it keeps.
        ConfigurationError: The file cannot be used.
    """
    if which == "none":
        inputs.offsets = ()
        return ["The run has no labware offsets."] if analysis.places else []
    if which == "known":
        found = known_offsets(robot, analysis.places, analysis.flex)
    else:
        found = offsets_in_file(Path(which), analysis.places)
    inputs.offsets = [offset.request for offset in found]
    return tell_offsets(found, analysis.places)
