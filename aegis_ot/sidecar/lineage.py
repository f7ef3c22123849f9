"""The lineage of a run's wells, from the store: as a document, and as a folder to file."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from ..errors import StoreError
from ..reports.lineage_files import CRATE, lineage_csv, ro_crate
from ..run_view.lineage import lineage_of
from .overview import run_overview
from .store import Store
from .store.chain import sha256


def lineage_document(store: Store, run: str) -> dict[str, Any]:
    """See :func:`.lineage_of`; and under ``record`` the newest hash of the
    run's chain, its number, and who signed it (``None`` of an older run).

    Raises:
        StoreError: The store cannot be read.
    """
    hashes, record = store.chained(run)
    return lineage_of(run_overview(store, run), hashes) | {"record": record}


def write_lineage(store: Store, run: str, folder: Path) -> int:
    """Write ``lineage.csv``, ``lineage.json``, the frames that there are, and what describes them.

    Returns:
        How many wells there are.

    Raises:
        StoreError: The store cannot be read.
        OSError: The folder cannot be written.
    """
    lineage = lineage_document(store, run)
    files = {
        "lineage.csv": lineage_csv(lineage).encode("utf-8-sig", "backslashreplace"),
        "lineage.json": json.dumps(lineage, ensure_ascii=False, indent=1).encode(
            "utf-8", "backslashreplace"
        ),
    }
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "frames").mkdir(exist_ok=True)
    kept = {name: (len(content), sha256(content)) for name, content in files.items()}
    frames = [path for (kind, key), path in store.files_of(run).items()
              if kind == "frames" and key.isdecimal()]  # fmt: skip
    for path in sorted(frames):
        jpeg = _read(path)
        (folder / "frames" / path.name).write_bytes(jpeg)
        kept[f"frames/{path.name}"] = len(jpeg), sha256(jpeg)
    files[CRATE] = ro_crate(lineage, kept).encode("utf-8", "backslashreplace")
    for name, content in files.items():
        (folder / name).write_bytes(content)
    return len(lineage["wells"])


def _read(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError as error:
        raise StoreError(f"The frame {path} cannot be read: {error.strerror}.") from error
