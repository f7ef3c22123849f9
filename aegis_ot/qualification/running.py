"""A qualification on simulated hardware: a real sidecar, and a camera that draws the faults."""

from __future__ import annotations

import secrets
from pathlib import Path
from typing import Any

from pydantic import SecretStr

from ..adapters.opentrons.rehearsal import Script, play
from ..errors import ConfigurationError
from ..guard import guard
from ..planted import planted
from ..sidecar import Analyser, SidecarConfig, make_analyser, running_sidecar
from ..sidecar.config import CascadeSettings
from ..simulation import SessionParameters, SimulatedCamera
from ..workbench.engines import engine_for, need_of
from .plan import QualificationPlan
from .protocol import protocol_text

TRUSTING = CascadeSettings(first_wells="trust")
"""The first deliveries are normal, as the plan has it: nobody has to be asked about them."""

FILE = "qualification.py"


def run_simulated(
    plan: QualificationPlan,
    data: Path,
    seed: int = 0,
    camera: SessionParameters | None = None,
    analyser: Analyser | None = None,
) -> str:
    """Run a plan in Opentrons' simulator, watched. Its frames are drawn.

    Args:
        plan: What is delivered and planted.
        data: Folder of the sidecar's store.
        seed: Of the camera's noise.
        camera: Where it stands, and the light; the recommended set-up if left out.
        analyser: The judge; by default with the shipped models.

    Returns:
        The run's name in the store.

    Raises:
        ConfigurationError: The protocol needs an ``opentrons`` that is not beside this package.
    """
    if engine_for(need_of(protocol_text(plan))).python:
        raise ConfigurationError(
            "No opentrons for this robot is installed beside aegis-ot; it simulates the run."
        )
    run, token = f"qualification-{secrets.token_hex(4)}", secrets.token_urlsafe(16)
    shown = SimulatedCamera(seed, plan.faults(), camera or SessionParameters.bench(seed))
    config = SidecarConfig(port=0, token=SecretStr(token), data=data, cascade=TRUSTING, audit=False)
    with running_sidecar(config, shown, analyser or make_analyser(TRUSTING)) as url:
        settings = {"sidecar": url, "token": token, "run_id": run, "watch_simulation": True}

        def watched(protocol: Any) -> Any:
            # The text is the one that was written: the record has its digest.
            return planted(plan.to_json())(guard(protocol, **settings))

        play(Script(protocol_text(plan), FILE), watched)
    return run
