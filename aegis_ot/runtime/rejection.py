"""Tells the sidecar of a run that Layer 1 did not let begin: its page is where people look."""

from __future__ import annotations

import uuid
from collections.abc import Mapping
from typing import Any

from ..adapters.opentrons.run_state import RunState
from ..errors import LinkError
from ..settings import Settings
from .cancellation import CancellationToken, Stopping
from .descriptions import about_guard, about_run
from .sidecar_client import SidecarClient

_REQUEST_S = 1.0


def tell_of_rejection(
    protocol: Any, settings: Settings, file_name: str, layer1: Mapping[str, Any] | None, reason: str
) -> None:
    """Register a run that ends before it begins; a sidecar that is away changes nothing.

    Args:
        protocol: The context.
        settings: In force.
        file_name: ``co_filename`` of the protocol's code.
        layer1: What Layer 1 says, in words for the page.
        reason: Why it does not begin.
    """
    simulating = bool(protocol.is_simulating())
    if settings.sidecar is None or (simulating and not settings.watch_simulation):
        return
    run = settings.new_run_id()
    about = about_run(protocol, run, file_name, simulating)
    about |= {"guard": about_guard(settings), "layer1": layer1}
    check = CancellationToken(RunState(protocol)).check
    link = SidecarClient(settings.sidecar, settings.token, check, uuid.uuid4().hex)
    try:
        run = link.start(run, about, _REQUEST_S)
        nothing = {"trajectories": 0, "keyframes": 0}
        link.finish(run, "failed", reason[:2000], _REQUEST_S, nothing)
    except (LinkError, Stopping):
        pass
    finally:
        link.close()
