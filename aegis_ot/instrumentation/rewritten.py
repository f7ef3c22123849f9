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
from threading import Lock, get_ident
from types import CodeType, FrameType, FunctionType
from typing import TypeAlias

from .own_functions import codes_of

Look: TypeAlias = Callable[[FrameType], None]

_FUTURES = 0x1FE0000
"""The flags of ``from __future__``, which a loader may hand on to what it compiles."""


_LENDING = Lock()
"""Two runs in two threads may call the functions of one helper module."""


class _Ear:
    """Stands in the rewritten code as a constant: no name has to be lent by the protocol.

    A run that finds it in a function joins it; the last run that leaves gives the functions their
    own code back. One that outlives all runs is not heard and keeps none of them alive.
    """

    def __init__(self) -> None:
        self._listeners: list[tuple[int, Look]] = []
        self._own: list[tuple[FunctionType, CodeType]] = []

    def returned(self) -> None:
        thread = get_ident()
        for listener, look in tuple(self._listeners):
            if listener == thread:
                look(sys._getframe(1))

    def enter(self, function: FunctionType, telling: CodeType) -> None:
        self._own.append((function, function.__code__))
        function.__code__ = telling

    def join(self, listener: tuple[int, Look]) -> None:
        self._listeners.append(listener)

    def leave(self, listener: tuple[int, Look]) -> None:
        self._listeners.remove(listener)
        if self._listeners:
            return
        for function, own in self._own:
            if _ear_in(function) is self:
                function.__code__ = own
        self._own.clear()


def _ear_in(function: FunctionType) -> _Ear | None:
    return next((c for c in function.__code__.co_consts if type(c) is _Ear), None)


@contextmanager
def rewritten(
    functions: Sequence[FunctionType], sources: Callable[[str], str], look: Look
) -> Iterator[None]:
    """Tell ``look`` of each return of these functions, and of those within them.

    Args:
        functions: What to listen to.
        sources: The text of a file, by ``co_filename``.
        look: Gets the frame that returns, in this thread only.
    """
    ear, listener = _Ear(), (get_ident(), look)
    codes = {
        (file_name, flags): _telling(sources(file_name), file_name, flags, ear)
        for file_name, flags in set(map(_origin, functions))
    }
    with _LENDING:
        for function in functions:
            telling = codes[_origin(function)].get(function.__code__)
            if telling is not None:
                ear.enter(function, telling)
        ears = {ear, *filter(None, map(_ear_in, functions))}
        for one in ears:
            one.join(listener)
    try:
        yield
    finally:
        with _LENDING:
            for one in ears:
                one.leave(listener)


def _origin(function: FunctionType) -> tuple[str, int]:
    """What its code was compiled from, and how."""
    code = function.__code__
    return code.co_filename, code.co_flags & _FUTURES


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
