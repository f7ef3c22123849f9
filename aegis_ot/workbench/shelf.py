"""A shelf of protocols: every one below some folders, with what lies beside it.

Beside a protocol lie custom labware definitions (JSON), and, where it comes from Opentrons'
protocol library, a ``fields.json`` with the values that ``get_values`` gives it.
"""

from __future__ import annotations

import itertools
import json
import os
import random
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..errors import ConfigurationError, RehearsalError
from .documents import is_document
from .files import read_protocol
from .result import Problem
from .surroundings import NO_SOURCES, Surroundings, root_of, surroundings_of

FIELDS = "fields.json"

_RUN = re.compile(r"^(?:async\s+)?def\s+run\s*\(|^run\s*=", re.M)
_OPENTRONS = re.compile(r"\bapiLevel\b|^\s*(?:from|import)\s+opentrons\b", re.M)
_FIRST_API = re.compile(
    r"^\s*from\s+opentrons\s+import\s+\(?[^\n#]*\b(?:labware|instruments|containers|robot)\b", re.M
)
_CALLS_VALUES = re.compile(r"\bget_values\s*\(")
_DEFINES_VALUES = re.compile(
    r"\bdef\s+get_values\b|^\s*get_values\s*=|\bimport\b.*\bget_values\b", re.M
)
_LARGEST_DEFINITION_BYTES = 5_000_000

Definitions = Mapping[str, Mapping[str, Any]]


@dataclass(frozen=True)
class Shelved:
    """One protocol of a shelf.

    Attributes:
        path: Of the file, below the folder that the user gave.
        text: What is rehearsed: the file's text, with ``get_values`` where it needs that.
        labware: Custom labware definitions that it, or a module of its, names, by URI.
        around: The modules that it imports from around it.
        skipped: Why there is no use in rehearsing it.
    """

    path: Path
    text: str = ""
    labware: Definitions = field(default_factory=dict)
    skipped: Problem | None = None
    around: Surroundings = field(default_factory=lambda: Surroundings({}, {}))


@dataclass(frozen=True)
class Definition:
    """A custom labware definition, and the file that it is from."""

    file: Path
    uri: str
    load_name: str
    content: Mapping[str, Any]


def find_protocols(folders: Sequence[Path]) -> list[Shelved]:
    """Every protocol below these folders, in the order of their paths.

    A Python file is one if it defines ``run`` and names Opentrons, or is written for the first
    API; a JSON file if Protocol Designer wrote it, or it is an analysis. Hidden folders and
    installed packages are passed over.

    Raises:
        ConfigurationError: One of them is no folder.
    """
    found: dict[Path, Shelved] = {}
    for folder in folders:
        if not folder.is_dir():
            raise ConfigurationError(f"{folder}: there is no such folder.")
        checkout = root_of(folder / FIELDS, [folder])
        definitions = definitions_below(checkout)
        for path in sorted(_files(folder, ".py")):
            if path.resolve() not in found:
                shelved = _shelved(path, definitions, root_of(path, [*folders, Path.cwd()]))
                if shelved is not None:
                    found[path.resolve()] = shelved
        for path in filter(is_document, sorted(_files(folder, ".json"))):
            found.setdefault(path.resolve(), Shelved(path, _rough_text(path)))
    return list(found.values())


def protocols_named(places: Sequence[Path]) -> list[Path]:
    """The files that are named, and every protocol below the folders that are; each once.

    Raises:
        ConfigurationError: There is none below a folder.
    """
    found: dict[Path, Path] = {}
    for place in places:
        here = [place]
        if place.is_dir():
            here = [p for p in sorted(_files(place, ".py")) if is_protocol(_rough_text(p))]
            here += [p for p in sorted(_files(place, ".json")) if is_document(p)]
            if not here:
                told = "a protocol defines run(protocol) and names Opentrons or an apiLevel"
                raise ConfigurationError(
                    f"{place}: there is no protocol below this folder; {told}."
                )
        for path in here:
            found.setdefault(path.resolve(), path)
    return list(found.values())


def sample(protocols: Sequence[Shelved], folders: Sequence[Path], count: int) -> list[Shelved]:
    """So many protocols that can be rehearsed, the same ones each time, in their order.

    Each folder right below the given ones (a repository, a project) gives about as many as any
    other, as far as it has them. Copies of one text count once.
    """
    groups: dict[tuple[str, ...], list[Shelved]] = {}
    for shelved in {p.text: p for p in reversed(protocols) if p.skipped is None}.values():
        folder = next(f for f in folders if shelved.path.is_relative_to(f))
        below = shelved.path.relative_to(folder).parent.parts[:1]
        groups.setdefault((str(folder), *below), []).append(shelved)
    chance = random.Random(0)
    for group in groups.values():
        group.sort(key=lambda shelved: shelved.path)
        chance.shuffle(group)
    turns = itertools.chain.from_iterable(itertools.zip_longest(*groups.values()))
    drawn = {p.path for p in itertools.islice(filter(None, turns), count)}
    return [p for p in protocols if p.path in drawn]


