"""Roughness of scans, and of all surfaces in one table: Table 1 and the PSDs."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from hardcontact.numbers.statistics import student_interval, with_interval
from hardcontact.records.dataset import stack
from hardcontact.records.origin import canonical
from hardcontact.surfaces.height_map import METRICS, HeightMap, metrics, table1_variables
from hardcontact.surfaces.spectrum import Floats, all_scales_moments, measured_psds, spectrum_from


def measured_roughness(scan: HeightMap) -> xr.Dataset:
    """Return the METRICS of one levelled scan and its PSDs, profile (nm³) and isotropic (nm⁴)."""
    values = metrics(scan)
    wavevector, profile, isotropic = measured_psds(scan)
    return xr.Dataset(
        {
            **{
                name: ((), values[name], {"units": unit, "long_name": long_name})
                for name, (unit, long_name) in METRICS.items()
            },
            "psd_profile": ("wavevector", profile, {"units": "nm3", "long_name": "1D PSD"}),
            "psd_isotropic": ("wavevector", isotropic, {"units": "nm4", "long_name": "2D PSD"}),
        },
        {"wavevector": ("wavevector", wavevector, {"units": "rad nm-1"})},
    )


def averages(scans: xr.Dataset, confidence: float) -> xr.Dataset:
    """Return mean, standard deviation and interval of the mean over scans, of every metric.

    The METRICS (surface, scan) are NaN where a surface has no such scan. <metric>_mean and
    <metric>_std are over surface, <metric>_mean_interval is over (surface, bound), by Student's t
    over scans.
    """
    variables: dict[str, Any] = {}
    for name in METRICS:
        values = scans[name]
        mean, deviation = values.mean("scan"), values.std("scan", ddof=1)
        interval = student_interval(values, confidence, "scan")
        variables |= with_interval(
            f"{name}_mean", ["surface"], mean.values, interval.values, values.attrs, confidence
        )
        variables[f"{name}_std"] = ("surface", deviation.values, values.attrs)
    return xr.Dataset(variables)


def roughness_table(
    scans: Mapping[tuple[str, int], xr.Dataset],
    spectra: Mapping[str, xr.Dataset],
    conditionings: Mapping[str, xr.Dataset],
    examples: Mapping[str, xr.Dataset],
    *,
    labels: Mapping[str, str],
    basis: Mapping[str, str],
    sphere_surface: str,
    reference_surface: str,
    table1: Mapping[str, str],
    confidence: float,
) -> xr.Dataset:
    """Return the topography of all surfaces: every scan, averages, spectra, maps for pictures.

    All are by surface: the scans, of `measured_roughness`, by surface and number; C_iso over all
    scales; the `conditioning.conditioned_group` of substitutes; one levelled scan of each, that of
    a rough sphere with the variable `as_scanned`; names in print and the basis, ``"measured"`` or
    ``"substitute"``. The sphere surface is that of the sphere, the reference surface that which
    forces are compared with; `table1` is what slope and curvature of Table 1 are, as of
    `topography.table1_variables`. The table is over surface, scan, wavevector; its maps are over
    (surface, row, column).
    """
    names = list(dict.fromkeys(surface for surface, _ in scans))
    stacked = stack(scans, ["surface", "scan"])
    table = xr.merge(
        [
            stacked,
            averages(stacked, confidence),
            _joined_spectra([spectra[name] for name in names], stacked["wavevector"].values),
            _maps([examples[name] for name in names]),
        ],
        combine_attrs="override",
    )
    return table.assign(
        psd_profile_mean=stacked["psd_profile"].mean("scan", keep_attrs=True),
        psd_isotropic_mean=stacked["psd_isotropic"].mean("scan", keep_attrs=True),
        label=("surface", [labels[name] for name in names]),
        basis=("surface", [basis[name] for name in names]),
        calibrated_to_table1=(
            "surface",
            [
                conditionings.get(name, spectra[name]).attrs["calibrated_to_table1"]
                for name in names
            ],
        ),
    ).assign_attrs(
        sphere_surface=sphere_surface,
        reference_surface=reference_surface,
        confidence=confidence,
        table1_variables=canonical(table1_variables(**table1)),
    )


def _joined_spectra(spectra: list[xr.Dataset], wavevector: Floats) -> xr.Dataset:
    """Return spectra (surface, wavevector) and their moments over all scales."""
    tables = [spectrum_from(one) for one in spectra]
    height, gradient, half_laplacian = np.array([all_scales_moments(one) for one in tables]).T
    density = np.array([table(wavevector) for table in tables])
    return xr.Dataset(
        {
            "spectrum": (("surface", "wavevector"), density, {"units": "nm4"}),
            "all_scales_rms_height": ("surface", height, {"units": "nm"}),
            "all_scales_rms_gradient": ("surface", gradient, {"units": "1"}),
            "all_scales_rms_profile_slope": ("surface", gradient / np.sqrt(2), {"units": "1"}),
            "all_scales_rms_half_laplacian": ("surface", half_laplacian, {"units": "nm-1"}),
            "all_scales_rms_laplacian": ("surface", 2 * half_laplacian, {"units": "nm-1"}),
        }
    )


def _maps(examples: list[xr.Dataset]) -> xr.Dataset:
    """Return maps for pictures, all on the pixels of the coarsest; sizes of scans and pixels.

    Of a rough sphere there is its scan with its shape, too.
    """
    pixels = min(len(example["x"]) for example in examples)
    pixel_sizes = [example["heights"].attrs["pixel_size"] for example in examples]
    sizes = [len(example["x"]) * size for example, size in zip(examples, pixel_sizes, strict=True)]
    maps = [_thinned(example["heights"].values, pixels) for example in examples]
    found = xr.Dataset(
        {
            "example_heights": (("surface", "row", "column"), np.array(maps), {"units": "nm"}),
            "scan_size": ("surface", sizes, {"units": "nm"}),
            "pixel_size": ("surface", pixel_sizes, {"units": "nm"}),
        }
    )
    for example in examples:
        if "as_scanned" in example:
            scanned = _thinned(example["as_scanned"].values, pixels)
            found["sphere_as_scanned"] = (("row", "column"), scanned, {"units": "nm"})
    return found


def _thinned(heights: np.ndarray, pixels: int) -> np.ndarray:
    """Return pixels x pixels of a square map, evenly spaced."""
    chosen = np.linspace(0, heights.shape[0] - 1, pixels).round().astype(int)
    return np.asarray(heights[np.ix_(chosen, chosen)])
