"""The gain of a substitute's spectrum, and the factor of each of its scans."""

from functools import partial

from hardcontact.base import dataset, published
from hardcontact.base.job import job
from hardcontact.base.random import generator
from hardcontact.surfaces.conditioning import conditioned_group, scan_targets
from hardcontact.surfaces.substitute_scans import ScanGrid
from hardcontact.surfaces.substitute_spectra import rows_of_surface

with job(snakemake) as job:
    surface, definitions = job.parameters["surface"], job.parameters["table1"]
    spectrum, grid = dataset.read(job.input.spectrum), ScanGrid(**job.parameters["scan"])
    job.write(
        conditioned_group(
            spectrum,
            scan_targets(
                spectrum,
                rows_of_surface(
                    published.table1(job.input.published_table1), surface, **definitions
                ),
                published.constants(job.input.published_constants),
                definitions,
                grid,
            ),
            {
                number: partial(generator, job.parameters["seed"], surface, number, "scan")
                for number in job.parameters["scans"]
            },
            grid,
        ),
        title=f"gain and factors of substitute scans of {surface}",
    )
