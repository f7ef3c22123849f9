"""``python -m aegis_ot.audit``: what :mod:`.process` starts. Reads what to audit from standard
input as JSON, writes the audit to standard output."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import Any

import cv2

from ..errors import AegisError
from ..sidecar.store.opening import open_store
from ..vision.detection import load_detector
from .auditing import audit_run
from .models import world_model


def main() -> int:
    """Audit one run. Returns the exit status: 2 if it cannot be."""
    if hasattr(os, "nice"):
        os.nice(19)
    cv2.setNumThreads(1)
    asked: dict[str, Any] = json.load(sys.stdin)
    try:
        detector = load_detector(asked["detector"] or "default")
        scorer = world_model(Path(asked["model"]) if asked["model"] else None)
        audit = audit_run(open_store(Path(asked["data"])), asked["run"], detector, scorer)
    except AegisError as error:
        sys.stderr.write(f"{error}\n")
        return 2
    json.dump(audit.to_json(), sys.stdout)
    return 0


if __name__ == "__main__":
    sys.exit(main())
