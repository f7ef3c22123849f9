"""Keys come from the environment, and go to the service that they belong to, nowhere else."""

from __future__ import annotations

import os
import re

GENERIC = "AEGIS_OT_LLM_API_KEY"
"""Key for an OpenAI-compatible server that has no variable of its own."""


def key_from(names: tuple[str, ...]) -> str:
    """The first of these variables that is set, or ``""``."""
    for name in names:
        value = os.environ.get(name, "").strip()
        if value:
            return value
    return ""


def is_sendable(key: str) -> bool:
    """Whether a key can be a header's value: what is not stops in the HTTP client's log."""
    return key.isascii() and key.isprintable() and " " not in key


def without(secret: str, text: str) -> str:
    """``text`` without ``secret``, and without what looks like part of a key.

    Some services repeat the key, whole or in part, in the error that refuses it.
    """
    if secret and len(secret) >= 4:
        text = text.replace(secret, "[key]")
    return re.sub(r"\b(?:sk|nvapi|key)-[A-Za-z0-9_*.-]{4,}", "[key]", text)
