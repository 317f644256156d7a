"""What the scans of a substitute share: a gain of its spectrum, and a factor for each."""

from functools import partial

from hardcontact.base import dataset, published
from hardcontact.base.job import job
from hardcontact.base.random import generator
from hardcontact.surfaces.conditioning import conditioned_group, scan_targets
from hardcontact.surfaces.substitute_scans import ScanGrid
from hardcontact.surfaces.substitute_spectra import rows_of_surface

with job(snakemake) as this:
    surface, definitions = this.parameters["surface"], this.parameters["table1"]
    spectrum, grid = dataset.read(this.input.spectrum), ScanGrid(**this.parameters["scan"])
    this.write(
        conditioned_group(
            spectrum,
            scan_targets(
                spectrum,
                rows_of_surface(
                    published.table1(this.input.published_table1), surface, **definitions
                ),
                published.constants(this.input.published_constants),
                definitions,
                grid,
            ),
            {
                number: partial(generator, this.parameters["seed"], surface, number, "scan")
                for number in this.parameters["scans"]
            },
            grid,
        ),
        title=f"gain and factors of substitute scans of {surface}",
    )
