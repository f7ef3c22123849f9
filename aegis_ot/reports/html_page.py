"""HTML pages from templates: one file each, with the pictures inside and no link to anywhere."""

from __future__ import annotations

import base64
from collections.abc import Callable, Mapping
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined

from .. import __version__
from ..vocabulary import KeyframeKind

Filters = Mapping[str, Callable[..., Any]]
"""Functions that a template calls, by name."""

KEYFRAME_TITLES = {kind: kind.value.replace("_", "-") for kind in KeyframeKind}
"""What the pages call the four moments."""


def html_page(room: str, template: str, filters: Filters, **values: Any) -> str:
    """Render a template; a value that it names and does not get is an error.

    Args:
        room: The package whose ``templates`` folder holds it.
        template: Its file name.
        filters: What it calls.
        values: What it shows, besides the version of this package.
    """
    environment = Environment(
        loader=PackageLoader(room),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters.update(filters)
    return environment.get_template(template).render(version=__version__, **values)


def data_url(jpeg: bytes) -> str:
    """A JPEG as an address that holds it."""
    return "data:image/jpeg;base64," + base64.b64encode(jpeg).decode("ascii")
