"""The closed form of the pull-off force, compared with forces computed on random surfaces."""

from hardcontact.base import published
from hardcontact.base.job import job
from hardcontact.contact.all_surfaces import with_names
from hardcontact.contact.contact import Contact
from hardcontact.surfaces.spectrum import read_spectrum
from hardcontact.theory.closed_form_errors import Trial, closed_form_errors

with job(snakemake) as job:
    params = job.parameters
    work = published.constants(job.input.published_constants)["value"]["work_of_adhesion"]
    contact = Contact(**params["contact"])
    paths = zip(params["surfaces"], job.input.spectra, strict=True)
    spectra = {surface: read_spectrum(path) for surface, path in paths}
    job.write(
        with_names(
            closed_form_errors(spectra, Trial(work=work, contact=contact, **params["trial"])),
            {"labels": params["labels"], "basis": params["basis"]},
        ),
        title="closed form of the pull-off force and its error",
    )
