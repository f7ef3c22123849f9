"""Lines of Python by room, beside their budgets: ``python -m scripts.sizes``."""

from __future__ import annotations

from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

BUDGETS = {
    "aegis_ot": 78_000,
    "aegis_ot_lab": 10_500,
    "aegis_ot/preflight": 11_080,
    "aegis_ot/vision": 13_050,
    "aegis_ot/sidecar": 9_150,
    "aegis_ot/runtime": 4_140,
}
"""The aims: 50,000 for ``aegis_ot``, 9,500 for ``preflight``, 9,000 for ``vision``."""


def lines_of(folder: str) -> int:
    """Of modules that somebody writes; what is compiled from other files is not counted."""
    texts = (path.read_text("utf-8") for path in (ROOT / folder).rglob("*.py"))
    return sum(len(text.splitlines()) for text in texts if "Do not edit." not in text[:200])


def _rooms(package: str) -> list[str]:
    return [f"{package}/{path.parent.name}" for path in (ROOT / package).glob("*/__init__.py")]


def main() -> None:
    names = [
        name
        for package in ("aegis_ot", "aegis_ot_lab")
        for name in (package, *sorted(_rooms(package)))
    ]
    print(f"{'room':<28}{'lines':>8}{'budget':>9}")
    for name in names:
        budget = f"{BUDGETS[name]:,}" if name in BUDGETS else ""
        print(f"{name:<28}{lines_of(name):>8,}{budget:>9}")


if __name__ == "__main__":
    main()
