"""The gain of the amplitudes of a substitute's scans, and the factor of each scan."""

from functools import partial

from hardcontact.base import dataset, published
from hardcontact.base.job import job
from hardcontact.base.random import generator
from hardcontact.surfaces.conditioning import condition_group, scan_targets
from hardcontact.surfaces.substitute_scans import ScanGrid
from hardcontact.surfaces.substitute_spectra import rows_of_surface

with job(snakemake) as job:
    params = job.parameters
    surface = params["surface"]
    spectrum_data = dataset.read(job.input.spectrum)
    grid = ScanGrid(**params["scan"])
    targets = scan_targets(
        spectrum_data,
        rows_of_surface(published.table1(job.input.published_table1), surface),
        published.constants(job.input.published_constants),
        grid,
    )
    generator_functions = {
        number: partial(generator, params["seed"], surface, number, "scan")
        for number in params["scans"]
    }
    job.write(
        condition_group(spectrum_data, targets, generator_functions, grid),
        title=f"gain and factors of substitute scans of {surface}",
    )
