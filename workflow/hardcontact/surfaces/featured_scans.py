"""Groups of substitute scans with bumps or pits that agree with Table 1."""

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import xarray as xr

from hardcontact.base.units import DIMENSIONLESS, NM
from hardcontact.surfaces.features import (
    GAUSSIAN,
    SIGNS,
    Features,
    ScanStatistics,
    add_features,
    expected_rms,
    feature_squares,
    no_features,
    published_statistics,
    sample_features,
    standardized_differences,
)
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.substitute_spectra import sample_permitted_spectrum
from hardcontact.surfaces.substitutes import Substitute, required_targets
from hardcontact.surfaces.synthesis import random_surface, sample_scan

#: Samples of features, of which the nearest to Table 1 is taken: with so many, all numbers are
#: within half a standard error.
CANDIDATES = 100


class FeaturedSurface(NamedTuple):
    """Everything from which scans with features are made."""

    substitute: Substitute  #: Its spectrum is that of the base, before its factor.
    statistics: ScanStatistics

    @property
    def mean_rms_height(self) -> float:
        """The published mean rms height of scans in nm."""
        return float(self.statistics.means[0])

    def sample_features(self, kind: str, scan_count: int, *names: object) -> Features:
        """Sample the features of a surface of a kind: bumps, pits or gaussian."""
        if kind == GAUSSIAN:
            return no_features(self.statistics, scan_count)
        rng = self.substitute.generator(kind, *names, "features")
        grid = self.substitute.grid
        return sample_features(
            rng, self.statistics, scan_count, grid.size, grid.pixel_size, SIGNS[kind]
        )

    def distance_from_table1(self, features: Features) -> float:
        """Return the root sum of squares of the expected `standardized_differences`."""
        added = feature_squares(features.height, features.width, self.substitute.grid.size)
        rms_values = expected_rms(features.base_factor, features.counts, added, self.statistics)
        return float(np.linalg.norm(standardized_differences(rms_values, self.statistics)))

    def sample_scan(self, rng: np.random.Generator, features: Features, count: int) -> HeightMap:
        """Sample a scan with a number of features."""
        substitute = self.substitute
        base = sample_scan(rng, substitute.spectrum, substitute.grid, features.base_factor)
        return add_features(rng, base, features, count)

    def sample_whole_surface(self, number: int, pixels: int, pixel_size: float) -> HeightMap:
        """Sample a periodic surface; bumps if its number is odd, pits if it is even."""
        kind = list(SIGNS)[(number - 1) % len(SIGNS)]
        features = self.sample_features(kind, self.statistics.scan_count, number, "whole surface")
        rng = self.substitute.generator(number, "whole surface")
        base = random_surface(rng, pixels, pixel_size, self.substitute.spectrum)
        base = replace(base, heights=np.float32(features.base_factor) * base.heights)
        rng = self.substitute.generator(number, "whole surface", "features")
        count = rng.poisson(features.number_density * (base.size / 1e3) ** 2)
        return add_features(rng, base, features, count)


def featured_surface(substitute: Substitute) -> FeaturedSurface:
    """Return the surface with features of a substitute; its rms height must be published."""
    scan_count = int(substitute.constants["value"]["scans_per_surface"])
    means = required_targets(substitute).means
    return FeaturedSurface(substitute, published_statistics(means, substitute.table1, scan_count))


def whole_surface(
    substitute: Substitute,
    has_features: bool,
    description: str,
    number: int,
    pixels: int,
    pixel_size: float,
) -> HeightMap:
    """Return a whole surface: with features, or Gaussian with a spectrum that Table 1 permits."""
    if has_features:
        return featured_surface(substitute).sample_whole_surface(number, pixels, pixel_size)
    rng = substitute.generator(number, "permitted spectrum")
    table1, constants = substitute.table1, substitute.constants
    spectrum = sample_permitted_spectrum(rng, description, table1, constants)
    rng = substitute.generator(number, "whole surface")
    return random_surface(rng, pixels, pixel_size, spectrum)


def sample_group(
    surface: FeaturedSurface, kind: str, scan_numbers: Sequence[int], *names: object
) -> tuple[Features, list[HeightMap]]:
    """Sample features of a kind, and scans with these features; `names` name random numbers."""
    features = surface.sample_features(kind, len(scan_numbers), *names)
    scans = []
    for scan_number, count in zip(scan_numbers, features.counts, strict=True):
        rng = surface.substitute.generator(kind, *names, scan_number, "featured scan")
        scans.append(surface.sample_scan(rng, features, count))
    return features, scans


def nearest_group(
    surface: FeaturedSurface, scan_numbers: Sequence[int]
) -> tuple[Features, list[HeightMap]]:
    """Return the scans whose features are nearest to Table 1 among CANDIDATES samples.

    Bumps and pits alternate among the samples. No force enters the choice.
    """
    candidates = []
    for candidate in range(CANDIDATES):
        kind = list(SIGNS)[candidate % len(SIGNS)]
        features = surface.sample_features(kind, len(scan_numbers), scan_numbers[0], candidate)
        candidates.append((surface.distance_from_table1(features), kind, candidate))
    _, kind, candidate = min(candidates)
    return sample_group(surface, kind, scan_numbers, scan_numbers[0], candidate)


def describe_features(features: Features, base_rms_height: float) -> dict[str, xr.Variable]:
    """Return features as variables; the base has `base_rms_height` (nm) for a factor of 1."""
    return {
        "feature_density": xr.Variable((), features.number_density, {"units": "um-2"}),
        "feature_height": xr.Variable((), features.height, NM),
        "feature_width": xr.Variable((), features.width, NM),
        "base_rms_height": xr.Variable((), features.base_factor * base_rms_height, NM),
    }


def featured_group(
    substitute: Substitute, scan_numbers: Sequence[int]
) -> tuple[xr.Dataset, list[HeightMap]]:
    """Return a dataset on the `nearest_group` of scans, and these scans.

    The AFM rows of Table 1, which accepted the features, are met within their uncertainty.
    """
    surface = featured_surface(substitute)
    features, scans = nearest_group(surface, scan_numbers)
    variables = describe_features(features, surface.mean_rms_height)
    variables["feature_count"] = xr.Variable("scan", list(features.counts), DIMENSIONLESS)
    met_rows = substitute.spectrum_data.attrs["table1_rows_met"]
    attributes = {"source": "substitute", "table1_rows_met": met_rows}
    return xr.Dataset(variables, {"scan": list(scan_numbers)}, attributes), scans
