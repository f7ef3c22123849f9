"""Lets functions run code that tells of their return, on Pythons that cannot tell of it cheaply.

The code is compiled anew from the same text, with ``try: ... finally: tell()`` around each body;
lines, columns, names and exceptions stay as they are. A function whose code is not what its
text compiles to is left alone, and each gets its own code back at the end.
"""

from __future__ import annotations

import ast
import sys
import uuid
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from threading import get_ident
from types import CodeType, FrameType, FunctionType

from .own_functions import codes_of

_FUTURES = 0x1FE0000
"""The flags of ``from __future__``, which a loader may hand on to what it compiles."""


class _Ear:
    """Stands in the rewritten code as a constant: no name has to be lent by the protocol."""

    def __init__(self, look: Callable[[FrameType], None]) -> None:
        self._look: Callable[[FrameType], None] | None = look
        self._thread = get_ident()

    def returned(self) -> None:
        if self._look is not None and get_ident() == self._thread:
            self._look(sys._getframe(1))

    def close(self) -> None:
        """A function that outlives the run must not keep the run alive."""
        self._look = None


@contextmanager
def rewritten(
    functions: Sequence[FunctionType],
    sources: Callable[[str], str],
    look: Callable[[FrameType], None],
) -> Iterator[None]:
    """Tell ``look`` of each return of these functions, and of those within them.

    Args:
        functions: What to listen to.
        sources: The text of a file, by ``co_filename``.
        look: Gets the frame that returns, in this thread only.
    """
    ear = _Ear(look)
    ours: list[tuple[FunctionType, CodeType, CodeType]] = []
    for (file_name, flags), group in _by_file(functions).items():
        codes = _telling(sources(file_name), file_name, flags, ear)
        ours += [
            (function, function.__code__, codes[function.__code__])
            for function in group
            if function.__code__ in codes
        ]
    try:
        for function, _, telling in ours:
            function.__code__ = telling
        yield
    finally:
        ear.close()
        for function, own, telling in ours:
            if function.__code__ is telling:
                function.__code__ = own


def _by_file(functions: Sequence[FunctionType]) -> dict[tuple[str, int], list[FunctionType]]:
    groups: dict[tuple[str, int], list[FunctionType]] = {}
    for function in functions:
        code = function.__code__
        groups.setdefault((code.co_filename, code.co_flags & _FUTURES), []).append(function)
    return groups


def _telling(text: str, file_name: str, flags: int, ear: _Ear) -> Mapping[CodeType, CodeType]:
    """From each function's code to the code that tells; equal code is proof of the same text."""
    place = f"aegis_ot {uuid.uuid4()}"
    try:
        plain = compile(text, file_name, "exec", flags, dont_inherit=True)
        tree = _AtReturn(place).visit(ast.parse(text, file_name))
        telling = compile(tree, file_name, "exec", flags, dont_inherit=True)
    except (SyntaxError, ValueError, RecursionError):  # nested as deep as Python allows, say
        return {}
    pairs = list(zip(codes_of(plain), codes_of(telling), strict=False))
    if any(
        (one.co_name, one.co_firstlineno) != (other.co_name, other.co_firstlineno)
        for one, other in pairs
    ):
        return {}
    return {one: _with_ear(other, place, ear) for one, other in pairs}


def _with_ear(code: CodeType, place: str, ear: _Ear) -> CodeType:
    consts = (
        _with_ear(const, place, ear) if isinstance(const, CodeType) else const
        for const in code.co_consts
    )
    return code.replace(
        co_consts=tuple(ear if type(c) is str and c == place else c for c in consts)
    )


class _AtReturn(ast.NodeTransformer):
    """Puts the call at the end of each function, whichever way it ends."""

    def __init__(self, place: str) -> None:
        self._place = place

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.FunctionDef:
        self.generic_visit(node)
        start = 0 if ast.get_docstring(node, clean=False) is None else 1
        body = node.body[start:]
        if body:
            ear = ast.Attribute(ast.Constant(self._place), "returned", ast.Load())
            tell = ast.Expr(ast.Call(ear, [], []))
            ending = ast.Try(body, [], [], [tell])
            ast.copy_location(ending, body[0])
            for part in ast.walk(tell):
                ast.copy_location(part, node)
            node.body[start:] = [ending]
        return node
