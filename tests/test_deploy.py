"""The service's files name commands and settings that there are."""

from __future__ import annotations

import re
from pathlib import Path

from aegis_ot.sidecar import SidecarConfig
from aegis_ot.sidecar.config import DEFAULT_PORT, ENVIRONMENT

ROOT = Path(__file__).parents[1]
UNIT = (ROOT / "deploy" / "aegis-ot-sidecar.service").read_text(encoding="utf-8")
CONTAINER = (ROOT / "deploy" / "Containerfile").read_text(encoding="utf-8")
PAGE = (ROOT / "docs" / "how-to" / "service.md").read_text(encoding="utf-8")


def test_the_unit_starts_the_sidecar_and_stops_it_cleanly() -> None:
    (start,) = re.findall(r"^ExecStart=(.+)$", UNIT, re.MULTILINE)
    assert start.split()[0].endswith("/bin/aegis-ot")
    assert start.split()[1] == "sidecar"
    assert "KillSignal=SIGTERM" in UNIT
    assert "Restart=on-failure" in UNIT


def test_every_variable_is_one_that_is_read() -> None:
    named = set(re.findall(r"AEGIS_OT_SIDECAR_[A-Z]+", UNIT + CONTAINER + PAGE))
    assert named
    assert named <= set(ENVIRONMENT)
    assert f"EXPOSE {DEFAULT_PORT}" in CONTAINER


def test_the_settings_that_are_shown_are_accepted(tmp_path: Path) -> None:
    shown = re.search(r"```toml\n(.*?)```", PAGE, re.DOTALL)
    assert shown
    path = tmp_path / "sidecar.toml"
    path.write_text(shown[1], encoding="utf-8")
    config = SidecarConfig.load(path, environ={}, token="t" * 16)
    assert (config.host, config.log, config.retention.days) == ("0.0.0.0", "json", 90)
