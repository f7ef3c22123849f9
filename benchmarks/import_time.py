"""How long ``import aegis_ot`` takes where Opentrons is loaded already."""

from __future__ import annotations

import json
import statistics
import time
from collections.abc import Iterator

from .children import in_child
from .figure import Figure

INTERPRETERS = 5
TARGET_MS = 50.0


def figures() -> Iterator[Figure]:
    """Median over fresh interpreters."""
    taken = [in_child("import_time") for _ in range(INTERPRETERS)]
    data = f"median of {INTERPRETERS} fresh interpreters with opentrons loaded, processor time"
    yield Figure(
        "import aegis_ot", data, "", statistics.median(t["import"] for t in taken), "ms", TARGET_MS
    )
    yield Figure(
        "  and what the guard loads once run() is called (Layer 1)", data, "",
        statistics.median(t["layer1"] for t in taken), "ms",
    )  # fmt: skip


def main() -> None:
    """In the child: import and print."""
    import opentrons.protocol_api
    import opentrons.simulate  # noqa: F401

    begun = time.process_time()
    from aegis_ot import guard  # noqa: F401

    imported = time.process_time()

    loaded = time.process_time()
    print(json.dumps({"import": (imported - begun) * 1e3, "layer1": (loaded - imported) * 1e3}))


if __name__ == "__main__":
    main()
