"""HTML pages from templates: one file each, with the pictures inside and no link to anywhere."""

from __future__ import annotations

import base64
import functools
import time
from collections.abc import Callable, Mapping
from importlib.resources import files
from typing import TYPE_CHECKING, Any

from jinja2 import ChoiceLoader, Environment, PackageLoader, StrictUndefined

from .. import __version__
from ..vocabulary import NOT_AS_REHEARSED, Gate, KeyframeKind

if TYPE_CHECKING:  # `aegis-ot check` does without numpy and OpenCV
    from ..run_view import Level

Filters = Mapping[str, Callable[..., Any]]
"""Functions that a template calls, by name."""

KEYFRAME_TITLES = {kind: kind.value.replace("_", "-") for kind in KeyframeKind}
"""What the pages call the four moments."""


def shared_file(name: str) -> str:
    """A file that all pages share, as text."""
    return (files("aegis_ot.reports") / "templates" / name).read_text("utf-8")


def html_page(room: str, template: str, filters: Filters, **values: Any) -> str:
    """Render a template; a value that it names and does not get is an error.

    Args:
        room: The package whose ``templates`` folder holds it.
        template: Its file name.
        filters: What it calls, besides ``data_url`` (of a picture), ``level`` and ``moment``.
        values: What it shows, besides the version of this package.
    """
    environment = _environment(room)
    environment.filters.update(filters)
    return environment.get_template(template).render(version=__version__, **values)


@functools.cache
def _environment(room: str) -> Environment:
    """With the room's templates, and those that all pages share."""
    environment = Environment(
        loader=ChoiceLoader([PackageLoader(room), PackageLoader("aegis_ot.reports")]),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters.update(
        data_url=lambda picture: data_url(picture.jpeg),
        lasted=_lasted,
        level=_level,
        moment=_moment,
    )
    environment.globals["titles"] = KEYFRAME_TITLES
    environment.globals["not_as_rehearsed"] = NOT_AS_REHEARSED
    environment.globals["gates"] = {gate.value: gate.traits.does for gate in Gate}
    return environment


def _level(level: Level) -> str:
    """``150 ± 6 µL``; one decimal below 30 µL."""
    digits = 1 if level.volume_ul < 30 else 0
    text = f"{level.volume_ul:.{digits}f}"
    if level.sigma_ul:
        text += f" ± {level.sigma_ul:.{digits}f}"
    air = f", {level.air_ul:.{digits}f} µL air" if level.air_ul > 0.05 else ""
    return f"{text} µL{air}"


def _moment(seconds: float) -> str:
    """Seconds since the epoch on the clock of this machine: ``2026-11-25 14:03``."""
    return time.strftime("%Y-%m-%d %H:%M", time.localtime(seconds))


def _lasted(seconds: float) -> str:
    """``48 s``, ``12 min``, ``1 h 05 min``."""
    minutes = round(seconds / 60)
    if seconds < 60:
        return f"{max(0.0, seconds):.0f} s"
    return f"{minutes} min" if minutes < 60 else f"{minutes // 60} h {minutes % 60:02d} min"


def data_url(jpeg: bytes) -> str:
    """A JPEG as an address that holds it."""
    return "data:image/jpeg;base64," + base64.b64encode(jpeg).decode("ascii")


def video_url(video: bytes) -> str:
    """A WebM video likewise."""
    return "data:video/webm;base64," + base64.b64encode(video).decode("ascii")
