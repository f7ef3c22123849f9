"""What experiments run in: options, data sets, models, and where pictures go."""

from __future__ import annotations

import hashlib
import json
import shutil
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import aegis_ot
from aegis_ot.errors import ConfigurationError, DatasetError
from aegis_ot.progress import Progress
from aegis_ot.simulation import SessionParameters
from aegis_ot.vision.dataset import Dataset, load_dataset
from aegis_ot.vision.dataset_checks import in_data_sets
from aegis_ot.worldmodel.fitting import fit_model
from aegis_ot_lab.found_tips import FoundTips, find_tips

from ..drawing import write_dataset

if TYPE_CHECKING:
    from aegis_ot.llm import Backend

SIZE = (960, 540)
"""Of simulated frames of drawn cameras, px: that of the rendered sets."""

VIEWS = {
    "webcam": "one camera for all plates, after a measured 640x480 webcam before an OT-2",
    "drawn": "camera, light and deck drawn anew for each plate",
}
"""Simulated sets: the paper's plates were seen by one camera; the other is harder."""

PIPETTES = ("p1000", "p20")


@dataclass(frozen=True)
class ReproductionOptions:
    """What the user asked for.

    Attributes:
        out: Folder for the page, the JSON and the pictures.
        seed: Of bootstraps, simulated data and simulated runs.
        data: Trajectory data sets in the simulated ones' place, by their pipette.
        models: Models by name; they need no answer for what is not asked of them.
        plates: Of a simulated set.
        replicates: Of each cell of the live matrix.
        wells: Of the plate on which the routed fraction is measured.
    """

    out: Path
    seed: int = 0
    data: tuple[Path, ...] = ()
    models: tuple[str, ...] = ()
    plates: int = 16
    replicates: int = 5
    wells: int = 96


def label(source: str) -> str:
    """What results on a data set are called."""
    return "simulated" if source == "synthetic" else source


@dataclass
class Context:
    """What an experiment gets.

    Args:
        options: What the user asked for.
        backends: The models of ``options``, in order.
        progress: Told how far it is.
    """

    options: ReproductionOptions
    backends: Sequence[Backend] = ()
    progress: Progress = field(default_factory=Progress)
    _sets: dict[str, list[Dataset]] = field(default_factory=dict, init=False)
    _tips: dict[str, list[tuple[Dataset, FoundTips]]] = field(default_factory=dict, init=False)

    def option(self, name: str) -> Any:
        """An option as it decides about a result, in plain values."""
        if name == "data":
            return [_fingerprint(folder) for folder in self.options.data]
        value = getattr(self.options, name)
        return list(value) if isinstance(value, tuple) else value

    def tips(self, pipette: str) -> list[tuple[Dataset, FoundTips]]:
        """Data sets of a pipette with the tip in every frame; found once for all experiments."""
        if pipette not in self._tips:
            self._tips[pipette] = [
                (data, find_tips(data, "default", self.progress)) for data in self.sets(pipette)
            ]
        return self._tips[pipette]

    def sets(self, pipette: str) -> list[Dataset]:
        """Data sets of a pipette: the user's, else simulated ones (:data:`VIEWS`)."""
        if pipette not in self._sets:
            self._sets[pipette] = self.given[pipette] or [
                self._simulated(pipette, view) for view in VIEWS
            ]
        return self._sets[pipette]

    @cached_property
    def given(self) -> Mapping[str, list[Dataset]]:
        """The user's data sets by pipette.

        Raises:
            DatasetError: One is faulty, of several pipettes, or of one that the paper does not use.
        """
        sets: dict[str, list[Dataset]] = {pipette: [] for pipette in PIPETTES}
        for folder in self.options.data:
            data = load_dataset(folder)
            used = {in_data_sets(record.pipette) for record in data.records}
            if len(used) != 1 or not used <= set(PIPETTES):
                held = ", ".join(sorted(used)) or "nothing"
                raise DatasetError(
                    f"--data {folder}: holds trajectories of {held}; a set for this command is of "
                    f"one pipette, {' or '.join(PIPETTES)}."
                )
            sets[used.pop()].append(data)
        return sets

    def describe(self, data: Dataset) -> str:
        """What a result on a set stands on."""
        told = f"{len(data.records)} trajectories on {len(data.plates)} plates"
        if data.source == "synthetic" and not self.options.data:
            told += f", seed {data.meta['seed']}, {VIEWS[data.name.rpartition('-')[2]]}"
        return f"{label(data.source)}: {data.name}, {told}"

    def pictures(self, experiment: str) -> Path:
        """An empty folder for an experiment's pictures."""
        folder = self.options.out / "pictures" / experiment
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        return folder

    def picture(self, file: Path) -> str:
        """A picture's path as the outcome names it."""
        return file.relative_to(self.options.out).as_posix()

    def papers_model(self) -> Path:
        """The paper's world model for the live runs: a PCA of 26 normal wells of their camera."""
        path = self._made("paper-pca.npz")
        if not path.exists():
            self.progress.begin("Fitting the paper's world model", 1)
            with tempfile.TemporaryDirectory() as place:
                number = DATA_SEED + self.options.seed
                session = SessionParameters.bench(number)
                normals = write_dataset(
                    Path(place) / "normals", 13, number, parameters=session, normals_per_plate=2
                )
                path.parent.mkdir(parents=True, exist_ok=True)
                fit_model([normals], path, "pca", measure=False)
            self.progress.step()
        return path

    def _made(self, *names: str) -> Path:
        """Where what is made by this version and seed is kept."""
        digest = version().rpartition("+")[2]
        return self.options.out.joinpath("data", f"seed-{self.options.seed}-{digest}", *names)

    def _simulated(self, pipette: str, view: str) -> Dataset:
        """A simulated set in the paper's shape, made once and kept in the output folder."""
        plates, seed = self.options.plates, self.options.seed
        folder = self._made(f"{plates}-plates", f"simulated-{pipette}-{view}")
        if not folder.exists():
            self.progress.begin(f"Drawing {folder.name}", 1)
            unfinished = folder.with_name(f"{folder.name}.unfinished")
            shutil.rmtree(unfinished, ignore_errors=True)
            # Its own seeds: no model that ships was fitted or tuned on them.
            number = DATA_SEED + seed
            session = SessionParameters.webcam(number) if view == "webcam" else None
            write_dataset(unfinished, plates, number, pipette, size=SIZE, parameters=session)
            unfinished.rename(folder)
            self.progress.step()
        return load_dataset(folder)


