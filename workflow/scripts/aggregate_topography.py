"""Table 1 and the PSDs: every scan, and their averages."""

import json

import numpy as np

from hardcontact import dataset, log, reading, spectrum, topography

log.start(snakemake.log[0])
parameters = json.loads(snakemake.params.canonical)
keys = [tuple(key) for key in parameters["scans"]]
surfaces = list(dict.fromkeys(surface for surface, _ in keys))

scans = dataset.stack(
    {key: dataset.read(path) for key, path in zip(keys, snakemake.input.scans, strict=True)},
    ["surface", "scan"],
)
spectra = dict(zip(surfaces, map(dataset.read, snakemake.input.spectra), strict=True))
density = np.array(
    [
        spectrum.at(scans.wavevector.values, part.wavevector.values, part.spectrum.values)
        for part in spectra.values()
    ]
)
joined = np.array(
    [
        spectrum.all_scales_moments(part.wavevector.values, part.spectrum.values)
        for part in spectra.values()
    ]
)
scans = scans.assign(
    **topography.averages(scans, parameters["confidence"]),
    psd_profile_mean=scans.psd_profile.mean("scan", keep_attrs=True),
    psd_isotropic_mean=scans.psd_isotropic.mean("scan", keep_attrs=True),
    spectrum=(("surface", "wavevector"), density, {"units": "nm4"}),
    all_scales_rms_height=("surface", joined[:, 0], {"units": "nm"}),
    all_scales_rms_gradient=("surface", joined[:, 1], {"units": "1"}),
    all_scales_rms_profile_slope=("surface", joined[:, 1] / np.sqrt(2), {"units": "1"}),
    all_scales_rms_half_laplacian=("surface", joined[:, 2], {"units": "nm-1"}),
    all_scales_rms_laplacian=("surface", 2 * joined[:, 2], {"units": "nm-1"}),
    label=("surface", [parameters["labels"][surface] for surface in surfaces]),
    basis=("surface", [parameters["basis"][surface] for surface in surfaces]),
    calibrated_to_table1=(
        "surface",
        [part.attrs["calibrated_to_table1"] for part in spectra.values()],
    ),
)

examples = dict(zip(surfaces, map(dataset.read, snakemake.input.examples), strict=True))
as_scanned, _ = reading.read_scan(
    snakemake.input.sphere, parameters["sphere_dataset"], parameters["undefined_pixels"]
)
pixels = min(as_scanned.shape[0], *(len(part.x) for part in examples.values()))
scans = scans.assign(
    example_heights=(
        ("surface", "row", "column"),
        np.array([topography.thinned(part.heights.values, pixels) for part in examples.values()]),
        {"units": "nm"},
    ),
    sphere_as_scanned=(("row", "column"), topography.thinned(as_scanned, pixels), {"units": "nm"}),
    scan_size=(
        "surface",
        [len(part.x) * dataset.pixel_size(part) for part in examples.values()],
        {"units": "nm"},
    ),
)
dataset.write(
    scans.assign_attrs(
        sphere_surface=parameters["sphere_surface"],
        reference_surface=parameters["reference_surface"],
        table1_variables=dataset.canonical(topography.table1_variables(**parameters["table1"])),
    ),
    snakemake.output[0],
    title="topography of all surfaces: rms metrics and power spectral densities",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
