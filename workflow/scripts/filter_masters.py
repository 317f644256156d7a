"""Plastic pull-off on masters of one surface, unfiltered and filtered at every cutoff."""

from itertools import product

from hardcontact.base.dataset import stack
from hardcontact.base.job import job
from hardcontact.contact.contact import Contact
from hardcontact.inference.filtered_masters import Filters, filtered_pull_off, varied_master
from hardcontact.surfaces.height_map import read_height_map
from hardcontact.surfaces.synthesis import SIDES

with job(snakemake) as job:
    params = job.parameters
    sources = job.input
    contacts = [
        Contact(
            radius=params["radii"][0],
            window=params["window"],
            count=params["contacts_per_side"],
            **load,
        )
        for load in params["loads"]
    ]
    sphere = read_height_map(sources.sphere) if sources.sphere else None
    sides = [side for side in SIDES if side in params["sides"]]
    forces = {}
    for (index, realization), side in product(enumerate(params["realizations"]), sides):
        scales = params["sides"][side]
        if params["masters"]:
            master = read_height_map(sources[f"{side}_masters"][index])
        else:
            purpose = f"{side}-scale {params['purpose']}"
            key = params["seed"], params["surface"], realization, purpose
            master = varied_master(side, key, sources.scans[index], sources.spectra[index], scales)
        forces[realization, side] = filtered_pull_off(
            master,
            Filters(side, scales["pixels"], scales["cutoffs"]),
            contacts,
            sphere,
            params["radii"],
            params["ranges"],
        )
    job.write(
        stack(forces, ["realization", "side"]),
        title=f"plastic pull-off of filtered masters of {params['surface']}",
    )
