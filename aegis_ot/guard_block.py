"""``with guard(protocol):`` where no function is around it: in a notebook, in a program.

``guard`` returns the very context that it was given, and a context is none that ``with`` takes. So
the first guard of a context gives its class the two methods; nothing else of the class changes.
"""

from __future__ import annotations

import dis
import weakref
from collections.abc import Callable
from types import FrameType, TracebackType
from typing import Any

from .adapters.opentrons.protocol_frames import at_return_of
from .errors import ConfigurationError


class GuardBlock:
    """A guard that ends with its cell, unless a ``with`` takes it over.

    Args:
        end: Ends the guard; told what was raised, and the word for where it stood.
        tell: Says at once what the guard covers from now on; told whether it was taken over
            before.
        place: ``"cell"`` or ``"program"``.
        frame: Of that place, which has called ``guard``.
    """

    def __init__(
        self,
        end: Callable[[BaseException | None, str], None],
        tell: Callable[[bool], None],
        place: str,
        frame: FrameType,
    ) -> None:
        self._place, self._entered = place, False
        # Both hold the context; a guard that has ended lets it go.
        self._open: tuple[Callable[..., None], Callable[[bool], None]] | None = end, tell
        self.is_head = is_head_of_block(frame)
        self._let_frame_be = at_return_of(frame, self._cell_ends)

    @property
    def is_over(self) -> bool:
        """Whether the guard has ended."""
        return self._open is None

    def _cell_ends(self, by_itself: bool) -> None:
        """The frame that called ``guard`` has returned, or raised."""
        told = f"The {self._place} raised an error."
        self._finish(None if by_itself else RuntimeError(told), self._place)

    def enter(self) -> None:
        """A ``with``, or an exit stack, takes the guard over."""
        self._let_frame_be()
        if self._open is None:
            raise ConfigurationError(
                f"This guard has ended with its {self._place}. Write guard() into the `with` "
                "itself: with guard(protocol): ..."
            )
        before, self._entered = self._entered, True
        self._open[1](before)

    def leave(self, error: BaseException | None) -> None:
        """The block, or the stack, is done."""
        self._finish(error, "block")

    def _finish(self, error: BaseException | None, place: str) -> None:
        if self._open is not None:
            end, self._open = self._open[0], None
            end(error, place)


_BLOCKS: weakref.WeakKeyDictionary[Any, GuardBlock] = weakref.WeakKeyDictionary()
"""The last one of a context."""
_OFFERED: weakref.WeakKeyDictionary[Any, GuardBlock | None] = weakref.WeakKeyDictionary()
_ENTERED: weakref.WeakKeyDictionary[Any, list[GuardBlock | None]] = weakref.WeakKeyDictionary()


def offer(protocol: Any, block: GuardBlock | None) -> None:
    """Let the next ``with`` of this context take over a guard; ``None``: it changes nothing, for
    the guard is another one's, or lasts as long as its function.
    """
    kind = type(protocol)
    if not hasattr(kind, "__enter__"):
        kind.__enter__, kind.__exit__ = _enter, _exit
    _OFFERED[protocol] = block
    if block is not None:
        _BLOCKS[protocol] = block


def offer_again(protocol: Any, frame: FrameType) -> None:
    """Another guard of a guarded context, at a top level.

    Inside a ``with`` it changes nothing. Otherwise whoever takes it up holds the guard that goes
    on: a set-up cell that runs again has lost the exit stack that held it.
    """
    block = _BLOCKS.get(protocol)
    holds = block is None or block.is_over or block.is_head or is_head_of_block(frame)
    offer(protocol, None if holds else block)


def is_head_of_block(frame: FrameType) -> bool:
    """Whether the call that this frame is making stands right behind a ``with``."""
    coming = (one for one in dis.get_instructions(frame.f_code) if one.offset > frame.f_lasti)
    names = (one.opname for one in coming if one.opname not in ("CACHE", "COPY", "NOP"))
    return next(names, "") in ("BEFORE_WITH", "SETUP_WITH", "LOAD_SPECIAL")


def _enter(protocol: Any) -> Any:
    if protocol not in _OFFERED:
        raise TypeError(f"A {type(protocol).__name__} goes into no `with` without a guard.")
    block = _OFFERED.pop(protocol)
    if block is not None:
        block.enter()
    _ENTERED.setdefault(protocol, []).append(block)
    return protocol


def _exit(
    protocol: Any, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType
) -> None:
    block = _ENTERED[protocol].pop()
    if block is not None:
        block.leave(error)
