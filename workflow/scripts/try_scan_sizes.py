"""How large a scan must be: a rule from random surfaces, tested on those of the study."""

from hardcontact.adhesion.all_surfaces import with_names
from hardcontact.insight.scan_size_trials import creases, scan_size_trials, window_edges
from hardcontact.records import dataset
from hardcontact.records.job import job
from hardcontact.surfaces.spectrum import read_spectrum

with job(snakemake) as this:
    given = this.parameters
    surfaces, confidence = given["surfaces"], given["trials"]["confidence"]
    spectra = dict(zip(surfaces, map(read_spectrum, this.input.spectra), strict=True))
    windows = dict(zip(surfaces, map(dataset.read, this.input.windows), strict=True))
    of_creases = creases(dataset.read(this.input.asperities), given["rho"], confidence)
    this.write(
        with_names(
            scan_size_trials(spectra, given["trials"])
            .merge(window_edges(windows, given["tolerance"], confidence))
            .merge(of_creases),
            {"labels": given["labels"], "basis": given["basis"]},
        ).assign_attrs({name: given[name] for name in ("rho", "scan_size", "tolerance")}),
        title="how large a scan must be, and the error of the rule that says so",
    )
