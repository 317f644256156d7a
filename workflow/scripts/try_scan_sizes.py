"""How large a scan must be: a rule from random surfaces, tested on those of the study."""

from hardcontact.adhesion.scan_size_trials import scan_size_trials
from hardcontact.study.job import job
from hardcontact.surfaces.spectrum import read_spectrum

with job(snakemake) as this:
    given = this.parameters
    surfaces = given["surfaces"]
    spectra = dict(zip(surfaces, map(read_spectrum, this.input.spectra), strict=True))
    this.write(
        scan_size_trials(spectra, given["trials"])
        .assign(
            label=("surface", [given["labels"][surface] for surface in surfaces]),
            basis=("surface", [given["basis"][surface] for surface in surfaces]),
        )
        .assign_attrs(rho=given["rho"], scan_size=given["scan_size"]),
        title="how large a scan must be, and the error of the rule that says so",
    )
