"""The audit in a process of its own, at the lowest priority: verdicts of other runs do not wait."""

from __future__ import annotations

import json
import subprocess
import sys
import threading
from pathlib import Path
from typing import Any

from ..errors import StoreError
from ..sidecar import SidecarConfig


class AuditProcess:
    """A sidecar's :class:`~aegis_ot.sidecar.auditing.Auditor`; it asks no vision model.

    Args:
        config: Settings of the sidecar: its data folder, detector and world model.
    """

    def __init__(self, config: SidecarConfig) -> None:
        self._config = config
        self._lock = threading.Lock()
        self._child: subprocess.Popen[str] | None = None
        self._stopped = False

    def audit(self, run: str) -> dict[str, Any]:
        """The audit of a run, as plain JSON.

        Raises:
            StoreError: The process could not read the run, or was stopped.
        """
        told = json.dumps({"data": str(self._config.data), "run": run} | self._models())
        with self._lock:
            if self._stopped:
                raise StoreError("The audit was stopped.")
            self._child = subprocess.Popen(
                [sys.executable, "-m", "aegis_ot.audit"],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                encoding="utf-8",
            )
        said, complaint = self._child.communicate(told)
        if self._child.returncode:
            last = complaint.strip().splitlines()[-1:] or [f"exit code {self._child.returncode}"]
            raise StoreError(f"The audit of run {run} failed: {last[0]}")
        found: dict[str, Any] = json.loads(said)
        return found

    def stop(self) -> None:
        """End the audit that is under way, and begin no other. Idempotent."""
        with self._lock:
            self._stopped = True
            if self._child is not None and self._child.poll() is None:
                self._child.kill()

    def _models(self) -> dict[str, str | None]:
        cascade = self._config.cascade
        paths: dict[str, Path | None] = {"detector": cascade.detector, "model": cascade.model}
        return {name: None if path is None else str(path) for name, path in paths.items()}
