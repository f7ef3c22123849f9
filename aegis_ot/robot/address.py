"""From what a person types to the address of a robot's server."""

from __future__ import annotations

from urllib.parse import urlsplit

from ..errors import ConfigurationError

PORT, TLS_PORT = 31950, 32313


def robot_url(host: str) -> str:
    """``"192.168.1.7"``, ``"robot.local:31950"``, ``"[fe80::1]"`` or a URL, as a base URL.

    Raises:
        ConfigurationError: It names no host.
    """
    text = host.strip()
    if text.count(":") > 1 and "[" not in text and "//" not in text:
        text = f"[{text}]"  # a bare IPv6 address
    try:
        parts = urlsplit(text if "//" in text else f"http://{text}")
        name, port = parts.hostname, parts.port
    except ValueError:
        name, port, parts = None, None, urlsplit("")
    plain = parts.scheme in ("http", "https") and parts.path in ("", "/")
    plain = plain and not (parts.query or parts.username)
    if not name or not plain or any(c.isspace() or not c.isprintable() for c in name):
        raise ConfigurationError(
            f"--robot {host!r} is no address of a robot. Give its name or number as the Opentrons "
            "App shows it, for example 192.168.1.7."
        )
    shown = f"[{name}]" if ":" in name else name
    return f"{parts.scheme}://{shown}:{port or (PORT if parts.scheme == 'http' else TLS_PORT)}"
