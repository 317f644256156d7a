"""How large a scan must be: a rule from random surfaces, tested on those of the study."""

from hardcontact.adhesion.named_surfaces import with_names
from hardcontact.adhesion.scan_size_trials import scan_size_trials
from hardcontact.study.job import job
from hardcontact.surfaces.spectrum import read_spectrum

with job(snakemake) as this:
    given = this.parameters
    spectra = dict(zip(given["surfaces"], map(read_spectrum, this.input.spectra), strict=True))
    this.write(
        with_names(
            scan_size_trials(spectra, given["trials"]),
            {"labels": given["labels"], "basis": given["basis"]},
        ).assign_attrs(rho=given["rho"], scan_size=given["scan_size"]),
        title="how large a scan must be, and the error of the rule that says so",
    )