def definitions_below(folder: Path) -> tuple[Definition, ...]:
    """The custom labware definitions below a folder; JSON that is none is passed over."""
    return tuple(d for path in sorted(_files(folder, ".json")) for d in _definition(path))


def named_in(
    path: Path, texts: Iterable[str], definitions: Sequence[Definition]
) -> list[Definition]:
    """The definitions that a protocol, or a module of its, names; the nearest of each name last."""
    texts = list(texts)
    named = [d for d in definitions if any(d.load_name in text for text in texts)]
    near = path.resolve().parent
    named.sort(key=lambda d: len(Path(os.path.commonpath([near, d.file])).parts))
    return list({d.uri: d for d in named}.values())


def with_own_values(path: Path, text: str) -> str:
    """A protocol's text, with ``get_values`` where it is of Opentrons' library and needs that.

    Raises:
        ConfigurationError: It needs that, and no file beside it gives the values.
    """
    if not _CALLS_VALUES.search(text) or _DEFINES_VALUES.search(text):
        return text
    return _with_values(text, _field_values(path.parent / FIELDS))


def _files(folder: Path, ending: str) -> Iterator[Path]:
    for place, folders, names in os.walk(folder):
        folders[:] = [f for f in folders if not f.startswith(".") and f not in NO_SOURCES]
        yield from (Path(place, name) for name in names if name.endswith(ending))


def _shelved(path: Path, definitions: Sequence[Definition], root: Path) -> Shelved | None:
    """The protocol in this file, ``None`` if it holds none."""
    try:
        text = read_protocol(path)
    except (ConfigurationError, RehearsalError) as error:
        if not is_protocol(_rough_text(path)):
            return None
        return Shelved(path, skipped=Problem(str(error), getattr(error, "line", None)))
    if not is_protocol(text):
        return None
    if not _RUN.search(text):
        told = "it is written for Opentrons' first API (it defines no run), which is gone."
        return Shelved(path, text, skipped=Problem(told))
    try:
        whole = with_own_values(path, text)
    except ConfigurationError as error:
        return Shelved(path, text, skipped=Problem(str(error)))
    around = surroundings_of(path, text, root)
    named = named_in(path, [text, *around.texts.values()], definitions)
    return Shelved(path, whole, {d.uri: d.content for d in named}, around=around)


def _rough_text(path: Path) -> str:
    try:
        return path.read_bytes().decode("latin-1") if path.is_file() else ""
    except OSError:
        return ""


def is_protocol(text: str) -> bool:
    """Whether a Python text is a protocol: it defines ``run`` and names Opentrons."""
    if _RUN.search(text):
        return bool(_OPENTRONS.search(text))
    return bool(_FIRST_API.search(text))


def _field_values(path: Path) -> dict[str, Any]:
    """The values that a protocol of Opentrons' library has before anyone changes a field.

    Raises:
        ConfigurationError: There is no such file, or it cannot be used.
    """
    try:
        fields = json.loads(path.read_text(encoding="utf-8-sig"))
        return {item["name"]: _field_value(item) for item in fields}
    except FileNotFoundError:
        told = (
            f"it calls get_values, of Opentrons' protocol library, and no {FIELDS} lies beside it."
        )
        raise ConfigurationError(told) from None
    except (OSError, ValueError, KeyError, TypeError, IndexError):
        told = f"it calls get_values, and the {FIELDS} beside it is none of Opentrons' library."
        raise ConfigurationError(told) from None


def _field_value(item: Mapping[str, Any]) -> Any:
    value = item.get("default")
    if value is None and item.get("options"):
        value = item["options"][0]["value"]
    if isinstance(value, str):  # the library's pages write a line's end as two characters
        value = value.replace("\\n", "\n")
    return value


def _with_values(text: str, values: Mapping[str, Any]) -> str:
    """The protocol with its ``get_values``, behind all else: its lines keep their numbers."""
    return (
        f"{text.rstrip()}\n\n\ndef get_values(*names):\n    import json\n"
        f"    values = json.loads({json.dumps(dict(values))!r})\n"
        "    return [values[name] for name in names]\n"
    )


def _definition(path: Path) -> Iterator[Definition]:
    """The labware definitions in this file that are not Opentrons' own: the file is one, or a
    protocol of Protocol Designer that carries those which it uses."""
    try:
        if path.stat().st_size > _LARGEST_DEFINITION_BYTES:
            return
        data = path.read_bytes()
        if b'"loadName"' not in data or b'"wells"' not in data:
            return
        document = json.loads(data)
        for content in document.get("labwareDefinitions", {"": document}).values():
            name, namespace = content["parameters"]["loadName"], content["namespace"]
            uri = f"{namespace}/{name}/{content['version']}"
            if namespace != "opentrons":
                yield Definition(path.resolve(), uri, str(name), content)
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return
