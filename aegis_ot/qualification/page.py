"""The certificate as one HTML page: no script, no link."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..reports.html_page import html_page
from .certificate import WORDS


def certificate_html(certificate: Mapping[str, Any]) -> str:
    """Render what :func:`~.certificate.certificate` gives."""
    shown = {"fitted": None, **certificate}
    return html_page("aegis_ot.qualification", "certificate.html", {}, c=shown, words=WORDS)
