"""The short edge of the critical band for plastic and rigid contact at two ranges of adhesion."""

from hardcontact.base.job import job
from hardcontact.base.statistics import Sampling
from hardcontact.contact.all_surfaces import read_masters, with_names
from hardcontact.inference.enhancement import edges_by_contact

with job(snakemake) as job:
    params = job.parameters
    sampling = Sampling(**params["sampling"])
    forces = read_masters(params["masters"], job.input.masters, params["realizations"])
    bands = edges_by_contact(forces, params["tolerance"], sampling)
    job.write(
        with_names(bands, params).assign_attrs(
            tolerance=params["tolerance"], confidence=sampling.confidence
        ),
        title="short edges of plastic and rigid contact at two ranges of adhesion",
    )
