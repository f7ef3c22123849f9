"""Finds names that lead back to themselves."""

from __future__ import annotations

from collections.abc import Collection, Mapping


def circle_in(leads_to: Mapping[str, Collection[str]]) -> tuple[str, ...]:
    """A way that ends where it begins, ``("a", "b", "a")``; empty if there is none.

    Args:
        leads_to: For each name those that it names; each of them stands there itself.
    """
    left = dict(leads_to)
    while ends := [name for name, others in left.items() if left.keys().isdisjoint(others)]:
        for name in ends:
            del left[name]
    if not left:
        return ()
    way: list[str] = []
    name = next(iter(left))
    while name not in way:
        way.append(name)
        name = next(other for other in left[name] if other in left)
    return (*way[way.index(name) :], name)
