"""The ``aegis-ot`` command. Thin: every command calls one function of another room.

Exit codes: 0 clean, 1 findings or failed wells, 2 the tool itself could not do its job.
"""

from __future__ import annotations

import sys


def main() -> None:
    """Run the command line; say what to install where its libraries are missing."""
    try:
        from .app import run
    except ModuleNotFoundError as error:
        if error.name is None or error.name.startswith("aegis_ot"):
            raise
        print(
            f"aegis-ot: the command line needs the package {error.name!r}, which is not "
            "installed. Install it with: pip install 'aegis-ot[check]'",
            file=sys.stderr,
        )
        raise SystemExit(2) from None
    run()
