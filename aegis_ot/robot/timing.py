"""What the guard adds to the analysis of a protocol, measured on this machine."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

from ..errors import ProtocolRejected, RehearsalError

_TIMEOUT_S = 600.0
_TIMED = """
import io, json, logging, sys, time
logging.disable(logging.CRITICAL)
import opentrons.simulate as simulate
text = open(sys.argv[1], encoding="utf-8").read()
began = time.perf_counter()
told = {}
try:
    simulate.simulate(io.StringIO(text), sys.argv[2], log_level="none")
    told["seconds"] = time.perf_counter() - began
except Exception as error:
    # What the App would show of it; the engine's error prints as its whole record.
    engine = error.args[0] if error.args and isinstance(error.args[0], list) else ()
    told["error"] = "; ".join(one.detail for one in engine) or f"{type(error).__name__}: {error}"
    classes = [type(error).__name__]
    classes += [why.errorInfo.get("class") for one in engine for why in one.wrappedErrors]
    told["refused"] = "ProtocolRejected" in classes
print("TOLD", json.dumps(told))
"""


def simulation_s(protocol: Path, name: str) -> float:
    """How long Opentrons' simulator takes for a protocol in a fresh process, itself imported, s.

    Raises:
        ProtocolRejected: The guard in it refuses it.
        RehearsalError: It does not simulate; with what was said.
    """
    try:
        done = subprocess.run(
            [sys.executable, "-c", _TIMED, str(protocol), name],
            capture_output=True,
            text=True,
            timeout=_TIMEOUT_S,
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise RehearsalError(f"{name} did not simulate within {_TIMEOUT_S:g} s.") from None
    for line in done.stdout.splitlines():
        if line.startswith("TOLD "):
            told = json.loads(line[5:])
            if "seconds" in told:
                return float(told["seconds"])
            if told["refused"]:
                raise ProtocolRejected(told["error"])
            raise RehearsalError(f"{name} does not simulate: {told['error']}")
    said = [line for line in done.stderr.splitlines() if line.strip()]
    raise RehearsalError(f"{name} does not simulate: {said[-1] if said else 'nothing was said'}")
