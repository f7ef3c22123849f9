"""Backends by name: ``anthropic:MODEL``, ``openai:MODEL@URL``, ``replay:FOLDER``.

Options follow a ``#``: ``openai:llama3.1:8b@http://127.0.0.1:11434/v1#structured=tool``.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Mapping
from pathlib import Path
from urllib.parse import parse_qsl, urlsplit

from ...errors import ConfigurationError
from ...vocabulary import one_line
from ...vocabulary.opinions import MODEL_FORMS
from ..backend import Backend
from .anthropic_api import AnthropicBackend
from .exporting import ExportBackend
from .keys import without
from .openai_api import PROFILES, OpenAIBackend
from .recording import RecordingBackend, ReplayBackend
from .retrying import RetryPolicy
from .scripted import ScriptedBackend
from .service import RequestOptions

MODEL_VARIABLE = "AEGIS_OT_MODEL"
RECORD_VARIABLE = "AEGIS_OT_MODEL_RECORD"
_OPTIONS = {
    "anthropic": {"structured", "temperature", "key", "timeout", "attempts", "output"},
    "openai": {"structured", "limit", "temperature", "key", "timeout", "attempts", "output"},
    "replay": {"model"},
    "scripted": set(),
    "export": set(),
}
_FILES = {"replay", "scripted", "export"}
_LONGEST_S = 3600.0


def record_from_environment() -> Path | None:
    """The folder for recordings that ``AEGIS_OT_MODEL_RECORD`` names, if any."""
    folder = os.environ.get(RECORD_VARIABLE, "").strip()
    return Path(folder).expanduser() if folder else None


def model_from_environment(environ: Mapping[str, str] | None = None) -> str | None:
    """The model that ``AEGIS_OT_MODEL`` names, if any."""
    environ = os.environ if environ is None else environ
    return environ.get(MODEL_VARIABLE, "").strip() or None


def make_backend(
    name: str,
    record: str | Path | None = None,
    timeout_s: float | None = None,
    trust_env: bool = True,
) -> Backend:
    """The backend that ``name`` means.

    Args:
        name: See the module. ``key=VARIABLE`` names the environment variable that holds the key;
            a key itself is never part of a name.
        record: Folder to keep requests and answers in.
        timeout_s: From a question to its answer, retries included, s; the name's own
            ``timeout`` option wins.
        trust_env: Whether HTTP clients may use the proxies of the environment.

    Raises:
        ConfigurationError: The name makes no sense.
    """
    kind, _, rest = name.strip().partition(":")
    if kind not in _FILES and without("", name) != name:
        raise ConfigurationError(
            f"The model {_shown(name)!r} holds what looks like a key. Keys come from the "
            "environment."
        )
    rest, _, option_text = rest.partition("#")
    rest = rest.strip()
    if kind not in _OPTIONS or not rest or not rest.isprintable():
        raise ConfigurationError(
            f"The model {_shown(name)!r} is not understood. Use {MODEL_FORMS}."
        )
    options = _options(kind, option_text)
    if kind == "replay":
        backend: Backend = ReplayBackend(Path(rest).expanduser(), options.get("model"))
    elif kind == "scripted":
        backend = _scripted(Path(rest).expanduser())
    elif kind == "export":
        backend = ExportBackend(Path(rest).expanduser())
    else:
        backend = _service(kind, rest, options, timeout_s, trust_env)
    return backend if record is None else RecordingBackend(backend, record)


def _service(
    kind: str, rest: str, options: dict[str, str], timeout_s: float | None, trust_env: bool
) -> Backend:
    model, url = _split_url(rest)
    manner = RequestOptions(
        patience=RetryPolicy(
            timeout_s=_number(options, "timeout", timeout_s or RetryPolicy.timeout_s),
            attempts=_count(options, "attempts", 100) or RetryPolicy.attempts,
        ),
        temperature=_number(options, "temperature", 0.0) if "temperature" in options else None,
        trust_env=trust_env,
        output=_count(options, "output", 200_000),
    )
    keys = (options["key"],) if "key" in options else None
    structured = options.get("structured")
    if kind == "anthropic":
        return AnthropicBackend(model, url, structured, keys, manner)
    return OpenAIBackend(model, url, structured, options.get("limit"), keys, manner)


def _scripted(path: Path) -> Backend:
    try:
        said = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise ConfigurationError(f"The script {path} cannot be read: {error}.") from None
    if isinstance(said, dict):
        return ScriptedBackend(lambda _: said)
    if isinstance(said, list) and all(isinstance(answer, (dict, str)) for answer in said):
        return ScriptedBackend(said)
    raise ConfigurationError(
        f"The script {path} holds neither an answer (an object), given to every request, nor a "
        "list of answers, given one after the other."
    )


def project_model(name: str, folder: Path) -> str:
    """A model's name as a project's own file may give it.

    Whoever writes that file must not decide where a key goes: a project is often somebody
    else's. So it names a service that is known, a server on this machine, or a folder.

    Args:
        name: See the module.
        folder: That relative paths start from.

    Raises:
        ConfigurationError: It names another server, or a variable that holds a key.
    """
    kind, _, rest = name.strip().partition(":")
    rest, mark, option_text = rest.partition("#")
    if kind in ("replay", "scripted"):
        return f"{kind}:{folder / Path(rest).expanduser()}{mark}{option_text}"
    if kind in ("anthropic", "openai"):
        _, url = _split_url(rest)
        host = urlsplit(url).hostname if url else None
        own = {"anthropic": set(), "openai": {*PROFILES, "127.0.0.1", "localhost", "::1"}}[kind]
        if (host is not None and host not in own) or "key" in _options(kind, option_text):
            raise ConfigurationError(
                "A project's file cannot say where a key is sent. Name this model with --model "
                "or in AEGIS_OT_MODEL."
            )
    return name


def _split_url(rest: str) -> tuple[str, str | None]:
    """Model names hold slashes, colons and at signs; addresses begin with http."""
    for scheme in ("@http://", "@https://"):
        model, found, tail = rest.partition(scheme)
        if found:
            url = (scheme[1:] + tail).rstrip("/")
            if not _is_address(url):
                raise ConfigurationError(
                    "The address of a model is http://HOST:PORT/v1, without user, password or "
                    "query; keys come from the environment."
                )
            if not model:
                raise ConfigurationError(f"No model is named before {url}. Use {MODEL_FORMS}.")
            return model, url
    if "@" in rest:
        # Taken for a part of the model's name, the protocol would go to the service itself.
        raise ConfigurationError(
            f"What follows the @ of {_shown(rest)!r} is no address: it begins with http:// or "
            "https://."
        )
    return rest, None


def _is_address(url: str) -> bool:
    try:
        parts = urlsplit(url)
        port = parts.port
    except ValueError:
        return False
    extra = parts.username or parts.password or parts.query
    return bool(parts.hostname) and port != 0 and not extra and not re.search(r"\s", url)


def _options(kind: str, text: str) -> dict[str, str]:
    options = dict(parse_qsl(text, keep_blank_values=True))
    for name, value in options.items():
        if name not in _OPTIONS[kind] or not value:
            raise ConfigurationError(
                f"There is no option {name!r} for {kind}, or it has no value. Options are "
                f"{', '.join(sorted(_OPTIONS[kind]))}, written #NAME=VALUE&NAME=VALUE."
            )
    variable = options.get("key")
    if variable is not None and not variable.replace("_", "").isalnum():
        raise ConfigurationError(
            "key= names an environment variable, such as key=MY_LAB_KEY; never the key itself."
        )
    return options


def _count(options: Mapping[str, str], name: str, most: int) -> int | None:
    text = options.get(name)
    if text is None:
        return None
    if not text.isdecimal() or not 0 < int(text[:9]) <= most:
        raise ConfigurationError(f"The option {name}={text!r} must be a whole number, 1 to {most}.")
    return int(text)


def _number(options: Mapping[str, str], name: str, default: float) -> float:
    text = options.get(name)
    if text is None:
        return default
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0 <= value <= _LONGEST_S or (value == 0 and name != "temperature"):
        raise ConfigurationError(
            f"The option {name}={text!r} must be a number more than 0, at most {_LONGEST_S:g}."
        )
    return value


def _shown(name: str) -> str:
    return one_line(without("", name), 80)
