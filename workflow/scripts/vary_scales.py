"""Mean plastic pull-off of one master, filtered at every cutoff, at several loads."""

import json

import numpy as np
import xarray as xr

from hardcontact import adhesion, contact, dataset, fourier, log, sphere, synthesis

log.start(snakemake.log[0])
parameters = json.loads(snakemake.params.canonical)
side, settings, rho = parameters["side"], parameters["scales"], parameters["rho"]

scan, description = dataset.read(snakemake.input.scan), dataset.read(snakemake.input.spectrum)
rng = synthesis.generator(
    parameters["seed"], parameters["surface"], parameters["realization"], f"{side}-scale variant"
)
synthesize = {"small": synthesis.small_scale_master, "large": synthesis.large_scale_master}[side]
master, master_pixel = synthesize(
    rng,
    scan.heights.values,
    dataset.pixel_size(scan),
    settings["pixels"] if side == "small" else settings["tiles"],
    settings["transition"],
    (description.wavevector.values, description.spectrum.values),
)
rough = dataset.read(snakemake.input.sphere) if snakemake.input.sphere else None


def mean_forces(cutoff):
    """Force (load,) in N at 1 J/m² without the scales beyond a cutoff, averaged over contacts."""
    heights, pixel_size = fourier.filtered(master, master_pixel, side, cutoff, settings["pixels"])
    roughness = None
    if rough is not None:
        heights, roughness, pixel_size, _ = sphere.common_pixels(
            heights, pixel_size, rough.heights.values, dataset.pixel_size(rough)
        )
    totals = adhesion.plastic_totals(
        heights,
        roughness,
        sphere.contact_positions(heights.shape[0], parameters["count"]),
        pixel_size,
        parameters["radius"],
        sphere.window_pixels(parameters["window"], pixel_size),
        [
            contact.contact_pixel_count(preload, hardness, pixel_size)
            for preload, hardness in parameters["loads"]
        ],
        rho,
    )
    return adhesion.pull_off_force(totals.mean(axis=(1, 2)), rho, pixel_size, 1.0)


cutoffs = [None, *settings["cutoffs"]]
forces = np.array(
    [mean_forces(cutoff) for cutoff in log.progress(cutoffs, len(cutoffs), "cutoffs")]
)
pixel_size = master.shape[0] * master_pixel / settings["pixels"]
dataset.write(
    xr.Dataset(
        {
            "unfiltered_pull_off_force": ("load", forces[0], {"units": "N"}),
            "pull_off_force": (("cutoff_wavelength", "load"), forces[1:], {"units": "N"}),
            "unfiltered_wavelength": (
                (),
                2 * pixel_size if side == "small" else master.shape[0] * master_pixel,
                {"units": "nm", "long_name": "end of the unfiltered spectrum"},
            ),
        },
        {"cutoff_wavelength": ("cutoff_wavelength", settings["cutoffs"], {"units": "nm"})},
        {"work_of_adhesion": 1.0, "rho": rho},
    ),
    snakemake.output[0],
    title=f"mean pull-off of a filtered {side}-scale master of {parameters['surface']}",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