DATA_SEED = 260_000
"""Of the simulated sets; ``--seed`` is added. Nothing else uses those from here on."""


def benchmark_folder(name: str) -> Path:
    """A folder of benchmark protocols: of this directory, else of the clone of the package.

    Raises:
        ConfigurationError: There is none.
    """
    clone = Path(aegis_ot.__file__).parents[1]
    for root in (Path.cwd(), clone):
        folder = root / "examples" / name
        if (folder / "labels.json").is_file():
            return folder
    raise ConfigurationError(
        f"The protocols of examples/{name} are not here: run the command in a clone of the "
        "repository (the installed package does not hold them)."
    )


def version() -> str:
    """Version of the package, with a digest of its source: what a kept result was made by."""
    return f"{aegis_ot.__version__}+{_digest_of_source()}"


def source_files() -> list[Path]:
    """What a result is made by: code, prompts, rules, weights and models of both packages."""
    roots = (Path(aegis_ot.__file__).parent, Path(__file__).parents[1])
    kinds = (".py", ".json", ".md", ".onnx", ".npz")
    return [path for root in roots for path in sorted(root.rglob("*")) if path.suffix in kinds]


@cache
def _digest_of_source() -> str:
    digest = hashlib.sha256()
    for path in source_files():
        digest.update(path.name.encode() + path.read_bytes())
    return digest.hexdigest()[:8]


def _fingerprint(folder: Path) -> str:
    """Of what a data set says: its name, and a digest of its tables."""
    digest = hashlib.sha256()
    for name in ("manifest.csv", "meta.json", "boxes.csv"):
        path = folder / name
        digest.update(path.read_bytes() if path.is_file() else b"-")
    return f"{folder.resolve().name} {digest.hexdigest()[:12]}"


def as_json(value: Any) -> str:
    """Plain values as the files of the output folder hold them."""
    return json.dumps(value, indent=1, ensure_ascii=False) + "\n"
