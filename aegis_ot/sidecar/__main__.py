"""``python -m aegis_ot.sidecar [SETTINGS]``: the sidecar alone, without the command line."""

from __future__ import annotations

import sys

from ..errors import AegisError
from .analysers import make_analyser, make_detector
from .config import SidecarConfig
from .journal import event, set_up
from .reasoning_routes import gates_of
from .server import serve
from .token_file import kept_token


def main(arguments: list[str]) -> int:
    """Run until stopped. Returns the exit status: 2 if the settings cannot be used."""
    try:
        config = SidecarConfig.load(arguments[0] if arguments else None, find_token=kept_token)
        set_up(config.log)
        detector = make_detector(config.cascade)
        analyser = make_analyser(config.cascade, gates_of(config), detector)
        serve(
            config,
            analyser=analyser,
            detector=detector,
            ready=lambda url: event("ready", address=url),
        )
    except AegisError as error:
        sys.stderr.write(f"{error}\n")
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
