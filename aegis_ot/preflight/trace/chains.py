"""Chains of wells that each feed the next, whatever they are for."""

from __future__ import annotations

from collections.abc import Sequence

from .model import Transfer, Well


def chains_of(links: Sequence[Transfer]) -> list[list[Transfer]]:
    """Groups of links that are joined into chains.

    A well that feeds many others, or is fed by many, is a stock or a pool, and joins nothing.
    """
    fed: dict[Well, set[Well]] = {}
    feeds: dict[Well, set[Well]] = {}
    for link in links:
        feeds.setdefault(link.source, set()).add(link.well)
        fed.setdefault(link.well, set()).add(link.source)
    parent: dict[Well, Well] = {}

    def root(well: Well) -> Well:
        parent.setdefault(well, well)
        while parent[well] is not well:
            parent[well] = parent[parent[well]]
            well = parent[well]
        return well

    kept = [
        link
        for link in links
        if len(fed[link.well]) <= 2 and (len(feeds[link.source]) <= 2 or not link.source.prefilled)
    ]
    for link in kept:
        parent[root(link.source)] = root(link.well)
    groups: dict[Well, list[Transfer]] = {}
    for link in kept:
        groups.setdefault(root(link.source), []).append(link)
    return list(groups.values())
