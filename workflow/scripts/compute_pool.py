"""Pull-off forces of some scans of the pool of one substrate, at several heights of each."""

from hardcontact.contact.contact import Contact
from hardcontact.records import dataset, published
from hardcontact.records.job import job
from hardcontact.sets.pool import PoolSettings, compute_pool, pool_heights
from hardcontact.surfaces.conditioning import scan_targets
from hardcontact.surfaces.spectrum import spectrum_from
from hardcontact.surfaces.substitute_scans import ScanGrid
from hardcontact.surfaces.substitute_spectra import rows_of_surface

with job(snakemake) as this:
    given, surface = this.parameters, this.parameters["surface"]
    spectrum, grid = dataset.read(this.input.spectrum), ScanGrid(**given["scan"])
    targets = scan_targets(
        spectrum,
        rows_of_surface(published.table1(this.input.published_table1), surface, **given["table1"]),
        published.constants(this.input.published_constants),
        given["table1"],
        grid,
    )
    first, last = given["first"], given["last"]
    this.write(
        compute_pool(
            range(first, last + 1),
            spectrum_from(spectrum),
            targets,
            pool_heights(targets, given["scans"], given["amplitudes"]),
            PoolSettings(
                seed=given["seed"],
                surface=surface,
                scan=grid,
                contact=Contact(radius=given["radius"], **given["contact"]),
                ranges=given["ranges"],
            ),
        ),
        title=f"pull-off forces of scans {first} to {last} of the pool of {surface}",
    )
