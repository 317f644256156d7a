"""Substitute scans with features, bumps or pits on a Gaussian base, that agree with Table 1.

A Gaussian surface has nearly the same rms height in each scan. On polished UNCD rms heights scatter
much more, which rare features would explain. All features of a surface have one Gaussian shape.

Table 1 does not determine their density, height and width, so features are sampled until Table 1
permits them. They are judged by the rms values that their scans are expected to have, so no scan is
made until they are chosen. Scans of the study take the nearest to Table 1 of many permitted
features. Other surfaces, such as the candidates of sets, take the first permitted features.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import ArrayLike

from hardcontact.base.arrays import Floats
from hardcontact.base.progress import progress
from hardcontact.base.units import DIMENSIONLESS, NM
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.metrics import TABLE1_METRICS
from hardcontact.surfaces.substitute_spectra import sample_permitted_spectrum
from hardcontact.surfaces.substitutes import Substitute, required_targets
from hardcontact.surfaces.synthesis import ScanGrid, random_surface, sample_scan

#: Signs of the heights of features, by their kind.
FEATURE_SIGNS = {"bumps": 1, "pits": -1}
#: The kind of a surface without features.
GAUSSIAN = "gaussian"
FEATURE_KINDS = (*FEATURE_SIGNS, GAUSSIAN)
#: Number of features per µm². These four ranges are assumed, and the prior is uniform in their
#: logarithms. If densities began at 0.001, 15 % of the permitted bumps of polished UNCD would be
#: rarer than 0.01.
DENSITY_BOUNDS = (0.01, 10.0)
#: Height of features relative to the published mean rms height of scans.
HEIGHT_BOUNDS = (1.0, 60.0)
#: Width of features in nm.
WIDTH_BOUNDS = (20.0, 300.0)
#: Factor on the heights of the base: its rms height relative to the published mean of scans.
BASE_FACTOR_BOUNDS = (0.2, 1.2)
#: Smallest width in pixels: the pixels then resolve the curvature of a feature to 4 %.
MIN_WIDTH_PIXELS = 2.5
#: Largest number of tries until Table 1 permits features, and tries that are sampled at a time.
MAX_TRIES = 200_000
TRIES_AT_ONCE = 1000
#: Number of permitted samples, of which the nearest to Table 1 is taken: with so many, the nearest
#: differs by half a standard error at most.
PERMITTED_SAMPLES = 100


def alternating_feature_kind(index: int) -> str:
    """Return bumps for an even index, pits for an odd index."""
    return list(FEATURE_SIGNS)[index % len(FEATURE_SIGNS)]


class ScanStatistics(NamedTuple):
    """Means and standard deviations over scans, and the rms height over all scales."""

    means: Floats  #: (3,) of rms height (nm), slope and curvature (1/nm).
    stds: Floats  #: (3,) in the same units.
    scan_count: int  #: Number of the published scans.
    all_rms_height: float  #: Published rms height (nm) over all scales.


class Features(NamedTuple):
    """The features of a surface and the amplitude of the base under them."""

    number_density: float  #: Per µm².
    height: float  #: In nm, negative for pits.
    width: float  #: Standard deviation of the Gaussian shape in nm.
    base_factor: float  #: Factor on the heights of the base.
    counts: tuple[int, ...]  #: Number of features on each scan.


def published_statistics(
    means: Mapping[str, float], table1: pd.DataFrame, scan_count: int
) -> ScanStatistics:
    """Return statistics with given means, and deviations relative to the means as in Table 1."""
    rows = table1.loc[list(TABLE1_METRICS)]
    rms_means = np.array([means[name] for name in TABLE1_METRICS.values()])
    stds = rms_means * (rows["uncertainty"] / rows["value"]).to_numpy(float)
    return ScanStatistics(rms_means, stds, scan_count, float(table1["value"]["all_rms_height"]))


def feature_squares(height: ArrayLike, width: ArrayLike, size: float) -> Floats:
    """Return the increase of the squared rms values (..., 3) of a levelled scan by one feature.

    By Campbell's theorem, features at random positions add up the mean squares of single ones. A
    feature h exp(-r²/2w²) on a scan of the width L has the mean square pi h² w²/L². Its gradient
    has pi h²/L², and its half-Laplacian pi h²/(2 w² L²). All are smaller here, because features may
    lie partly outside the scan, and levelling removes some of their height. For example, a feature
    of h = 100 nm and w = 50 nm has 12.6 nm² on 2.5 µm, of which 12.1 nm² remain.
    """
    height, width = np.asarray(height), np.asarray(width)
    # The squared shape, exp(-x²/w²) along an axis, lies w/sqrt(pi) from its centre on average.
    # As centres are uniform in the scan, the mean share w/(sqrt(pi) L) of squared heights lies
    # outside along each axis. The same share of squared derivatives is assumed.
    slope_square = (1 - width / (np.sqrt(np.pi) * size)) ** 2 * np.pi * height**2 / size**2
    # Levelling removes a mean and two slopes, each with the squared mean height of a feature.
    removed = 3 * (2 * np.pi * height * width**2 / size**2) ** 2
    height_square = np.maximum(slope_square * width**2 - removed, 0.0)
    return np.stack([height_square, slope_square, slope_square / (2 * width**2)], axis=-1)


def featured_rms(
    base_factor: ArrayLike, counts: ArrayLike, added: Floats, statistics: ScanStatistics
) -> Floats:
    """Return the expected rms height, slope and curvature of scans with features: (..., scan, 3).

    `counts` (..., scan) are numbers of features, `added` (..., 3) the `feature_squares` of each.
    """
    base_rms = np.asarray(base_factor)[..., None, None] * statistics.means
    squares: Floats = base_rms**2 + np.asarray(counts)[..., None] * added[..., None, :]
    return np.sqrt(squares)


def standardized_differences(rms_values: Floats, statistics: ScanStatistics) -> Floats:
    """Return the differences of scans (..., scan, 3) from statistics, in standard errors.

    The three means come first, then, for several scans, the deviations of rms height and slope,
    whose relative standard errors are 1/sqrt(2(n - 1)).
    """
    mean_errors = statistics.stds / np.sqrt(statistics.scan_count)
    mean_differences = (rms_values.mean(axis=-2) - statistics.means) / mean_errors
    if rms_values.shape[-2] < 2:
        return np.asarray(mean_differences)
    ratios = rms_values.std(axis=-2, ddof=1)[..., :2] / statistics.stds[:2]
    std_differences = (ratios - 1) * np.sqrt(2 * (statistics.scan_count - 1))
    return np.concatenate([mean_differences, std_differences], axis=-1)


def sample_permitted_features(
    rng: np.random.Generator, statistics: ScanStatistics, scan_count: int, grid: ScanGrid, sign: int
) -> Features:
    """Sample features until Table 1 permits them: no `standardized_differences` exceeds one.

    Density, height, width and base factor are uniform in their logarithms within the bounds. The
    number of features on each scan has a Poisson distribution.
    """
    min_width = max(WIDTH_BOUNDS[0], MIN_WIDTH_PIXELS * grid.pixel_size)
    bounds = (DENSITY_BOUNDS, HEIGHT_BOUNDS, (min_width, WIDTH_BOUNDS[1]), BASE_FACTOR_BOUNDS)
    log_low, log_high = np.log(bounds).T
    for _ in range(MAX_TRIES // TRIES_AT_ONCE):
        samples = np.exp(rng.uniform(log_low, log_high, (TRIES_AT_ONCE, 4)))
        number_density, relative_height, width, base_factor = samples.T
        mean_counts = number_density[:, None] * (grid.size / 1e3) ** 2
        counts = rng.poisson(mean_counts, (TRIES_AT_ONCE, scan_count))
        height = sign * relative_height * statistics.means[0]
        added = feature_squares(height, width, grid.size)
        rms_values = featured_rms(base_factor, counts, added, statistics)
        differences = np.abs(standardized_differences(rms_values, statistics))
        is_permitted = (differences <= 1).all(axis=-1)
        if is_permitted.any():
            index = int(np.argmax(is_permitted))
            return Features(
                number_density=number_density[index].item(),
                height=height[index].item(),
                width=width[index].item(),
                base_factor=base_factor[index].item(),
                counts=tuple(counts[index].tolist()),
            )
    raise ValueError(
        "config key substitutes.featured_surface: expected features that give rms heights of "
        f"{statistics.means[0]:.3g} ± {statistics.stds[0]:.3g} nm, found none in "
        f"{MAX_TRIES} tries: set it to none"
    )


def add_features(
    rng: np.random.Generator, height_map: HeightMap, features: Features, count: int
) -> HeightMap:
    """Add features at random positions; they reach over the borders of a periodic surface."""
    position = (np.arange(height_map.pixels) + 0.5) * height_map.pixel_size
    centres = rng.uniform(0, height_map.size, (2, count, 1))
    distance = position - centres
    if height_map.periodic:
        distance = (distance + height_map.size / 2) % height_map.size - height_map.size / 2
    shape_y, shape_x = np.exp(-(distance**2) / (2 * features.width**2))
    feature_heights = (features.height * shape_y.T) @ shape_x
    heights = height_map.heights + feature_heights.astype(height_map.heights.dtype)
    return replace(height_map, heights=heights)


class FeaturedSurface(NamedTuple):
    """A substitute, and the statistics with which its scans with features agree."""

    substitute: Substitute  #: Its spectrum is that of the base, before the base factor.
    statistics: ScanStatistics

    def sample_features(self, feature_kind: str, scan_count: int, *seed_words: object) -> Features:
        """Sample features of a kind; GAUSSIAN has none, only a base factor."""
        if feature_kind == GAUSSIAN:  # The base alone has the published rms height over all scales.
            base_factor = self.statistics.all_rms_height / float(self.statistics.means[0])
            return Features(0.0, 0.0, np.nan, base_factor, (0,) * scan_count)
        grid = self.substitute.grid
        rng = self.substitute.generator(feature_kind, *seed_words, "features")
        sign = FEATURE_SIGNS[feature_kind]
        return sample_permitted_features(rng, self.statistics, scan_count, grid, sign)

    def to_variables(self, features: Features) -> dict[str, xr.Variable]:
        """Return features without counts, and the rms height of the base, as variables."""
        base_rms_height = features.base_factor * float(self.statistics.means[0])
        return {
            "feature_density": xr.Variable((), features.number_density, {"units": "um-2"}),
            "feature_height": xr.Variable((), features.height, NM),
            "feature_width": xr.Variable((), features.width, NM),
            "base_rms_height": xr.Variable((), base_rms_height, NM),
        }


def featured_surface(substitute: Substitute) -> FeaturedSurface:
    """Return the surface with features of a substitute whose rms height is published."""
    scan_count = int(substitute.constants["value"]["scans_per_surface"])
    means = required_targets(substitute).means
    return FeaturedSurface(substitute, published_statistics(means, substitute.table1, scan_count))


def whole_surfaces(
    substitute: Substitute, description: str, parameters: Mapping[str, Any]
) -> Iterator[tuple[int, HeightMap]]:
    """Yield the numbers of whole surfaces of a job, each with its `whole_surface`."""
    numbers = parameters["surface_numbers"]
    for number in progress(numbers, len(numbers), "surfaces"):
        yield (
            number,
            whole_surface(
                substitute, parameters["has_features"], description, number, **parameters["grid"]
            ),
        )


def whole_surface(
    substitute: Substitute,
    has_features: bool,
    description: str,
    surface_number: int,
    pixels: int,
    pixel_size: float,
) -> HeightMap:
    """Return a periodic surface: with features, or Gaussian with a spectrum that Table 1 permits.

    Surfaces of odd numbers have bumps, of even numbers pits. `description` is a path.
    """
    rng = substitute.generator(surface_number, "whole surface")
    if not has_features:
        spectrum_rng = substitute.generator(surface_number, "permitted spectrum")
        spectrum = sample_permitted_spectrum(
            spectrum_rng, description, substitute.table1, substitute.constants
        )
        return random_surface(rng, pixels, pixel_size, spectrum)
    featured = featured_surface(substitute)
    feature_kind = alternating_feature_kind(surface_number - 1)
    scan_count = featured.statistics.scan_count
    features = featured.sample_features(feature_kind, scan_count, surface_number, "whole surface")
    base = random_surface(rng, pixels, pixel_size, substitute.spectrum)
    base = replace(base, heights=np.float32(features.base_factor) * base.heights)
    feature_rng = substitute.generator(surface_number, "whole surface", "features")
    count = feature_rng.poisson(features.number_density * (base.size / 1e3) ** 2)
    return add_features(feature_rng, base, features, count)


def sample_featured_scans(
    featured: FeaturedSurface, feature_kind: str, scan_numbers: Sequence[int], *seed_words: object
) -> tuple[Features, list[HeightMap]]:
    """Sample features of a kind, and scans with them; `seed_words` choose the random numbers."""
    substitute = featured.substitute
    features = featured.sample_features(feature_kind, len(scan_numbers), *seed_words)
    scans = []
    for scan_number, count in zip(scan_numbers, features.counts, strict=True):
        rng = substitute.generator(feature_kind, *seed_words, scan_number, "featured scan")
        base = sample_scan(rng, substitute.spectrum, substitute.grid, features.base_factor)
        scans.append(add_features(rng, base, features, count))
    return features, scans


def nearest_featured_scans(
    featured: FeaturedSurface, scan_numbers: Sequence[int]
) -> tuple[Features, list[HeightMap]]:
    """Return the features nearest to Table 1 among PERMITTED_SAMPLES, and scans with them.

    The nearest have the smallest sum of squared `standardized_differences`.
    """
    choices = []
    scan_count = len(scan_numbers)
    first_number = scan_numbers[0]  # It seeds the features of a batch of scans.
    for sample_number in range(PERMITTED_SAMPLES):
        feature_kind = alternating_feature_kind(sample_number)
        features = featured.sample_features(feature_kind, scan_count, first_number, sample_number)
        added = feature_squares(features.height, features.width, featured.substitute.grid.size)
        rms_values = featured_rms(features.base_factor, features.counts, added, featured.statistics)
        differences = standardized_differences(rms_values, featured.statistics)
        choices.append((float(np.linalg.norm(differences)), feature_kind, sample_number))
    _, feature_kind, sample_number = min(choices)
    return sample_featured_scans(featured, feature_kind, scan_numbers, first_number, sample_number)


def make_featured_scans(
    substitute: Substitute, scan_numbers: Sequence[int]
) -> tuple[xr.Dataset, list[HeightMap]]:
    """Return a dataset of the features of the `nearest_featured_scans`, and these scans."""
    featured = featured_surface(substitute)
    features, scans = nearest_featured_scans(featured, scan_numbers)
    variables = featured.to_variables(features)
    variables["feature_count"] = xr.Variable("scan", list(features.counts), DIMENSIONLESS)
    met_rows = substitute.spectrum_data.attrs["table1_rows_met"]
    attributes = {"source": "substitute", "table1_rows_met": met_rows}
    return xr.Dataset(variables, {"scan": list(scan_numbers)}, attributes), scans
