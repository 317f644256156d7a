"""The short edge of the critical band for plastic and rigid contact at two ranges of adhesion."""

from hardcontact.base import dataset
from hardcontact.base.job import job
from hardcontact.base.statistics import Sampling
from hardcontact.contact.all_surfaces import Described, single_masters, stacked_forces, with_names
from hardcontact.inference.enhancement import edges_by_contact

with job(snakemake) as job:
    params = job.parameters
    keys = [[surface] for surface in params["masters"]]
    files = zip(keys, map(dataset.read, job.input.masters), strict=True)
    forces = stacked_forces(single_masters(files, params["realizations"]))
    bands = edges_by_contact(
        forces,
        params["tolerance"],
        Sampling(params["seed"], params["samples"], params["confidence"]),
    )
    job.write(
        with_names(bands, Described(labels=params["labels"], basis=params["basis"])).assign_attrs(
            tolerance=params["tolerance"], confidence=params["confidence"]
        ),
        title="short edges of plastic and rigid contact at two ranges of adhesion",
    )
