"""The token that a sidecar keeps in its data folder."""

from __future__ import annotations

import os
import secrets
from pathlib import Path

from ..errors import ConfigurationError

TOKEN_FILE = "token"


def kept_token(data: Path) -> str:
    """The token that is kept in a data folder; one is made the first time.

    Raises:
        ConfigurationError: It cannot be read or written.
    """
    path = data / TOKEN_FILE
    try:
        if path.exists():
            return path.read_text(encoding="ascii").strip()
        data.mkdir(0o700, parents=True, exist_ok=True)
        token = secrets.token_urlsafe(24)
        with os.fdopen(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w") as file:
            file.write(token + "\n")
    except (OSError, UnicodeDecodeError) as error:
        raise ConfigurationError(f"The token in {path} cannot be kept: {error}.") from error
    return token


def known_token(data: Path) -> str:
    """The token that is kept in a data folder, or one for nothing: for who does not listen."""
    return kept_token(data) if (data / TOKEN_FILE).exists() else secrets.token_urlsafe(24)
