"""The roughness of a substrate and of the sphere in one map and one spectrum.

Gaps depend only on the sum of both heights, so a smooth sphere on the map of both touches like the
rough sphere on the substrate.
"""

from dataclasses import replace

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from hardcontact.base.units import DIMENSIONLESS
from hardcontact.scans.extrapolation import Tail
from hardcontact.scans.reliable_wavelengths import OTHER_BODY
from hardcontact.surfaces.filters import interpolate, lowpass
from hardcontact.surfaces.height_map import HeightMap, mirror_in_float32
from hardcontact.surfaces.spectrum import (
    BIN_CENTRES,
    all_scales_rms,
    nearest_bin,
    spectrum_of_dataset,
)

#: Ratio of the longest wavelength in a bin to that at its centre; a decade has ten bins.
HALF_BIN_RATIO = 10**0.05


def combine_maps(rng: np.random.Generator, substrate: HeightMap, sphere: HeightMap) -> HeightMap:
    """Return the mirrored sum of both mirrored maps, that of the sphere shifted at random."""
    sphere_pixels = round(sphere.size / substrate.pixel_size)
    if sphere_pixels < sphere.pixels:  # Larger pixels cannot show waves below two of them.
        sphere = lowpass(sphere, sphere.size / (sphere_pixels // 2 - 1))
    sphere_heights = interpolate(sphere, sphere_pixels).heights
    scan_pixels = substrate.pixels // 2
    starts = rng.integers(sphere_pixels, size=(2, 1))
    rows, columns = (starts + np.arange(scan_pixels)) % sphere_pixels
    heights = substrate.heights[:scan_pixels, :scan_pixels] + sphere_heights[np.ix_(rows, columns)]
    return mirror_in_float32(replace(substrate, heights=heights))


def combine_spectra(substrate: xr.Dataset, sphere: xr.Dataset) -> xr.Dataset:
    """Return the sum of joined spectra, with the measurements of both bodies.

    In a bin where one body is much smoother, it hardly matters whether that body was measured. So a
    measurement stays reliable in the bins in which its body is the rougher one. The tail of short
    waves comes from the body that is rougher at the shortest of these wavelengths, the roll-off
    from the body that is rougher at the longest.
    """
    substrate_density = spectrum_of_dataset(substrate)(BIN_CENTRES)
    sphere_density = spectrum_of_dataset(sphere)(BIN_CENTRES)
    density = substrate_density + sphere_density
    with np.errstate(invalid="ignore"):
        share = sphere_density / density
    sphere_dominates = sphere_density > substrate_density
    measurements = xr.concat(
        [_limit_to_dominant(substrate, ~sphere_dominates),
         _limit_to_dominant(sphere, sphere_dominates)],
        "measurement", data_vars="minimal", coords="minimal", compat="override",
    )  # fmt: skip
    reliable = measurements["reliable"].values == 1
    if not reliable.any():
        raise ValueError(
            "expected wavelengths at which the rougher of both bodies was measured, found none: "
            "scan surface and sphere at the same wavelengths"
        )
    reliable_measurements = measurements.isel(measurement=reliable.any(axis=1))
    shortest = float(reliable_measurements["shortest_reliable"].min())
    longest = float(reliable_measurements["longest_reliable"].max())
    body_at_shortest = sphere if sphere_dominates[nearest_bin(shortest)] else substrate
    body_at_longest = sphere if sphere_dominates[nearest_bin(longest)] else substrate
    joined_psd = np.where(reliable.any(axis=0), density, np.nan)
    return measurements.assign(
        spectrum=_sum_of_spectra(substrate, sphere),
        joined_psd=substrate["joined_psd"].copy(data=joined_psd),
        sphere_share=("bin_wavevector", share, DIMENSIONLESS),
    ).assign_attrs(
        substrate.attrs
        | {name: body_at_shortest.attrs[name] for name in (*Tail._fields, "tail_known")}
        | {"shortest_measured": shortest, "longest_measured": longest}
        | {"rolloff": body_at_longest.attrs["rolloff"]}
    )


def _limit_to_dominant(body: xr.Dataset, is_dominant: NDArray[np.bool_]) -> xr.Dataset:
    """Return the spectrum of a body, its measurements reliable only where the body dominates."""
    was_reliable = body["reliable"].values == 1
    reliable = was_reliable & is_dominant
    bin_wavelengths = 2 * np.pi / BIN_CENTRES
    shortest = body["shortest_reliable"].values.copy()
    longest = body["longest_reliable"].values.copy()
    limits = body["limited_by"].values.astype(object)
    for index in np.flatnonzero((reliable != was_reliable).any(axis=1)):
        wavelengths = bin_wavelengths[reliable[index]]
        # `limited_by` is what hides waves shorter than the reliable ones.
        if not wavelengths.size or wavelengths.min() > bin_wavelengths[was_reliable[index]].min():
            limits[index] = OTHER_BODY
        if wavelengths.size:
            shortest[index] = max(shortest[index], wavelengths.min() / HALF_BIN_RATIO)
            longest[index] = min(longest[index], wavelengths.max() * HALF_BIN_RATIO)
    return body.assign(
        reliable=body["reliable"].copy(data=reliable.astype("int8")),
        shortest_reliable=body["shortest_reliable"].copy(data=shortest),
        longest_reliable=body["longest_reliable"].copy(data=longest),
        limited_by=("measurement", limits.astype(str)),
    )


def sphere_share(spectra: xr.Dataset, wavelength: float) -> float:
    """Return the sphere's share of the power at a wavelength (nm); NaN for a smooth sphere."""
    if "sphere_share" not in spectra:
        return np.nan
    log_wavevector = np.log(spectra["bin_wavevector"])
    return float(np.interp(np.log(2 * np.pi / wavelength), log_wavevector, spectra["sphere_share"]))


def combine_sampled_spectra(substrate: xr.Dataset, sphere: xr.Dataset) -> xr.Dataset:
    """Return the sum of two sampled spectra.

    ``height_factor``, true over measured heights, is the rms of both factors, weighted by the
    variances of heights.
    """
    bodies = (substrate, sphere)
    variances = [all_scales_rms(spectrum_of_dataset(body))[0] ** 2 for body in bodies]
    squared_factors = [float(body.attrs["height_factor"]) ** 2 for body in bodies]
    factor = float(np.sqrt(np.average(squared_factors, weights=variances)))
    spectrum = _sum_of_spectra(substrate, sphere)
    return xr.Dataset({"spectrum": spectrum}, attrs={"height_factor": factor})


def _sum_of_spectra(substrate: xr.Dataset, sphere: xr.Dataset) -> xr.DataArray:
    return (substrate["spectrum"] + sphere["spectrum"]).assign_attrs(substrate["spectrum"].attrs)
