"""The settings files that pages show are accepted as they stand."""

from __future__ import annotations

import json

import pytest

from aegis_ot.settings import load_settings
from aegis_ot.sidecar.config import SidecarConfig

from .blocks import ROOT, Block, blocks_of


def shown(language: str, *pages: str) -> list[Block]:
    paths = [ROOT / "docs" / page for page in pages]
    return [block for path in paths for block in blocks_of(path) if block.language == language]


@pytest.mark.parametrize(
    "block",
    shown("toml", "how-to/cost-dial.md", "how-to/service.md", "reference/settings.md"),
    ids=lambda block: block.place,
)
def test_a_file_of_the_sidecar_is_accepted(block: Block):
    tomllib = pytest.importorskip("tomllib")
    SidecarConfig.model_validate({"token": "x" * 16, **tomllib.loads(block.body)})


@pytest.mark.parametrize(
    "block",
    shown("json", "how-to/install-on-a-robot.md", "tutorial/first-run.md"),
    ids=lambda block: block.place,
)
def test_a_file_of_the_guard_is_accepted(block: Block):
    assert load_settings(**json.loads(block.body)).sidecar
