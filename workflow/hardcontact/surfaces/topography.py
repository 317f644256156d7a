"""The topography of all surfaces, topography.nc: metrics, spectra, and example maps."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from hardcontact.base.arrays import Floats
from hardcontact.base.dataset import stack
from hardcontact.base.statistics import as_variables, student_interval
from hardcontact.base.units import DIMENSIONLESS, NM, NM4, RAD_PER_NM
from hardcontact.surfaces.height_map import HeightMap
from hardcontact.surfaces.metrics import METRICS, metrics_dataset
from hardcontact.surfaces.spectrum import all_scales_rms, measured_psds, spectrum_of_dataset


def measured_roughness(scan: HeightMap) -> xr.Dataset:
    """Return the METRICS of a scan, and its C_iso (nm⁴) over `wavevector`, the centres of bins."""
    wavevector, _, isotropic_psd = measured_psds(scan)
    attributes = NM4 | {"long_name": "C_iso"}
    return metrics_dataset(scan, METRICS).assign(
        isotropic_psd=("wavevector", isotropic_psd, attributes),
        wavevector=("wavevector", wavevector, RAD_PER_NM),
    )


def scan_averages(scans: xr.Dataset, confidence: float) -> xr.Dataset:
    """Return mean, interval of the mean, and standard deviation of each metric (surface, scan)."""
    variables: dict[str, Any] = {}
    for name, metric in scans.data_vars.items():
        interval = student_interval(metric, confidence, "scan")
        mean = metric.mean("scan").values
        variables |= as_variables(
            f"{name}_mean", ["surface"], mean, interval.values, metric.attrs, confidence
        )
        variables[f"{name}_std"] = ("surface", metric.std("scan", ddof=1).values, metric.attrs)
    return xr.Dataset(variables)


def topography_dataset(
    scans: Mapping[tuple[str, int], xr.Dataset],
    spectra: Mapping[str, xr.Dataset],
    conditionings: Mapping[str, xr.Dataset],
    examples: Mapping[str, xr.Dataset],
    confidence: float,
) -> xr.Dataset:
    """Return the topography of all surfaces: scans, averages, spectra and example maps.

    `scans` come from `measured_roughness`, by surface and number, `conditionings` from
    `condition_batch` or `make_featured_scans`, `examples` from `level_and_mirror`.
    """
    scan_table = stack(scans, ["surface", "scan"])
    surfaces = scan_table["surface"].values.tolist()
    table = xr.merge(
        [
            scan_table,
            scan_averages(scan_table[list(METRICS)], confidence),
            _spectra([spectra[name] for name in surfaces], scan_table["wavevector"].values),
            _maps([examples[name] for name in surfaces]),
        ],
        combine_attrs="override",
    )
    calibrations = [conditionings.get(name, spectra[name]) for name in surfaces]
    met_rows = [calibration.attrs["table1_rows_met"] for calibration in calibrations]
    return table.assign(table1_rows_met=("surface", met_rows)).assign_attrs(confidence=confidence)


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
    """Return example maps, evenly thinned to the pixels of the coarsest, and their full sizes."""
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
