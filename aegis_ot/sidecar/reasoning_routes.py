"""What the robot asks of a model through the sidecar: docs/reference/wire.md, "Opinions".

And what the sidecar's settings make of the model that they name: opinions for Layer 1, the VLM
gate for Layer 2.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from fastapi import APIRouter, Query, Request
from starlette.concurrency import run_in_threadpool

from ..errors import ConfigurationError
from ..llm import Backend, Opinions, load_prices, make_backend
from ..llm.gate_tiers import Budget, VlmTiers
from ..vision.gates import ConfirmingGate
from ..vocabulary import Dossier, Opinion, from_json, to_json
from .bodies import read_body
from .config import SidecarConfig
from .wire import MAX_WAIT, WireError

MAX_DOSSIER = 1024 * 1024
"""Longest dossier, bytes. One of a full 96-well protocol takes about 30 kB."""


def model_of(config: SidecarConfig) -> Backend | None:
    """The model that the settings name, if any.

    Raises:
        ConfigurationError: The name makes no sense.
    """
    settings = config.model
    if settings.name is None:
        return None
    return make_backend(settings.name, settings.record, settings.timeout_s)


def opinions_of(config: SidecarConfig) -> Opinions:
    """Opinions by the settings' model, kept in the sidecar's data folder.

    Raises:
        ConfigurationError: The model's name makes no sense.
    """
    return Opinions(model_of(config), config.data / "opinions")


def gates_of(config: SidecarConfig) -> Mapping[str, ConfirmingGate]:
    """The gates that need a model, if the cascade asks for them.

    Raises:
        ConfigurationError: The VLM is asked for and no model is named, or the prices that the
            user gave cannot be read.
    """
    if "vlm" not in config.cascade.gates:
        return {}
    backend = model_of(config)
    if backend is None:
        raise ConfigurationError(
            "The gate 'vlm' is asked for and no model is named. Set model.name (or "
            "AEGIS_OT_MODEL), or leave it out of cascade.gates."
        )
    settings = config.gate_model
    tiers = [backend]
    if settings.name is not None:
        tiers.insert(0, make_backend(settings.name, config.model.record, config.model.timeout_s))
    budget = Budget(settings.budget_per_run, settings.calls_per_run)
    return {"vlm": VlmTiers(tiers, load_prices(), budget)}


def opinion_router(opinions: Opinions) -> APIRouter:
    """The two routes."""
    router = APIRouter()

    @router.post("/v1/opinions")
    async def ask(request: Request) -> dict[str, Any]:
        dossier = _dossier(await read_body(request, MAX_DOSSIER))
        digest = await run_in_threadpool(opinions.ask, dossier)
        return _answer(digest, await run_in_threadpool(opinions.wait, digest, 0.0))

    @router.get("/v1/opinions/{digest}")
    async def wait(
        digest: str, wait: float = Query(default=0.0, ge=0, allow_inf_nan=False)
    ) -> dict[str, Any]:
        if not opinions.knows(digest):
            raise WireError(404, "opinion", "Nobody asked about this digest; post the dossier.")
        found = await run_in_threadpool(opinions.wait, digest, min(wait, MAX_WAIT))
        return _answer(digest, found)

    return router


def _dossier(body: bytes) -> Dossier:
    try:
        return from_json(Dossier, json.loads(body))
    except (ValueError, RecursionError) as error:
        raise WireError(422, "body", f"The body is not a valid dossier: {error}.") from None


def _answer(digest: str, opinion: Opinion | None) -> dict[str, Any]:
    return {"digest": digest, "opinion": None if opinion is None else to_json(opinion)}
