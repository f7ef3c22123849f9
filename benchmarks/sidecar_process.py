"""A real sidecar in a process of its own."""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
from collections.abc import Iterator


@contextlib.contextmanager
def sidecar_process(*arguments: str) -> Iterator[tuple[str, int]]:
    """Run ``aegis-ot sidecar ARGUMENTS`` on one core, free of settings in the environment.

    Yields:
        Its address and its process number.
    """
    environment = {k: v for k, v in os.environ.items() if not k.startswith("AEGIS_OT_")}
    process = subprocess.Popen(
        [sys.executable, "-c", "from aegis_ot.cli import main; main()", "sidecar", *arguments],
        env=dict(environment, OMP_NUM_THREADS="1", PYTHONUNBUFFERED="1"),
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )
    try:
        assert process.stdout is not None
        line = next(line for line in process.stdout if "http://" in line)
        yield next(word for word in line.split() if word.startswith("http://")), process.pid
    finally:
        process.terminate()
        process.wait(20)
