"""A self-contained HTML report of dry runs: no script, no link, frames inside."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined

from .. import __version__
from ..preflight.checking import summary
from ..vocabulary import KeyframeKind

_TITLES = {
    KeyframeKind.ASPIRATE: "aspirate",
    KeyframeKind.TRANSIT: "transit",
    KeyframeKind.DISPENSE: "dispense",
    KeyframeKind.POST_DISPENSE: "post-dispense",
}


def dry_run_html(results: Sequence[Any]) -> str:
    """Render finished dry runs (``aegis_ot.dryrun.DryRun``) as one HTML page."""
    environment = Environment(
        loader=PackageLoader("aegis_ot.reports"), autoescape=True, undefined=StrictUndefined
    )
    environment.filters["data_url"] = _data_url
    environment.filters["summary"] = summary
    template = environment.get_template("dryrun.html")
    return template.render(results=results, titles=_TITLES, version=__version__)


def _data_url(jpeg: bytes) -> str:
    return "data:image/jpeg;base64," + base64.b64encode(jpeg).decode("ascii")
