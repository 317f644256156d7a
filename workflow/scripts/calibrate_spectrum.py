"""C_iso of a substitute surface, from its description and the published Table 1."""

import json

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact import dataset, log, spectrum, synthesis

log.start(snakemake.log[0])
parameters = json.loads(snakemake.params.canonical)
surface = parameters["surface"]

# Table 1 holds for the paper's scans, whatever this study's substitutes look like.
constants = pd.read_csv(snakemake.input.published).set_index("quantity").value
window = int(constants["scan_pixels"])
pixel_size, pixels = constants["scan_size"] / window, 4 * window

published = pd.read_csv(snakemake.input.table1)
table1 = spectrum.as_gradient_and_half_laplacian(
    published[published.surface == surface].set_index("quantity"), **parameters["table1"]
)
weights = spectrum.transfer_weights(pixels, pixel_size, window)
density, bands, calibrated = spectrum.from_description(snakemake.input.description, table1, weights)

height = table1.loc[["afm_rms_height"]] if "afm_rms_height" in table1.index else None
spread = (
    0.0
    if height is None
    else synthesis.scan_to_scan_spread(
        synthesis.generator(parameters["seed"], surface, "scan-to-scan spread"),
        pixels,
        pixel_size,
        window,
        lambda q: spectrum.at(q, spectrum.WAVEVECTORS, density),
        float((height.uncertainty / height.value).iloc[0]),
    )
)

dataset.write(
    xr.Dataset(
        {"spectrum": ("wavevector", density, {"units": "nm4", "long_name": "isotropic PSD"})},
        {"wavevector": ("wavevector", spectrum.WAVEVECTORS, {"units": "rad nm-1"})},
        {
            "basis": "substitute",
            "calibrated_to_table1": ",".join(calibrated),
            "bands": bands.to_csv(index=False),
            "skewness": parameters["skewness"],
            "spread": spread,
            "expected_scan_moments": np.asarray(
                spectrum.expected_moments(spectrum.WAVEVECTORS, density, weights)
            ),
        },
    ),
    snakemake.output[0],
    title=f"power spectral density of the substitute for {surface}",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
