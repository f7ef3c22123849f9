"""The lineage of a run as CSV, and as a research object (RO-Crate 1.1)."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterator, Mapping
from datetime import datetime, timezone
from typing import Any

from ..run_view.lineage import rows_of
from ..vocabulary import csv_cell

_OF_WELL = ("labware", "label", "slot", "well", "read_order", "state", "still_planned")
_OF_DELIVERY = (
    "delivery", "recovers", "at", "line", "pipette", "mount", "nozzle", "tip", "reagent",
    "commanded_ul", "drawn_ul", "drawn_sigma_ul", "left_ul", "left_sigma_ul", "delivered_ul",
    "delivered_sigma_ul", "failure", "reason", "decided_by",
)  # fmt: skip
CRATE = "ro-crate-metadata.json"
_CONTEXT = ["https://w3id.org/ro/crate/1.1/context", {"sha256": "https://schema.org/sha256"}]
_STATUS = {"succeeded": "CompletedActionStatus", None: "ActiveActionStatus"}


def lineage_csv(lineage: Mapping[str, Any]) -> str:
    """One line for each delivery into each well. What a spreadsheet would run is escaped."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\r\n")
    writer.writerow(
        ["run", *_OF_WELL, *(f"delivery_{n}" if n == "state" else n for n in _OF_DELIVERY),
         "delivery_state", "sources", "earlier_deliveries_with_tip", "decisions", "frames"]
    )  # fmt: skip
    for well, delivery in rows_of(lineage):
        values = [
            lineage["run"],
            *(well[name] for name in _OF_WELL),
            *(_moment(delivery[n]) if n == "at" and delivery else delivery.get(n)
              for n in _OF_DELIVERY),
            delivery.get("state"),
            "; ".join(f"{one['well']} of {one['label'] or one['labware']} (slot {one['slot']})"
                      for one in delivery.get("sources", ())),
            " ".join(map(str, delivery.get("earlier_with_tip", ()))),
            "; ".join(_decision(one) for one in delivery.get("decisions", ())),
            " ".join(str(one["sequence"]) for one in delivery.get("frames", ())),
        ]  # fmt: skip
        writer.writerow([csv_cell(value) for value in values])
    return text.getvalue()


def _decision(one: Mapping[str, Any]) -> str:
    return f"{one['outcome']} by {one['by']}" + (f": {one['note']}" if one["note"] else "")


def ro_crate(lineage: Mapping[str, Any], files: Mapping[str, tuple[int, str]]) -> str:
    """The description of a folder that holds a run's lineage.

    Args:
        lineage: See :func:`~aegis_ot.run_view.lineage.lineage_of`.
        files: Size in bytes and SHA-256 of each file beside it, by its path in the folder.

    Returns:
        The text of ``ro-crate-metadata.json``, JSON-LD.
    """
    graph = [
        {
            "@id": CRATE,
            "@type": "CreativeWork",
            "conformsTo": {"@id": "https://w3id.org/ro/crate/1.1"},
            "about": {"@id": "./"},
        },
        *_of_run(lineage, list(files)),
        *(_file(name, size, digest) for name, (size, digest) in files.items()),
    ]
    return json.dumps({"@context": _CONTEXT, "@graph": graph}, ensure_ascii=False, indent=1) + "\n"


def _of_run(lineage: Mapping[str, Any], files: list[str]) -> Iterator[dict[str, Any]]:
    name = str(lineage["title"] or lineage["protocol"] or lineage["run"])
    ended = lineage["finished"] or {}
    outcome = ended.get("outcome")
    people = sorted(
        {one["by"] for _, delivery in rows_of(lineage) for one in delivery.get("decisions", ())}
    )
    yield {
        "@id": "./",
        "@type": "Dataset",
        "name": f"Well lineage of {name}, run {lineage['run']}",
        "description": "Per well what was meant and what happened: sources, volumes, tips, "
        f"verdicts, decisions, frames ({lineage['frames']}).",
        "datePublished": _moment(ended.get("at") or lineage["registered"]),
        "license": {"@id": "#license"},
        "hasPart": [{"@id": file} for file in files],
        "mentions": [{"@id": "#run"}],
    }
    yield {
        "@id": "#license",
        "@type": "CreativeWork",
        "name": "None given",
        "description": "The laboratory's own record; whoever passes it on gives it a licence.",
    }
    yield {
        "@id": "#run",
        "@type": "CreateAction",
        "name": str(lineage["run"]),
        "startTime": _moment(lineage["registered"]),
        **({"endTime": _moment(ended["at"])} if ended else {}),
        "actionStatus": {"@id": f"http://schema.org/{_STATUS.get(outcome, 'FailedActionStatus')}"},
        "instrument": [{"@id": "#robot"}, {"@id": "#protocol"}, {"@id": "#aegis-ot"}],
        "participant": [{"@id": f"#person-{n}"} for n in range(1, len(people) + 1)],
        "result": [{"@id": file} for file in files],
    }
    robot = str(lineage["robot_name"] or lineage["robot"] or "an unnamed robot")
    yield {"@id": "#robot", "@type": "Thing", "name": robot, "description": str(lineage["robot"])}
    yield {
        "@id": "#protocol",
        "@type": "SoftwareSourceCode",
        "name": str(lineage["protocol"] or "unnamed protocol"),
        **({"sha256": lineage["protocol_sha256"]} if lineage["protocol_sha256"] else {}),
    }
    yield {
        "@id": "#aegis-ot",
        "@type": "SoftwareApplication",
        "name": "aegis-ot",
        "softwareVersion": str(lineage["package"] or "unknown"),
    }
    for number, person in enumerate(people, 1):
        yield {"@id": f"#person-{number}", "@type": "Person", "name": person}


def _file(name: str, size: int, digest: str) -> dict[str, Any]:
    kinds = {"csv": "text/csv", "json": "application/json", "jpg": "image/jpeg"}
    return {
        "@id": name,
        "@type": "File",
        "name": name,
        "contentSize": str(size),
        "encodingFormat": kinds[name.rpartition(".")[2]],
        "sha256": digest,
    }


def _moment(at: float) -> str:
    try:
        moment = datetime.fromtimestamp(at, timezone.utc)
    except (ValueError, OverflowError, OSError):  # a moment that no calendar has
        moment = datetime.fromtimestamp(0, timezone.utc)
    return moment.isoformat(timespec="seconds")
