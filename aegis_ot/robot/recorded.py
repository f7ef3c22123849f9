"""What a run on a robot really did, as an analysis tells what a protocol would do."""

from __future__ import annotations

from typing import Any

from .client import RobotClient

_LOADING = ("load", "flexStacker/retrieve")


def recorded_run(robot: RobotClient, run: str) -> dict[str, Any]:
    """The commands of a run, those that load something with their results.

    Raises:
        RobotError: The robot does not answer, or keeps no such run.
    """
    view = robot.run(run)
    commands: list[dict[str, Any]] = []
    while True:
        page = robot.commands(run, len(commands))
        for one in page.commands:
            loads = one.kind.startswith(_LOADING) and one.status == "succeeded"
            commands.append(
                {
                    "commandType": one.kind,
                    "status": one.status,
                    "params": one.params,
                    "result": robot.result(run, one.id) if loads else {},
                }
            )
        if not page.commands or len(commands) >= page.total:
            break
    return {
        "status": view.status,
        "commands": [one for one in commands if one["status"] != "queued"],
        "liquids": [{"id": key, "displayName": name} for key, name in view.liquids.items()],
        "config": {"apiVersion": robot.api_level(run)},
    }
