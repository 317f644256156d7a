"""C_iso of a measured surface: the mean PSD of its scans, continued beyond their band."""

import numpy as np
import xarray as xr

from hardcontact import dataset, log, spectrum

log.start(snakemake.log[0])
scans = [dataset.read(path) for path in snakemake.input.scans]
density = spectrum.from_scans(
    scans[0].wavevector.values, np.array([scan.psd_isotropic.values for scan in scans])
)

dataset.write(
    xr.Dataset(
        {"spectrum": ("wavevector", density, {"units": "nm4", "long_name": "isotropic PSD"})},
        {"wavevector": ("wavevector", spectrum.WAVEVECTORS, {"units": "rad nm-1"})},
        {"basis": "measured", "calibrated_to_table1": ""},
    ),
    snakemake.output[0],
    title="power spectral density of a measured surface, extrapolated",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
