# SPDX-License-Identifier: MIT
"""Blocks are counted before they are taken apart.

A file of a few kilobytes can stand for more entities than any memory holds: blocks that insert blocks ten times each,
or an array of 32767 by 32767. Counting is one pass over the block definitions, whatever they would expand to.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

_GREATEST = 10**18  #: counts stop here: far beyond any budget, and still a number that everything can hold

Uses = Mapping[str, Sequence[tuple[str, int]]]  #: block to the blocks it inserts, and how many times


@dataclass(frozen=True, slots=True)
class Census:
    """What each block stands for when it is taken apart."""

    entities: dict[str, int]  #: entities that are not inserts, at all depths; cyclic blocks stand for none
    inserts: dict[str, int]  #: inserts at all depths, the price of the way
    cyclic: frozenset[str]  #: blocks that insert themselves, at whatever depth, or lie between two such
    leads: dict[str, str]  #: block to the first cyclic block it reaches, by name
    order: tuple[str, ...]  #: all blocks, every block before those it inserts; without the cyclic ones


def count_blocks(own: Mapping[str, int], uses: Uses) -> Census:
    """Count what every block would expand to.

    Parameters
    ----------
    own : mapping of str to int
        Entities of each block itself.
    uses : mapping of str to sequence of (str, int)
        Blocks that each block inserts, and times; all of them are keys of ``own``.

    Notes
    -----
    Linear in blocks and inserts of the definitions, without recursion: blocks are taken in topological order. What no
    order reaches from below nor from above is cyclic.
    """
    upward = _peel({name: {child for child, _ in uses[name]} for name in own})
    rest = set(own) - set(upward)
    users: dict[str, set[str]] = {name: set() for name in rest}
    for name in rest:
        for child, _ in uses[name]:
            if child in rest:
                users[child].add(name)
    downward = _peel(users)
    cyclic = frozenset(rest - set(downward))
    bottom_up = [*upward, *reversed(downward)]
    entities, inserts, leads = dict.fromkeys(cyclic, 0), dict.fromkeys(cyclic, 0), {name: name for name in cyclic}
    for name in bottom_up:
        total, way, reached = own[name], 0, set()
        for child, times in uses[name]:
            total += times * entities[child]
            way += times * (1 + inserts[child])
            if child in leads:
                reached.add(leads[child])
        entities[name], inserts[name] = min(total, _GREATEST), min(way, _GREATEST)
        if reached:
            leads[name] = min(reached)
    return Census(entities, inserts, cyclic, leads, tuple(reversed(bottom_up)))


def _peel(needs: Mapping[str, set[str]]) -> list[str]:
    # Kahn's order: names whose needs are all met, again and again.
    waiting = {name: len(needed) for name, needed in needs.items()}
    freed: dict[str, list[str]] = {}
    for name, needed in needs.items():
        for other in needed:
            freed.setdefault(other, []).append(name)
    ready = sorted(name for name, count in waiting.items() if count == 0)
    ordered: list[str] = []
    while ready:
        ordered.extend(ready)
        following: list[str] = []
        for name in ready:
            for user in freed.get(name, ()):
                waiting[user] -= 1
                if waiting[user] == 0:
                    following.append(user)
        ready = sorted(following)
    return ordered


def admit(wanted: Mapping[str, int], census: Census, room: int) -> dict[str, int]:
    """Blocks at top level that do not fit, and what one insert of each would expand to.

    Parameters
    ----------
    wanted : mapping of str to int
        Blocks inserted at top level, and times.
    room : int
        Entities that may still be made.

    Returns
    -------
    dict of str to int
        Cyclic blocks count -1. Cheap blocks are admitted first, so that the choice does not depend on the order of
        the file.
    """
    refused = {name: -1 for name in wanted if name in census.cyclic}
    price = {name: max(census.entities[name], census.inserts[name]) for name in wanted if name not in refused}
    for name in sorted(price, key=lambda block: (price[block] * wanted[block], block)):
        total = price[name] * wanted[name]
        if total <= room:
            room -= total
        else:
            refused[name] = census.entities[name] if census.entities[name] * wanted[name] > room else price[name]
    return refused
