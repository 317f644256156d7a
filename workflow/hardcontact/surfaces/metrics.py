"""Metrics of height maps, such as the rms height, and the table of them for all surfaces."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.base.dataset import stack
from hardcontact.base.statistics import student_interval, with_interval
from hardcontact.base.units import DIMENSIONLESS, NM, NM4, RAD_PER_NM
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.spectrum import all_scales_rms, measured_psds, spectrum_of_dataset

#: Metrics of a height map with their units and long names, in the order of Table 1.
METRICS = {
    "rms_height": ("nm", "rms height"),
    "rms_gradient": ("1", "rms gradient (2D slope)"),
    "rms_profile_slope": ("1", "rms slope of profiles along x"),
    "rms_half_laplacian": ("nm-1", "half the rms Laplacian (mean curvature)"),
    "rms_laplacian": ("nm-1", "rms Laplacian"),
    "skewness": ("1", "skewness of heights"),
    "kurtosis": ("1", "kurtosis of heights (3 for a Gaussian)"),
    "peak_to_valley": ("nm", "peak to valley"),
}
#: The metrics of Table 1, which does not define slope and curvature, by its rows for AFM scans.
TABLE1_METRICS = {
    "afm_rms_height": "rms_height",
    "afm_rms_slope": "rms_gradient",
    "afm_rms_curvature": "rms_half_laplacian",
}


def metrics(scan: HeightMap) -> dict[str, float]:
    """Return the METRICS of a scan.

    Derivatives are finite differences between neighbouring pixels, as in SurfaceTopography, at the
    pixels that have both derivatives.

    Parameters
    ----------
    scan : HeightMap
        Levelled, not periodic.

    Returns
    -------
    dict of str to float
        By name, such as ``rms_height``, in powers of nm.

    Examples
    --------
    >>> scan = hc.read_scan("scan.nc")
    >>> rms_height = hc.metrics(scan)["rms_height"]  # nm
    """
    heights = scan.heights.astype(float)
    pixel_size = scan.pixel_size
    slope_y = np.diff(heights, axis=0)[:, :-1] / pixel_size
    slope_x = np.diff(heights, axis=1)[:-1] / pixel_size
    bend = np.diff(heights, 2, axis=0)[:, 1:-1] + np.diff(heights, 2, axis=1)[1:-1]
    laplacian = float(np.sqrt((bend**2).mean())) / pixel_size**2
    flat_heights = heights.ravel()
    centred = flat_heights - flat_heights.mean()
    square = centred**2
    variance = square.mean()
    return {
        "rms_height": float(flat_heights.std()),
        "rms_gradient": float(np.sqrt((slope_x**2 + slope_y**2).mean())),
        "rms_profile_slope": float(np.sqrt((slope_x**2).mean())),
        "rms_half_laplacian": laplacian / 2,
        "rms_laplacian": laplacian,
        "skewness": float((square * centred).mean() / variance**1.5),
        "kurtosis": float((square**2).mean() / variance**2),
        "peak_to_valley": float(np.ptp(flat_heights)),
    }


#: The variables of topography.nc by the rows of Table 1.
TABLE1_VARIABLES = {row: f"{metric}_mean" for row, metric in TABLE1_METRICS.items()} | {
    row.replace("afm", "all"): f"all_scales_{metric}" for row, metric in TABLE1_METRICS.items()
}


def measured_metrics(scan: HeightMap, names: Iterable[str]) -> xr.Dataset:
    """Return some of the METRICS of a scan, by their names."""
    scan_metrics = metrics(scan)
    variables = {}
    for name in names:
        unit, long_name = METRICS[name]
        variables[name] = ((), scan_metrics[name], {"units": unit, "long_name": long_name})
    return xr.Dataset(variables)


def measured_roughness(scan: HeightMap) -> xr.Dataset:
    """Return the METRICS of a scan, and its PSD over wavevector in nm⁴."""
    wavevector, _, isotropic_psd = measured_psds(scan)
    attributes = NM4 | {"long_name": "C_iso"}
    return measured_metrics(scan, METRICS).assign(
        isotropic_psd=("wavevector", isotropic_psd, attributes),
        wavevector=("wavevector", wavevector, RAD_PER_NM),
    )


def scan_averages(scans: xr.Dataset, confidence: float) -> xr.Dataset:
    """Return for every metric (surface,) the mean over scans, its interval and standard deviation.

    The metrics (surface, scan) are NaN if a surface has fewer scans.
    """
    variables: dict[str, Any] = {}
    for name, values in scans.data_vars.items():
        interval = student_interval(values, confidence, "scan")
        mean = values.mean("scan").values
        variables |= with_interval(
            f"{name}_mean", ["surface"], mean, interval.values, values.attrs, confidence
        )
        variables[f"{name}_std"] = ("surface", values.std("scan", ddof=1).values, values.attrs)
    return xr.Dataset(variables)


def roughness_table(
    scans: Mapping[tuple[str, int], xr.Dataset],
    spectra: Mapping[str, xr.Dataset],
    conditionings: Mapping[str, xr.Dataset],
    examples: Mapping[str, xr.Dataset],
    *,
    labels: Mapping[str, str],
    source: Mapping[str, str],
    sphere_surface: str,
    reference_surface: str,
    confidence: float,
) -> xr.Dataset:
    """Return the topography of all surfaces: every scan, averages, spectra and example maps.

    `scans`, by surface and number, come from `measured_roughness`, `conditionings`, by surface,
    from `condition_group`. `examples` are levelled scans, by surface; the example of a rough sphere
    has the variable `as_scanned`.
    """
    surface_names = list(dict.fromkeys(surface_name for surface_name, _ in scans))
    scan_table = stack(scans, ["surface", "scan"])
    table = xr.merge(
        [
            scan_table,
            scan_averages(scan_table[list(METRICS)], confidence),
            _spectra([spectra[name] for name in surface_names], scan_table["wavevector"].values),
            _maps([examples[name] for name in surface_names]),
        ],
        combine_attrs="override",
    )
    calibrated = [conditionings.get(name, spectra[name]) for name in surface_names]
    return table.assign(
        label=("surface", [labels[name] for name in surface_names]),
        source=("surface", [source[name] for name in surface_names]),
        table1_rows_met=("surface", [data.attrs["table1_rows_met"] for data in calibrated]),
    ).assign_attrs(
        sphere_surface=sphere_surface, reference_surface=reference_surface, confidence=confidence
    )


def _spectra(datasets: list[xr.Dataset], wavevector: Floats) -> xr.Dataset:
    """Return spectra (surface, wavevector) and their rms values over all scales."""
    spectra = [spectrum_of_dataset(dataset) for dataset in datasets]
    rms_values = np.array([all_scales_rms(spectrum) for spectrum in spectra])
    height, gradient, half_laplacian = rms_values.T
    density = np.array([spectrum(wavevector) for spectrum in spectra])
    return xr.Dataset(
        {
            "spectrum": (("surface", "wavevector"), density, NM4),
            "all_scales_rms_height": ("surface", height, NM),
            "all_scales_rms_gradient": ("surface", gradient, DIMENSIONLESS),
            "all_scales_rms_profile_slope": ("surface", gradient / np.sqrt(2), DIMENSIONLESS),
            "all_scales_rms_half_laplacian": ("surface", half_laplacian, {"units": "nm-1"}),
            "all_scales_rms_laplacian": ("surface", 2 * half_laplacian, {"units": "nm-1"}),
        }
    )


def _maps(examples: list[xr.Dataset]) -> xr.Dataset:
    """Return example maps, evenly thinned to the pixels of the coarsest map, with their sizes."""
    pixels = min(len(example["x"]) for example in examples)

    def thin(heights: xr.DataArray) -> np.ndarray:
        indices = np.linspace(0, len(heights) - 1, pixels).round().astype(int)
        return np.asarray(heights.values[np.ix_(indices, indices)])

    pixel_sizes = [example["heights"].attrs["pixel_size"] for example in examples]
    sizes = [len(example["x"]) * size for example, size in zip(examples, pixel_sizes, strict=True)]
    heights = np.array([thin(example["heights"]) for example in examples])
    example_maps = xr.Dataset(
        {
            "example_heights": (("surface", "row", "column"), heights, NM),
            "scan_size": ("surface", sizes, NM),
            "pixel_size": ("surface", pixel_sizes, NM),
        }
    )
    for example in examples:
        if "as_scanned" in example:
            scanned = thin(example["as_scanned"])
            example_maps["sphere_as_scanned"] = (("row", "column"), scanned, NM)
    return example_maps
