"""Settings of the sidecar: arguments over environment variables over a JSON or TOML file."""

from __future__ import annotations

import ipaddress
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal
from urllib.parse import urlsplit

from platformdirs import user_data_path
from pydantic import (
    BaseModel,
    ConfigDict,
    Field,
    SecretStr,
    ValidationError,
    field_validator,
    model_validator,
)

from ..errors import ConfigurationError
from ..vocabulary import Gate
from .settings_file import explain, merge, nest, read_settings_file

DEFAULT_PORT = 7645
LEAST_TOKEN = 16
"""Characters of a token, so that it cannot be guessed."""

ENVIRONMENT = {
    "AEGIS_OT_SIDECAR_HOST": ("host",),
    "AEGIS_OT_SIDECAR_PORT": ("port",),
    "AEGIS_OT_SIDECAR_TOKEN": ("token",),
    "AEGIS_OT_SIDECAR_DATA": ("data",),
    "AEGIS_OT_SIDECAR_CAMERA": ("camera", "spec"),
    "AEGIS_OT_SIDECAR_NOTIFY": ("notifications", "urls"),
    "AEGIS_OT_SIDECAR_WEBHOOK": ("webhook", "url"),
    "AEGIS_OT_SIDECAR_WEBHOOK_SECRET": ("webhook", "secret"),
    "AEGIS_OT_SIDECAR_URL": ("url",),
    "AEGIS_OT_SIDECAR_LOG": ("log",),
    "AEGIS_OT_MODEL": ("model", "name"),
    "AEGIS_OT_MODEL_RECORD": ("model", "record"),
}
"""Environment variables and the settings they give; notification URLs are parted by spaces."""


