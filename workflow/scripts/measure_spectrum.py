"""C_iso of a measured surface: all its measurements joined, continued beyond their band."""

from hardcontact.records.job import job
from hardcontact.surfaces.joined_spectrum import joined_spectrum
from hardcontact.surfaces.scans import flat_measurement

with job(snakemake) as this:
    given = this.parameters
    how = {name: given[name] for name in ("undefined_pixels", "levelling", "sphere_radius")}
    measurements = [
        flat_measurement(path, dataset, **how)
        for path, dataset in zip(this.input.scans, given["datasets"], strict=True)
    ]
    this.write(
        joined_spectrum(measurements, given["tip_radii"]),
        title="power spectral density of a measured surface, joined of its measurements",
    )
