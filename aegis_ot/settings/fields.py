"""What can be set, and what it is unless it is set."""

from __future__ import annotations

import uuid
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from urllib.parse import quote


@dataclass(frozen=True)
class Settings:
    """All that can be set, with its defaults.

    Attributes:
        assay: Assay family, several as ``"serial_dilution, generic"``, or ``None`` to let the
            guard find out. Families of your own rule files are accepted as well.
        rules: ``"on"``: errors refuse the run, and so does a rehearsal that fails or takes too
            long; ``"strict"``: warnings are errors; ``"warn"``: all of this is reported, and the
            run goes on; ``"off"``.
        select: Rule ids to use; empty for all.
        ignore: Rule ids to leave out.
        rules_path: Folder or file of further rules.
        roles: What wells are for, the guard's own evidence: role to wells, each written
            ``"label-or-slot:well"``, as in ``{"ntc": ["plate:H12"]}``; with a concentration or
            dose where one decides, ``{"standard": ["4:A1 = 2 mg/mL"]}``; ``[]`` if no well has it.
        sidecar: Address of the sidecar, ``"http://192.168.1.20:7645"``; ``None`` for Layer 1
            alone.
        token: Bearer token that the sidecar expects, or ``None``.
        robot_token: Bearer token for the robot's own API, where its access is controlled.
        robot_reason: What such a robot is given as the reason of all that changes it, for its log;
            that aegis-ot guards the run if ``None``.
        hold: ``"boundary"``, ``"well"`` or ``"off"``; see ``docs/reference/keyframes.md``.
        on_fail: What a failed well does, and a step that was not rehearsed and breaks a rule:
            ``"pause"``, ``"continue"`` or ``"abort"``.
        on_undecided: The same for a well that no gate could settle.
        on_link_loss: The same for a sidecar that is away, refuses, answers nonsense, or gives
            no frame or no verdict in time.
        recover: What the robot does by itself about a failed well before ``on_fail`` is asked: kind
            of failure to action, as in ``{"no_aspirate": "retry", "partial_dispense": "top_up"}``;
            see ``docs/how-to/recovery.md``.
        recover_limit: Most recoveries of one well.
        recover_run_limit: Most recoveries of one run.
        watch_simulation: Whether Layer 2 also acts in simulation.
        lift: Whether moves to the top of the well are inserted for two of the keyframes.
        capture_timeout_s: Longest wait for one keyframe, retries included, s.
        verdict_timeout_s: Longest hold for verdicts at one boundary, s.
        rehearsal_timeout_s: Longest rehearsal of the protocol, s.
        opinion: ``"ask"``: the sidecar's model, if it has one, is asked about the protocol as
            well; it can add findings and takes none away. ``"off"``.
        opinion_timeout_s: Longest wait of an analysis for it, s; a live run takes what is
            remembered.
        run_id: Identifier of the run; a fresh one if ``None``.
    """

    assay: str | None = None
    rules: str = "on"
    select: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()
    rules_path: str | None = None
    roles: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    sidecar: str | None = None
    token: str | None = field(default=None, repr=False)
    robot_token: str | None = field(default=None, repr=False)
    robot_reason: str | None = None
    hold: str = "boundary"
    on_fail: str = "pause"
    on_undecided: str = "pause"
    on_link_loss: str = "pause"
    recover: Mapping[str, str] = field(default_factory=dict)
    recover_limit: int = 2
    recover_run_limit: int = 8
    watch_simulation: bool = False
    lift: bool = True
    capture_timeout_s: float = 10.0
    verdict_timeout_s: float = 60.0
    rehearsal_timeout_s: float = 600.0
    opinion: str = "off"
    opinion_timeout_s: float = 20.0
    run_id: str | None = None

    def new_run_id(self) -> str:
        """The configured identifier, or a fresh one."""
        return self.run_id or uuid.uuid4().hex

    def robot_headers(self) -> dict[str, str]:
        """What a request to the robot's own API carries.

        A robot whose access is controlled wants a reason in ``Opentrons-User-Notes``, as
        percent-encoded UTF-8 (Opentrons' robot server 10).
        """
        headers = {"Opentrons-Version": "*"}
        if self.robot_token:
            headers["Authorization"] = f"Bearer {self.robot_token}"
            headers["Opentrons-User-Notes"] = quote(self.robot_reason or "aegis-ot guards this run")
        return headers


NAMES = tuple(f.name for f in fields(Settings))
