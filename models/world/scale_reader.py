"""From the shape of a domain's ordered attribute types to checked scales."""

from __future__ import annotations

from collections.abc import Mapping

from models.world.degrees import Scale
from models.world.limits import MAX_SYNONYMS
from models.world.name_faults import name_fault
from models.world.names import hint
from models.world.report import Report
from models.world.specs import OrderSpec


def read_scales(
    ordered: Mapping[str, OrderSpec], attributes: Mapping[str, tuple[str, ...]], report: Report
) -> dict[str, Scale]:
    """The scale of each ordered attribute type; faults go to the report (rooted at the domain)."""
    for kind, order in ordered.items():
        if kind not in attributes:
            report.add(["ordered", kind], f"there is no attribute type {kind}{hint(kind, attributes)}")
        elif len(attributes[kind]) < 2:
            report.add(["ordered", kind], f"{kind} has fewer than two values, so there is nothing to compare")
        for end, adjectives in (("less", order.less), ("more", order.more)):
            if len(adjectives) > MAX_SYNONYMS:
                report.add(["ordered", kind, end], f"at most {MAX_SYNONYMS} entries")
            for index, adjective in enumerate(adjectives[:MAX_SYNONYMS]):
                if fault := name_fault(adjective) or _fault(kind, end, adjective, order, attributes):
                    report.add(["ordered", kind, end, index], fault)
    return {
        kind: Scale(kind, attributes.get(kind, ()), tuple(order.less), tuple(order.more))
        for kind, order in ordered.items()
    }


def _fault(
    kind: str, end: str, adjective: str, order: OrderSpec, attributes: Mapping[str, tuple[str, ...]]
) -> str | None:
    if end == "more" and adjective in order.less:
        return f"{adjective} cannot be both less and more"
    return f"{adjective} is a value of {kind} itself" if adjective in attributes.get(kind, ()) else None
