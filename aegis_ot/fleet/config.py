"""``fleet.toml``: the robots, what each has, and where the agents meet."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError, field_validator, model_validator

from ..errors import ConfigurationError
from ..sidecar.settings_file import read_settings_file
from .jobs import JobNeeds

EXCHANGE_VARIABLE = "AEGIS_OT_FLEET_EXCHANGE"
"""Says where the agents meet, over the file: an address may hold a password."""


class RobotConfig(BaseModel):
    """One robot.

    Attributes:
        name: How people call it; unique.
        address: Of a real one, as for ``aegis-ot run --robot``; without it, it is simulated.
        robot_type: ``"OT-2"`` or ``"Flex"``.
        pipettes: Opentrons pipette name by mount, ``{left = "p300_single_gen2"}``.
        modules: Opentrons module names that stand on its deck.
        labware: Load names that can be put on it; left out: any.
        remote: Its agent is served elsewhere (``aegis-ot fleet serve``) and found by its name.
        sidecar, token_variable: Of a real robot's sidecar, and the variable with its token.
        offsets: ``"known"``: a job runs with the labware offsets that a real robot keeps;
            ``"none"``: without any.
        seed: Of a simulated robot's camera.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    name: str = Field(min_length=1, max_length=60)
    address: str | None = None
    robot_type: Literal["OT-2", "Flex"] = "OT-2"
    pipettes: Mapping[Literal["left", "right"], str] = {}
    modules: tuple[str, ...] = ()
    labware: tuple[str, ...] | None = None
    remote: bool = False
    sidecar: str | None = None
    token_variable: str = "AEGIS_OT_TOKEN"
    offsets: Literal["known", "none"] = "known"
    seed: int = 0

    @field_validator("modules")
    @classmethod
    def _models(cls, names: tuple[str, ...]) -> tuple[str, ...]:
        """Whatever name Opentrons takes for a module, as its model."""
        from opentrons.protocol_api.validation import ensure_module_model

        try:
            return tuple(str(ensure_module_model(name).value) for name in names)
        except Exception as error:
            raise ValueError(str(error)) from None

    @property
    def simulated(self) -> bool:
        """Whether there is no real robot behind it."""
        return self.address is None

    def lacks(self, needs: JobNeeds) -> list[str]:
        """What this robot has not, in words; empty: it can run the protocol."""
        if needs.robot_type != self.robot_type:
            return [f"it is an {self.robot_type}, not a {needs.robot_type}"]
        here = dict(self.pipettes)
        missing = [
            f"{name} on the {mount} mount"
            for mount, name in needs.pipettes.items()
            if here.get(mount) != name  # type: ignore[call-overload]
        ]
        missing += sorted((Counter(needs.modules) - Counter(self.modules)).elements())
        if self.labware is not None:
            missing += sorted(needs.labware - set(self.labware))
        return missing


class FleetConfig(BaseModel):
    """A fleet.

    Attributes:
        exchange: Where agents meet: ``"local"`` (this process), ``"redis://host:port"`` (with
            ``user:password@`` before it, or ``rediss`` for TLS) or ``"http://host:port"``.
        dead_after_s: A robot's agent that does not answer for so long is lost, s.
        robot: The robots.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    exchange: str = "local"
    dead_after_s: float = Field(default=30.0, gt=0)
    robot: tuple[RobotConfig, ...] = Field(min_length=1)

    @model_validator(mode="after")
    def _check(self) -> FleetConfig:
        twice = [name for name, n in Counter(r.name for r in self.robot).items() if n > 1]
        if twice:
            raise ValueError(f"two robots are called {twice[0]!r}")
        if self.exchange == "local" and any(robot.remote for robot in self.robot):
            raise ValueError("a remote robot needs an exchange that both hosts reach")
        return self

    @classmethod
    def load(cls, path: Path, environ: Mapping[str, str] = os.environ) -> FleetConfig:
        """Read a file.

        Raises:
            ConfigurationError: It cannot be read or used; the message names the entry.
        """
        values = read_settings_file(path)
        if environ.get(EXCHANGE_VARIABLE):
            values["exchange"] = environ[EXCHANGE_VARIABLE]
        try:
            return cls(**values)
        except ValidationError as error:
            first = error.errors()[0]
            where = ".".join(str(part) for part in first["loc"])
            text = str(first["msg"]).removeprefix("Value error, ")
            raise ConfigurationError(f"{path}: {where + ': ' if where else ''}{text}.") from None