class Section(BaseModel):
    """Base of every section: unknown names are errors, values cannot change later."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class CameraSettings(Section):
    """Which camera, and how long to wait for it.

    Attributes:
        spec: ``usb:0``, ``usb:/dev/v4l/by-id/...`` (the same camera in any socket),
            ``http://...`` (MJPEG stream or snapshot), ``rtsp://...``, ``folder:PATH``,
            ``video:PATH``, ``robot:http://...`` (the robot's own camera), ``pattern`` (test
            pattern) or ``simulated``.
        timeout_s: How long a keyframe waits for a frame before it is refused, s.
        latency_s: Longest time from the start of an exposure to the frame's arrival here, s;
            a frame counts as exposed that long before it arrived. ``None``: the default of the
            kind of camera.
        width, height: What a USB camera is asked for, px; ``None``: its own default.
        fps: What a USB camera or the test pattern is asked for, frames/s.
        lock: Keep a USB camera's exposure, white balance and focus at what its automatic found
            in its first second, where the driver allows.
        exposure, white_balance, focus: Set so instead, in the driver's own units.
        watch_view: Hold the run while the camera is frozen, covered, dark, blown out, blurred or
            misaimed.
    """

    spec: Annotated[str, Field(repr=False)] = "usb:0"
    timeout_s: Annotated[float, Field(gt=0, le=30)] = 2.0
    latency_s: Annotated[float, Field(ge=0, le=5)] | None = None
    width: Annotated[int, Field(ge=16, le=10_000)] | None = None
    height: Annotated[int, Field(ge=16, le=10_000)] | None = None
    fps: Annotated[float, Field(gt=0, le=240)] = 30.0
    lock: bool = False
    exposure: float | None = None
    white_balance: float | None = None
    focus: float | None = None
    watch_view: bool = True


class BoundCameraSettings(CameraSettings):
    """One of several cameras: ``[[cameras]]`` in a file.

    Attributes:
        robot: Name of the robot that it looks at; empty: any.
        mount: ``left`` or ``right``; empty: both.
    """

    robot: str = ""
    mount: Literal["", "left", "right"] = ""


class CascadeSettings(Section):
    """Which models judge, and when a well goes to a gate.

    Attributes:
        model: Fitted scorer of the lab, from ``aegis-ot fit``; ``None``: the shipped one, fitted
            on simulated normal wells, or with the preset ``paper`` a PCA of each run's own first
            wells.
        detector: Tip detector (ONNX); ``None``: the shipped one.
        preset: Calibration to start from: ``default``, or ``paper``.
        calibration_wells: How many first wells calibrate a run; ``None``: the preset's (6).
        band: Half-width of the silent-pass band in MADs; ``None``: the preset's (paper: 0.7,
            which sends most normal wells to the gate; the default is wider).
        blank_floor: Scores below it are a blank view; ``None``: the preset's (1e-4).
        always_gate: Send every well after calibration to the gates.
        first_wells: ``ask``: the operator looks at a first well in which no liquid is seen to leave
            the tip; ``trust``: it is taken for normal.
        gates: Asked in this order, the operator after them: ``volumetric``, ``vlm``.
        spot_check: Share of the wells that pass silently that the gate ``vlm`` sees all the same,
            0 to 1; with any of it, it also sees the first wells of each liquid and those near the
            band. 0: only what was flagged.
        first_channel: On which side of the frame a multi-channel pipette's first channel (``A1``)
            is: ``left``, ``right``, or ``auto``: a column's is the far one, and the left one where
            the row is seen squarely.
    """

    model: Path | None = None
    detector: Path | None = None
    preset: Literal["default", "paper"] = "default"
    calibration_wells: Annotated[int, Field(ge=2, le=48)] | None = None
    band: Annotated[float, Field(gt=0, le=100)] | None = None
    blank_floor: Annotated[float, Field(ge=0)] | None = None
    always_gate: bool = False
    first_wells: Literal["ask", "trust"] = "ask"
    gates: tuple[str, ...] = ("volumetric",)
    spot_check: Annotated[float, Field(ge=0, le=1)] = 0.05
    first_channel: Literal["auto", "left", "right"] = "auto"

    @field_validator("gates")
    @classmethod
    def _known_gates(cls, value: tuple[str, ...]) -> tuple[str, ...]:
        known = [gate.value for gate in Gate if gate.traits.may_be_asked_for]
        unknown = sorted(set(value).difference(known))
        if unknown:
            raise ValueError(f"unknown gate {unknown[0]!r}; use {' or '.join(known)}")
        return value


class OperatorSettings(Section):
    """The operator as a gate.

    Attributes:
        timeout_s: How long an undecided verdict is held back for the operator before the robot
            is told that it is undecided, s. 0: told at once.
    """

    timeout_s: Annotated[float, Field(ge=0, le=3600)] = 0.0


class NotificationSettings(Section):
    """Who is told of fails, undecided wells and trouble: Apprise URLs."""

    urls: tuple[SecretStr, ...] = ()

    @field_validator("urls", mode="before")
    @classmethod
    def _split(cls, value: Any) -> Any:
        return tuple(value.split()) if isinstance(value, str) else value


class WebhookSettings(Section):
    """Where the record of a run goes when it has ended: an ELN or LIMS.

    Attributes:
        url: ``http://`` or ``https://`` address that takes a POST; ``None``: nothing is sent.
        secret: Signs what is sent (HMAC-SHA-256); required with ``url``, at least 16 characters.
    """

    url: SecretStr | None = None
    secret: SecretStr | None = None

    @model_validator(mode="after")
    def _usable(self) -> WebhookSettings:
        if self.url is None:
            return self
        url = urlsplit(self.url.get_secret_value())
        if url.scheme not in ("http", "https") or not url.hostname:
            raise ValueError("the web hook's url must begin with http:// or https://")
        if self.secret is None or len(self.secret.get_secret_value()) < LEAST_TOKEN:
            raise ValueError(
                f"the web hook needs a secret of at least {LEAST_TOKEN} characters, so that who "
                "receives a record can tell that it is yours"
            )
        return self


class RetentionSettings(Section):
    """How long runs are kept; a run that has not ended is never removed.

    Attributes:
        days: Remove runs that ended longer ago, in days that the sidecar was at work; ``None``:
            never.
        gigabytes: Remove the oldest runs while all frames take more; ``None``: never.
        silent_h: A robot that said nothing for so long has ended its run without a word, in hours
            that the sidecar was at work.
    """

    days: Annotated[float, Field(gt=0)] | None = None
    gigabytes: Annotated[float, Field(gt=0)] | None = None
    silent_h: Annotated[float, Field(gt=0)] = 24.0


class ModelSettings(Section):
    """The language or vision model, if there is one. Keys come from the environment alone.

    Attributes:
        name: ``anthropic:MODEL``, ``openai:MODEL@URL`` or ``replay:FOLDER``; ``None``: no model.
        record: Folder to keep requests and answers in.
        timeout_s: From a question to its answer, retries included, s.
    """

    name: Annotated[str, Field(min_length=1)] | None = None
    record: Path | None = None
    timeout_s: Annotated[float, Field(gt=0, le=600)] = 60.0


class GateModelSettings(Section):
    """The vision model as a gate of Layer 2.

    Attributes:
        name: A smaller model that is asked first, named as ``model.name`` is; that one is asked
            where it is unsure. ``None``: ``model.name`` at once.
        budget_per_run: What a run may cost, in the currency of the price table; ``None``: no limit.
            When it is spent, flagged wells go to the operator.
        calls_per_run: How often a model may be asked in a run; ``None``: no limit.
    """

    name: Annotated[str, Field(min_length=1)] | None = None
    budget_per_run: Annotated[float, Field(ge=0)] | None = None
    calls_per_run: Annotated[int, Field(ge=0)] | None = None


class SidecarConfig(Section):
    """All settings of a sidecar. Use :meth:`load` for errors meant for people.

    Attributes:
        host: Address to listen on; loopback unless told otherwise.
        port: TCP port; 0 takes a free one.
        token: Bearer token; required when ``host`` is not loopback, with at least 16 characters.
        data: Folder of the store; the user's data folder by default.
        cameras: Several cameras, each bound to a robot and mount, instead of the one.
        audit: Look back at each run when it has ended: read every well again with what the whole
            run tells, and rank its silent passes.
        log: Form of the log on standard error: for people, or a JSON object a line.
        url: Where people open the page, for links in messages; ``None``: as it listens.
    """

    host: str = "127.0.0.1"
    port: Annotated[int, Field(ge=0, le=65535)] = DEFAULT_PORT
    token: SecretStr | None = None
    data: Path = Field(default_factory=lambda: default_data())
    camera: CameraSettings = CameraSettings()
    cameras: tuple[BoundCameraSettings, ...] = ()
    cascade: CascadeSettings = CascadeSettings()
    operator: OperatorSettings = OperatorSettings()
    notifications: NotificationSettings = NotificationSettings()
    webhook: WebhookSettings = WebhookSettings()
    model: ModelSettings = ModelSettings()
    gate_model: GateModelSettings = GateModelSettings()
    retention: RetentionSettings = RetentionSettings()
    audit: bool = True
    log: Literal["text", "json"] = "text"
    url: str | None = None

    @field_validator("token")
    @classmethod
    def _usable_token(cls, value: SecretStr | None) -> SecretStr | None:
        text = "" if value is None else value.get_secret_value()
        if value is not None and not text:
            raise ValueError("the token is empty; leave it out, or give one")
        # http.client writes headers as latin-1 and refuses control characters.
        if not all(33 <= ord(character) < 127 for character in text):
            raise ValueError("the token may hold only printable ASCII characters and no spaces")
        return value

    @model_validator(mode="after")
    def _no_open_door(self) -> SidecarConfig:
        if self.token is None and not is_loopback(self.host):
            raise ValueError(
                f"refusing to listen on {self.host} without a token: anyone on the network could "
                "read frames and decide wells. Set a token (AEGIS_OT_SIDECAR_TOKEN), or listen "
                "on 127.0.0.1"
            )
        if self.token is not None and not is_loopback(self.host):
            length = len(self.token.get_secret_value())
            if length < LEAST_TOKEN:
                raise ValueError(
                    f"the token has {length} characters; on a network it needs at least "
                    f"{LEAST_TOKEN}. Leave it out, and one is made"
                )
        return self

    @classmethod
    def load(
        cls,
        path: str | Path | None = None,
        environ: Mapping[str, str] | None = None,
        find_token: Callable[[Path], str] | None = None,
        **overrides: Any,
    ) -> SidecarConfig:
        """Read a file, then the environment, then ``overrides``; later ones win.

        Args:
            path: JSON or TOML (by its suffix); ``None``: no file.
            environ: Defaults to the environment of this process.
            find_token: Finds or makes one in the data folder, where one is needed and none is
                given.
            overrides: Settings by name; sections as mappings; ``None`` means "not given".

        Raises:
            ConfigurationError: Naming the setting and what is wrong with it.
        """
        values = read_settings_file(Path(path)) if path is not None else {}
        environ = os.environ if environ is None else environ
        for variable, place in ENVIRONMENT.items():
            if environ.get(variable):
                merge(values, nest(place, environ[variable]))
        merge(values, {name: value for name, value in overrides.items() if value is not None})
        host = str(values.get("host") or "127.0.0.1")
        if find_token is not None and not values.get("token") and not is_loopback(host):
            values["token"] = find_token(Path(values.get("data") or default_data()))
        try:
            return cls.model_validate(values)
        except ValidationError as error:
            raise ConfigurationError(explain(error, cls)) from None


def default_data() -> Path:
    """The user's data folder for this program."""
    return user_data_path("aegis-ot", appauthor=False)


def is_loopback(host: str) -> bool:
    """Whether only this machine can reach ``host``. Names other than localhost are not trusted."""
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host.strip("[]")).is_loopback
    except ValueError:
        return False
