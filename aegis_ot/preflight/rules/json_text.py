"""JSON of rule files: what Python's reader would pass over in silence is told."""

from __future__ import annotations

import json
from collections import Counter
from typing import Any


class JsonObject(dict[str, Any]):
    """A JSON object that knows which of its fields were written twice.

    Python keeps the last value of a field and forgets the others; whoever edits the first one
    would wonder why nothing changes. Which rule it stands in is known only where it is read.
    """

    def __init__(self, pairs: list[tuple[str, Any]]) -> None:
        super().__init__(pairs)
        times = Counter(name for name, _ in pairs)
        self.doubled = [name for name in self if times[name] > 1]


def parse_json(text: bytes) -> Any:
    """The value of a JSON text in UTF-8, with or without the mark that Windows puts first.

    Raises:
        ValueError: With what is wrong, in words.
    """
    try:
        return json.loads(text.decode("utf-8-sig"), object_pairs_hook=JsonObject)
    except UnicodeDecodeError as error:
        raise ValueError(f"it is not UTF-8 text ({error.reason} at byte {error.start})") from None
    except RecursionError:
        raise ValueError("its lists or objects are nested too deeply") from None
