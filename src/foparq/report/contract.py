# SPDX-License-Identifier: MIT
"""Under which contract a delivery was made, for every report; and who answers for it, in ISO 19115-3."""

from collections.abc import Callable
from dataclasses import asdict
from typing import Any

from foparq.report.record import AuditRecord
from foparq.report.words import Words, printable

_Node = Any  # lxml publishes no types


def contract_facts(words: Words, record: AuditRecord) -> tuple[tuple[str, str], ...]:
    """Name and value of what the manifest states of the contract, in the order of a form."""
    contract = record.delivery.contract
    stated = {} if contract is None else {name: value for name, value in asdict(contract).items() if value}
    return tuple(
        (words(f"report.contract.{name}"), day(words, value) if name == "date" else printable(value))
        for name, value in stated.items()
    )


def contract_line(words: Words, record: AuditRecord) -> str:
    """The same in one line; empty where nothing is stated."""
    return "; ".join(f"{name}: {value}" for name, value in contract_facts(words, record))


def contract_sentences(words: Words, record: AuditRecord) -> list[str]:
    """The same as sentences: one, or none."""
    line = contract_line(words, record)
    return [f"{line}."] if line else []


def day(words: Words, iso: str) -> str:
    """Calendar day (ISO 8601) as people write it."""
    year, month, number = iso.split("-")
    return words("report.date.day", day=number.lstrip("0"), month=words(f"report.date.month-{month}"), year=year)


def responsible_party(
    record: AuditRecord,
    cit: Any,  # noqa: ANN401 - lxml's maker
    text: Callable[[str], _Node],
    code: Callable[..., _Node],
) -> list[_Node]:
    """``cit:citedResponsibleParty`` of who delivered: the contractor, and in it the person who answers for it.

    Parameters
    ----------
    cit : lxml.builder.ElementMaker
        Of the namespace ``cit``.
    text, code : callable
        Make ``gco:CharacterString`` of a text, and an entry of a code list.
    """
    contract = record.delivery.contract
    if contract is None or not (contract.contractor or contract.responsible):
        return []
    person = [cit.CI_Individual(cit.name(text(contract.responsible)))] if contract.responsible else []
    if contract.contractor:
        party = cit.CI_Organisation(cit.name(text(contract.contractor)), *(cit.individual(one) for one in person))
    else:
        (party,) = person
    role = cit.role(code("CI_RoleCode", "resourceProvider", cit))
    return [cit.citedResponsibleParty(cit.CI_Responsibility(role, cit.party(party)))]
