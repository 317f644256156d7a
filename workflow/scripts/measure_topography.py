"""rms metrics and PSDs of one scan."""

import xarray as xr

from hardcontact import dataset, log, spectrum, topography

log.start(snakemake.log[0])
scan = dataset.read(snakemake.input.scan)
heights, pixel_size = scan.heights.values.astype(float), dataset.pixel_size(scan)

metrics = {
    name: ((), value, dict(zip(("units", "long_name"), topography.METRICS[name], strict=True)))
    for name, value in topography.metrics(heights, pixel_size).items()
}
wavevector, profile, isotropic = spectrum.measure(heights, pixel_size)
dataset.write(
    xr.Dataset(
        {
            **metrics,
            "psd_profile": ("wavevector", profile, {"units": "nm3", "long_name": "1D PSD"}),
            "psd_isotropic": ("wavevector", isotropic, {"units": "nm4", "long_name": "2D PSD"}),
        },
        {"wavevector": ("wavevector", wavevector, {"units": "rad nm-1"})},
    ),
    snakemake.output[0],
    title="rms metrics and power spectral densities of one scan",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
