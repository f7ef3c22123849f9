"""Serves the modules of a bundle from memory. Its text travels inside wrapped protocols.

Standard library only, and nothing is read or written.
"""

from __future__ import annotations

import base64
import importlib.abc
import importlib.machinery
import json
import os
import sys
import zlib
from collections.abc import Sequence
from types import ModuleType
from typing import Any


class BundleFinder(importlib.abc.MetaPathFinder, importlib.abc.InspectLoader):
    """Finds and loads the modules of one bundle.

    Args:
        name: The package's name.
        files: Text of each module by path.
    """

    def __init__(self, name: str, files: dict[str, str]) -> None:
        self.bundle = name
        self._files = files

    def find_spec(
        self, fullname: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> importlib.machinery.ModuleSpec | None:
        """Where a module of this bundle is."""
        file = self._file(fullname)
        if file is None:
            return None
        spec = importlib.machinery.ModuleSpec(
            fullname,
            self,
            origin=os.path.join(f"<{self.bundle}>", *file.split("/")),
            is_package=file.endswith("__init__.py"),
        )
        spec.has_location = True
        return spec

    def exec_module(self, module: ModuleType) -> None:
        """Run a module's text."""
        source = self.get_source(module.__name__)
        assert source is not None
        assert module.__file__ is not None
        exec(compile(source, module.__file__, "exec"), module.__dict__)

    def get_source(self, fullname: str) -> str | None:
        """For tracebacks."""
        file = self._file(fullname)
        return None if file is None else self._files[file]

    def is_package(self, fullname: str) -> bool:
        """Whether it has modules below it."""
        return (self._file(fullname) or "").endswith("__init__.py")

    def _file(self, fullname: str) -> str | None:
        root, *inner = fullname.split(".")
        if root != self.bundle:
            return None
        for file in ("/".join([*inner, "__init__.py"]), "/".join(inner) + ".py"):
            if file in self._files:
                return file
        return None


def install(name: str, payload: str) -> None:
    """Make ``import NAME`` work from now on, in this process. Idempotent."""
    finders: list[Any] = sys.meta_path
    if not any(getattr(finder, "bundle", None) == name for finder in finders):
        files = json.loads(zlib.decompress(base64.b85decode(payload)))
        finders.append(BundleFinder(name, files))
