"""The key with which a sidecar signs its records: Ed25519, in a file of the data folder."""

from __future__ import annotations

import contextlib
import os
import secrets
from pathlib import Path
from typing import TYPE_CHECKING

from ...errors import StoreError

if TYPE_CHECKING:
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey

KEY_FILE = "signing.key"


class Signer:
    """Signs with the key of a data folder; one is made the first time.

    Raises:
        StoreError: The key cannot be read or written.
    """

    def __init__(self, folder: Path) -> None:
        self._key = _read(folder) or _make(folder)
        self.public = self._key.public_key().public_bytes_raw().hex()

    def sign(self, message: bytes) -> str:
        """The signature, hexadecimal."""
        return self._key.sign(message).hex()


def public_key(folder: Path) -> str | None:
    """The public half of a folder's key, hexadecimal; ``None`` where there is no key.

    Raises:
        StoreError: It cannot be read.
    """
    key = _read(folder)
    return None if key is None else key.public_key().public_bytes_raw().hex()


def is_signed(public: str, signature: str, message: bytes) -> bool:
    """Whether the holder of a key signed the message."""
    from cryptography.exceptions import InvalidSignature
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PublicKey

    try:
        key = Ed25519PublicKey.from_public_bytes(bytes.fromhex(public))
        key.verify(bytes.fromhex(signature), message)
    except (InvalidSignature, ValueError, TypeError):
        return False
    return True


def _read(folder: Path) -> Ed25519PrivateKey | None:
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey

    path = folder / KEY_FILE
    try:
        return Ed25519PrivateKey.from_private_bytes(bytes.fromhex(path.read_text("ascii")))
    except FileNotFoundError:
        return None
    except OSError as error:
        raise StoreError(f"The signing key {path} cannot be read: {error.strerror}.") from error
    except ValueError as error:
        raise StoreError(
            f"The signing key {path} is damaged. Restore it from a backup, or move it away: then a "
            "new key signs, and records that the old one signed are checked with --key."
        ) from error


def _write_new(path: Path, text: str) -> None:
    with os.fdopen(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w") as file:
        file.write(text)
        file.flush()
        os.fsync(file.fileno())


def _make(folder: Path) -> Ed25519PrivateKey:
    path = folder / KEY_FILE
    partial = path.with_suffix(f".{secrets.token_hex(4)}")
    text = secrets.token_hex(32)
    try:
        _write_new(partial, text)
        # Of two processes that make one, the first one's stays.
        with contextlib.suppress(FileExistsError):
            try:
                os.link(partial, path)
            except FileExistsError:
                raise
            except OSError:  # exFAT, some network shares: no hard links
                _write_new(path, text)
    except OSError as error:
        raise StoreError(f"The signing key {path} cannot be written: {error.strerror}.") from error
    finally:
        partial.unlink(missing_ok=True)
    key = _read(folder)
    if key is None:
        raise StoreError(f"The signing key {path} vanished while it was made.")
    return key
