"""Fit a camera's pose to the places at which the robot held a tip.

Nonlinear least squares with a robust loss (Cauchy: a wrong detection counts little), from several
starting poses; weak priors keep what the places do not tell near what cameras beside a robot are
like (Hartley and Zisserman, *Multiple View Geometry*, chapters 6 and 7).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from ..tips import TIPS
from .pinhole import POSE, CameraModel
from .registered import Floats, Registration, Sighting, project_ends, with_slopes

FEWEST = 4
"""Sightings from which a pose is fitted; with fewer the priors would speak."""

_SPREAD_MM = 5.0
"""The places must lie so far apart, mm."""

_NOISE = 1 / 300
"""Standard deviation of a detected end, frame heights: 1.6 px of 480."""

_HIDDEN = 4.0
"""How much worse an orifice is seen that stands in labware, times."""

_AGREES = 5.0
"""Distance up to which an end agrees with a pose, standard deviations."""

_AZIMUTHS = np.radians((-90.0, -45.0, 0.0, 45.0, 90.0))
_ELEVATIONS = np.radians((5.0, 30.0))
_FOCALS = (0.9, 1.8)
_STARTS = 3
"""Starting poses that are followed, of those that fit best before."""

_PRIOR = np.array((0.0, 0.2, np.log(500.0), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0))
_PRIOR_SIGMA = np.array((3.0, 0.4, 0.6, 0.05, 0.6, 0.6, 0.5, 0.03, 0.02))
_FOCAL = 1.4
"""Most likely focal length, frame widths; the priors are of azimuth, elevation (radians), logarithm
of the distance, roll, place of the pivot, logarithm of the focal length, distortion, lean."""

_LENGTH_SIGMA = 0.08
"""Standard deviation of a tip's visible length about its maker's, as a share."""


@dataclass(frozen=True)
class _Problem:
    camera: CameraModel
    places: Floats
    kinds: NDArray[np.intp]
    seen: Floats
    weights: Floats
    prior: Floats
    prior_sigma: Floats

    def residuals(self, parameters: Floats) -> Floats:
        """Differences in standard deviations, ends first, then the priors: ``(..., residuals)``."""
        ends = project_ends(self.camera, parameters, self.places, self.kinds)
        off = np.nan_to_num((ends - self.seen) * self.weights[:, :, None], nan=1e4)
        off = off.reshape(*parameters.shape[:-1], -1)
        return np.concatenate((off, (parameters - self.prior) / self.prior_sigma), axis=-1)

    def slopes(self, parameters: Floats) -> Floats:
        """Derivatives of the residuals, ``(residuals, parameters)``."""
        return with_slopes(self.residuals, parameters)[1]

    def cost(self, parameters: Floats) -> float:
        return float(np.log1p(self.residuals(parameters) ** 2).sum())


def fit(
    sightings: Sequence[Sighting], size: tuple[int, int], start: Registration | None = None
) -> Registration | None:
    """The camera that saw tips where they were seen.

    Args:
        sightings: Of single tips, at different places on the deck; wrong ones among them are
            borne up to about a third.
        size: Frame width and height, px.
        start: An earlier registration of the same camera, from which the search begins: quicker.

    Returns:
        ``None`` where there are too few sightings, or all lie at one place.
    """
    places = np.array([sighting.position for sighting in sightings], dtype=np.float64)
    if len(sightings) < FEWEST or np.ptp(places, axis=0).max(initial=0.0) < _SPREAD_MM:
        return None
    names = tuple(dict.fromkeys(sighting.tip for sighting in sightings))
    problem = _problem(sightings, places, names, size)
    starts = _known_start(problem, start, names) or _starting_poses(problem)
    scale = np.array((0.1, 0.1, 0.1, 0.02, 0.05, 0.05, 0.1, 0.02, 0.02, *problem.prior[9:] * 0.02))
    found = [
        least_squares(
            problem.residuals,
            first,
            problem.slopes,
            loss="cauchy",
            x_scale=scale,
            max_nfev=60,
            ftol=1e-6,
        )
        for first in starts
    ]
    best = min(found, key=lambda result: float(result.cost))
    return _registration(problem, best.x, names)


def _problem(
    sightings: Sequence[Sighting], places: Floats, names: tuple[str, ...], size: tuple[int, int]
) -> _Problem:
    middle = places.mean(axis=0)
    pivot = (float(middle[0]), float(middle[1]), float(middle[2]))
    camera = CameraModel(size, pivot, *(float(v) for v in _PRIOR[:POSE]))
    seen = np.array([(each.orifice, each.collar) for each in sightings], dtype=np.float64)
    sigma = _NOISE * size[1]
    weights = np.array([(1 / (_HIDDEN if each.hidden else 1.0), 1.0) for each in sightings]) / sigma
    lengths = np.array([TIPS[name].length_mm for name in names])
    prior = np.concatenate((_PRIOR, lengths))
    prior[6] = np.log(_FOCAL * size[0])
    prior_sigma = np.concatenate((_PRIOR_SIGMA, lengths * _LENGTH_SIGMA))
    kinds = np.array([names.index(each.tip) for each in sightings], dtype=np.intp)
    return _Problem(camera, places, kinds, seen, weights, prior, prior_sigma)


def _known_start(
    problem: _Problem, start: Registration | None, names: tuple[str, ...]
) -> list[Floats]:
    """An earlier registration's parameters, written down about this problem's pivot."""
    if start is None or start.camera.size != problem.camera.size:
        return []
    first = problem.prior.copy()
    first[: POSE + 1] = (*start.camera.parameters, start.lean)
    pivot = np.array([problem.camera.pivot])
    depth = float(start.camera.depth(pivot)[0])
    if depth < 1.0:
        return []
    middle = np.array(problem.camera.size) / 2.0
    first[2] = np.log(depth)
    first[4:6] = (start.camera.project(pivot)[0] - middle) / np.exp(start.camera.log_focal)
    for i, name in enumerate(names):
        first[POSE + 1 + i] = start.lengths_mm.get(name, first[POSE + 1 + i])
    return [first]


def _starting_poses(problem: _Problem) -> list[Floats]:
    """The likeliest of a grid of poses; distance and direction follow from the tips themselves."""
    size = np.array(problem.camera.size, dtype=np.float64)
    middle = np.median(problem.seen[:, 0], axis=0) - size / 2
    length_px = np.median(np.hypot(*(problem.seen[:, 0] - problem.seen[:, 1]).T))
    length_mm = float(problem.prior[POSE + 1 :][problem.kinds].mean())
    poses = []
    for azimuth, elevation, wide in product(_AZIMUTHS, _ELEVATIONS, _FOCALS):
        focal = wide * size[0]
        distance = focal * length_mm * np.cos(elevation) / max(float(length_px), 4.0)
        pose = problem.prior.copy()
        pose[:7] = (
            *(azimuth, elevation, np.log(distance), 0.0),
            *(middle[0] / focal, middle[1] / focal, np.log(focal)),
        )
        poses.append(pose)
    return sorted(poses, key=problem.cost)[:_STARTS]


def _registration(problem: _Problem, found: Floats, names: tuple[str, ...]) -> Registration:
    ends = project_ends(problem.camera, found, problem.places, problem.kinds)
    off = np.hypot(*np.moveaxis(ends - problem.seen, -1, 0))
    agrees = off * problem.weights < _AGREES
    slopes = problem.slopes(found)
    residuals = problem.residuals(found)
    # As the Cauchy loss weighs them; the priors count whole.
    shares = 1.0 / (1.0 + residuals**2)
    shares[-len(found) :] = 1.0
    ends_only = residuals[: -len(found)]
    scatter = float((shares[: -len(found)] * ends_only**2).sum() / shares[: -len(found)].sum())
    information = (slopes * shares[:, None]).T @ slopes
    covariance = np.linalg.pinv(information) * max(scatter, 0.1)
    return Registration(
        problem.camera.moved_to(found[:POSE]),
        float(found[POSE]),
        {name: float(found[POSE + 1 + i]) for i, name in enumerate(names)},
        covariance,
        float(np.median(off)),
        len(problem.places),
        float(agrees.mean()),
    )
