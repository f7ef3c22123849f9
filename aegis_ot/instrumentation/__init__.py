"""Taps the instruments of one protocol run, so that others can listen. Robot side."""

from .operation import Event, EventKind, Listener, Operation, OperationKind, Pipette

__all__ = ["Event", "EventKind", "Listener", "Operation", "OperationKind", "Pipette"]
