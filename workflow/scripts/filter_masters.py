"""Plastic pull-off on masters of one surface, unfiltered and filtered at every cutoff."""

from itertools import product

from hardcontact.base.dataset import stack
from hardcontact.base.job import run_job
from hardcontact.base.random import generator
from hardcontact.contact.contact import Contact
from hardcontact.inference.filtered_masters import Filters, filtered_pull_off, master_from_files
from hardcontact.surfaces.height_map import read_height_map
from hardcontact.surfaces.synthesis import SEED_WORDS, SIDES

with run_job(snakemake) as job:
    params = job.parameters
    inputs = job.input
    loaded_contacts = [
        Contact(
            radius=params["radii"][0],
            window=params["window"],
            contacts_per_row=params["contacts_per_row"],
            **load,
        )
        for load in params["loads"]
    ]
    sphere = read_height_map(inputs.sphere) if inputs.sphere else None
    sides = [side for side in SIDES if side in params["sides"]]
    forces = {}
    for (index, realization), side in product(enumerate(params["realizations"]), sides):
        settings = params["sides"][side]
        if params["generator_name"] is None:
            master = read_height_map(inputs[f"{side}_masters"][index])
        else:
            generator_name = f"{SEED_WORDS[side]}-scale {params['generator_name']}"
            names = params["seed"], params["surface"], realization, generator_name
            master = master_from_files(
                side, generator(*names), inputs.scans[index], inputs.spectra[index], settings
            )
        forces[realization, side] = filtered_pull_off(
            master,
            Filters(side, settings["pixels"], settings["cutoffs"]),
            loaded_contacts,
            sphere,
            params["radii"],
            params["ranges"],
        )
    job.write(
        stack(forces, ["realization", "side"]),
        title=f"plastic pull-off of filtered masters of {params['surface']}",
    )
