"""World models as files: arrays and a JSON description with a checksum, never a pickle.

A model file is a NumPy ``.npz`` archive that is read with ``allow_pickle=False``. Its entry
``description`` holds JSON: format, version, kind of model, settings, the data that made it, the
package version and a SHA-256 over every array's name, type, shape and bytes.
"""

from __future__ import annotations

import hashlib
import io
import json
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._version import __version__
from ..errors import ModelError

FORMAT = "aegis-ot-model"
VERSION = 1
MOST_BYTES = 256 * 1024 * 1024
"""Largest model file that is read: a damaged header must not fill the memory."""

SHIPPED = Path(__file__).with_name("world") / "simulated.npz"
"""The ensemble fitted on simulated normals; ``aegis_ot_lab.shipped_model`` makes it."""

Arrays = Mapping[str, NDArray[Any]]


@dataclass(frozen=True)
class ModelFile:
    """What a model file holds.

    Attributes:
        kind: Which scorer it belongs to, ``"pca"``.
        arrays: Numeric arrays by name.
        settings: Settings of the scorer.
        data: What it was fitted on: source, names, number of trajectories.
        package: Version of ``aegis_ot`` that wrote it.
        checksum: SHA-256 of the arrays, hexadecimal.
    """

    kind: str
    arrays: dict[str, NDArray[Any]]
    settings: dict[str, Any] = field(default_factory=dict)
    data: dict[str, Any] = field(default_factory=dict)
    package: str = __version__
    checksum: str = ""


def save_model(
    path: str | Path,
    kind: str,
    arrays: Arrays,
    settings: Mapping[str, Any],
    data: Mapping[str, Any],
) -> ModelFile:
    """Write a model file and return what it holds.

    Raises:
        ModelError: If an array is not numeric, or the file cannot be written.
    """
    kept = {name: np.ascontiguousarray(array) for name, array in arrays.items()}
    for name, array in kept.items():
        if array.dtype.kind not in "fiub" or name == "description":
            raise ModelError(f"{name!r} of type {array.dtype} cannot stand in a model file")
    checksum = _checksum(kept)
    description = {
        "format": FORMAT,
        "version": VERSION,
        "kind": kind,
        "settings": dict(settings),
        "data": dict(data),
        "package": __version__,
        "sha256": checksum,
    }
    text = json.dumps(description, ensure_ascii=False, sort_keys=True).encode()
    buffer = io.BytesIO()
    np.savez_compressed(
        buffer,
        description=np.frombuffer(text, dtype=np.uint8),
        **kept,
    )
    path = Path(path)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        partial = path.with_name(path.name + ".part")
        partial.write_bytes(buffer.getvalue())
        partial.replace(path)
    except OSError as error:
        raise ModelError(f"{path}: the model cannot be written ({error})") from error
    return ModelFile(kind, kept, dict(settings), dict(data), __version__, checksum)


def load_model(path: str | Path, kind: str | None = None) -> ModelFile:
    """Read and verify a model file.

    Args:
        path: The file.
        kind: The kind that is wanted, if any.

    Raises:
        ModelError: If it is missing, damaged, of another version, or of another kind.
    """
    path = Path(path)
    try:
        if path.stat().st_size > MOST_BYTES:
            raise ModelError(f"{path}: too large for a model file")
        with zipfile.ZipFile(path) as archive:
            unpacked = sum(entry.file_size for entry in archive.infolist())
        if unpacked > MOST_BYTES:
            raise ModelError(f"{path}: too large for a model file once unpacked")
        with np.load(path, allow_pickle=False) as entries:
            arrays = {name: np.asarray(entries[name]) for name in entries.files}
        description = json.loads(arrays.pop("description").tobytes().decode())
    except FileNotFoundError:
        raise ModelError(f"{path}: there is no such model file; fit one or name another") from None
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile, RecursionError) as error:
        raise ModelError(
            f"{path}: this is no model file, or it is damaged ({error}); fit it anew"
        ) from error
    except Exception as error:
        # zlib and zipfile raise types of their own on damaged archives.
        raise ModelError(f"{path}: the model file is damaged ({error}); fit it anew") from error
    if not isinstance(description, dict) or description.get("format") != FORMAT:
        raise ModelError(f"{path}: this is no model file of this package")
    if description.get("version") != VERSION:
        raise ModelError(
            f"{path}: format version {description.get('version')!r}, this package reads {VERSION}; "
            "fit the model anew"
        )
    if description.get("sha256") != _checksum(arrays):
        raise ModelError(f"{path}: the checksum does not match, the file is damaged; fit it anew")
    if kind is not None and description.get("kind") != kind:
        raise ModelError(f"{path}: holds a {description.get('kind')!r} model, wanted {kind!r}")
    return ModelFile(
        str(description["kind"]),
        arrays,
        _mapping(description.get("settings")),
        _mapping(description.get("data")),
        str(description.get("package", "")),
        str(description["sha256"]),
    )


def _mapping(value: Any) -> dict[str, Any]:
    return dict(value) if isinstance(value, dict) else {}


def _checksum(arrays: Arrays) -> str:
    digest = hashlib.sha256()
    for name in sorted(arrays):
        array = np.ascontiguousarray(arrays[name])
        digest.update(f"{name}|{array.dtype.str}|{array.shape}|".encode())
        digest.update(array.tobytes())
    return digest.hexdigest()
