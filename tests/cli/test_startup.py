"""A check starts without the libraries of cameras, services and models."""

from __future__ import annotations

import subprocess
import sys

HEAVY = ("cv2", "numpy", "fastapi", "onnxruntime", "sklearn", "matplotlib", "anthropic", "openai")


def test_the_command_line_loads_no_heavy_library() -> None:
    code = f"import sys, aegis_ot.cli.app; print([m for m in {HEAVY!r} if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
