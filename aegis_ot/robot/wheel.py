"""The robot half as a wheel: pure Python, no dependency, made without a build tool."""

from __future__ import annotations

import base64
import hashlib
import zipfile
from pathlib import Path

from .._version import __version__
from .bundle import PACKAGE, ROOT, robot_half

_ALSO = (f"{ROOT}.planted",)
"""What the protocol of a qualification imports besides the guard."""

_METADATA = f"""Metadata-Version: 2.1
Name: aegis-ot
Version: {__version__}
Summary: Guards Opentrons liquid handlers: the half that runs on the robot.
License: MIT
Requires-Python: >=3.10
"""
_WHEEL = """Wheel-Version: 1.0
Generator: aegis-ot
Root-Is-Purelib: true
Tag: py3-none-any
"""


def write_wheel(folder: Path, package: Path = PACKAGE) -> Path:
    """Write the wheel of what runs on a robot; its path."""
    files = {f"aegis_ot/{name}": text for name, text in sorted(robot_half(package, _ALSO))}
    info = f"aegis_ot-{__version__}.dist-info"
    files |= {f"{info}/METADATA": _METADATA, f"{info}/WHEEL": _WHEEL}
    record = [f"{name},{_hash(text)},{len(text.encode())}" for name, text in files.items()]
    files[f"{info}/RECORD"] = "\n".join([*record, f"{info}/RECORD,,", ""])
    path = folder / f"aegis_ot-{__version__}-py3-none-any.whl"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as wheel:
        for name, text in files.items():
            wheel.writestr(name, text)
    return path


def _hash(text: str) -> str:
    digest = hashlib.sha256(text.encode()).digest()
    return f"sha256={base64.urlsafe_b64encode(digest).decode().rstrip('=')}"
