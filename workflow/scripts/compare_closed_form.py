"""The closed form of the pull-off force beside forces computed on random surfaces."""

from hardcontact.adhesion.all_surfaces import with_names
from hardcontact.contact.contact import Contact
from hardcontact.insight.closed_form_errors import Trial, closed_form_errors
from hardcontact.records import published
from hardcontact.records.job import job
from hardcontact.surfaces.spectrum import read_spectrum

with job(snakemake) as this:
    given = this.parameters
    work = published.constants(this.input.published_constants)["value"]["work_of_adhesion"]
    contact = Contact(**given["contact"])
    spectra = dict(zip(given["surfaces"], map(read_spectrum, this.input.spectra), strict=True))
    this.write(
        with_names(
            closed_form_errors(spectra, Trial(work=work, contact=contact, **given["trial"])),
            {"labels": given["labels"], "basis": given["basis"]},
        ),
        title="closed form of the pull-off force and its error",
    )
