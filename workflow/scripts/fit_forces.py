"""Range and work of adhesion that the user's own forces allow."""

from hardcontact.config.tables import measured_forces
from hardcontact.numbers.statistics import Sampling
from hardcontact.own_surfaces.own_fit import fit_measured, with_continued_work
from hardcontact.records import dataset
from hardcontact.records.job import job

with job(snakemake) as this:
    given = this.parameters
    sizes = dataset.read(this.input.topography)["scan_size"].to_series().to_dict()
    fitted = fit_measured(
        dataset.read(this.input.adhesion),
        measured_forces(this.input.forces, list(sizes)),
        sizes,
        Sampling(given["seed"], given["samples"], given["confidence"]),
    )
    this.write(
        with_continued_work(fitted, dataset.read(this.input.force)),
        title="range and work of adhesion from measured forces",
    )
