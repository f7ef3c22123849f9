"""``python -m benchmarks [--only NAME ...] [--protocols FOLDER ...] [DATASET ...]``.

Prints every figure, asserts none.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import time
from collections.abc import Callable, Iterator
from pathlib import Path

# One core: before numpy and onnxruntime are loaded.
os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from .figure import Figure
from .vision_data import folders

GROUPS = (
    "guard", "protocols", "keyframe", "import", "layer1", "camera", "record", "vision", "quality",
)  # fmt: skip


def main() -> None:
    """Run what is asked for."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument("datasets", nargs="*", type=Path, help="trajectory data sets to look at")
    parser.add_argument("--only", nargs="+", choices=GROUPS, default=GROUPS)
    parser.add_argument(
        "--protocols", nargs="+", type=Path, default=[], metavar="FOLDER",
        help="guard these protocols instead of the examples",
    )  # fmt: skip
    asked = parser.parse_args()
    begun = time.monotonic()
    print("Processor time, but keyframes by the clock. Ratios are of runs in turns.")
    print(f"{os.cpu_count()} cores, load before the start {_load()}.", flush=True)
    looks = bool({"vision", "quality"} & set(asked.only))
    with folders(asked.datasets) if looks else contextlib.nullcontext([]) as datasets:
        for name, run in _groups(datasets, asked.protocols).items():
            if name in asked.only:
                print(f"\n{name}", flush=True)
                for figure in run():
                    print(figure.line(), flush=True)
    print(f"\n{time.monotonic() - begun:.0f} s in all.")


def _load() -> str:
    return f"{os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else "unknown"


def _groups(
    datasets: list[Path], protocols: list[Path]
) -> dict[str, Callable[[], Iterator[Figure]]]:
    from . import (
        guard_overhead,
        import_time,
        keyframe_cost,
        layer1_cost,
        public_protocols,
        record_cost,
        simulated_camera,
        vision_cost,
        vision_quality,
    )

    return {
        "guard": guard_overhead.figures,
        "protocols": lambda: public_protocols.figures(protocols),
        "keyframe": keyframe_cost.figures,
        "import": import_time.figures,
        "layer1": layer1_cost.figures,
        "camera": simulated_camera.figures,
        "record": record_cost.figures,
        "vision": lambda: vision_cost.figures(datasets),
        "quality": lambda: vision_quality.figures(datasets),
    }


if __name__ == "__main__":
    main()
