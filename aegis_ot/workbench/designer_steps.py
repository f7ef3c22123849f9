"""Which step of Protocol Designer a command belongs to, as far as the file tells it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class DesignerStep:
    """A step of Protocol Designer, or a group of steps of an analysis.

    Attributes:
        name: As the file calls it.
        number: From 1, in the order of the file; ``None`` where its groups are not Designer's own
            steps one by one.
    """

    name: str
    number: int | None = None

    def __str__(self) -> str:
        return f"step {self.number} ({self.name})" if self.number else f'step "{self.name}"'


def steps_of(file: Mapping[str, Any], commands: list[Mapping[str, Any]]) -> dict[int, DesignerStep]:
    """The step of each command, by the command's number from 1; those without one are left out."""
    told = [one for one in file.get("commandAnnotations") or () if isinstance(one, Mapping)]
    designer = (file.get("designerApplication") or {}).get("data") or {}
    ordered = designer.get("orderedStepIds") or ()
    numbered = not ordered or len(ordered) == len(told)
    by_key: dict[str, DesignerStep] = {}
    for number, one in enumerate(told, start=1):
        names = ("userSpecifiedName", "name", "machineReadableName", "annotationType")
        name = next((str(one[key]) for key in names if one.get(key)), "unnamed")
        step = DesignerStep(name, number if numbered else None)
        # The older form names its commands; in the newer one the commands name their groups.
        keys = [one.get("id"), *(one.get("commandKeys") or one.get("commandIds") or ())]
        by_key |= {str(key): step for key in keys if key}
    found: dict[int, DesignerStep] = {}
    for number, command in enumerate(commands, start=1):
        own = (*(command.get("commandAnnotationIds") or ()), command.get("key"), command.get("id"))
        for key in own:
            if key in by_key:
                found.setdefault(number, by_key[key])
    return found
