"""``python -m aegis_ot``: the same as the command ``aegis-ot``."""

from __future__ import annotations

from .cli import main

main()
