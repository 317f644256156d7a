"""Pull-off on masters of one surface, unfiltered and filtered at every cutoff."""

from hardcontact.base.dataset import stack
from hardcontact.contact.contact import Contact
from hardcontact.inference.filtered_masters import Filters, filtered_pull_off, make_master
from hardcontact.records.job import run_job
from hardcontact.surfaces.height_map import HeightMap, load_height_map
from hardcontact.surfaces.synthesis import SIDES, master_generator

with run_job(snakemake) as job:
    params = job.parameters
    loaded_contacts = [
        Contact(
            radius=params["radii"][0],  # `filtered_pull_off` replaces it by each radius.
            window=params["window"],
            contacts_per_row=params["contacts_per_row"],
            **loading,
        )
        for loading in params["loadings"]
    ]
    sphere = load_height_map(job.input.sphere) if job.input.sphere else None
    filters = {
        side: Filters(side, params["sides"][side]["pixels"], params["sides"][side]["cutoffs"])
        for side in SIDES
        if side in params["sides"]
    }

    def load_master(side: str, index: int) -> HeightMap:
        """Return the master of a realization, from its file or made from its scan."""
        if master_files := job.input.get(f"{side}_masters"):
            return load_height_map(master_files[index])
        names = params["surface"], params["realizations"][index], side, params["stream"]
        rng = master_generator(params["seed"], *names)
        scan, spectrum = job.input.scans[index], job.input.spectra[index]
        return make_master(side, rng, scan, spectrum, params["sides"][side])

    forces = {
        (realization, side): filtered_pull_off(
            load_master(side, index),
            filters[side],
            loaded_contacts,
            sphere,
            params["radii"],
            params["ranges"],
        )
        for index, realization in enumerate(params["realizations"])
        for side in filters
    }
    job.write(
        stack(forces, ["realization", "side"]),
        title=f"pull-off of filtered masters of {params['surface']}",
    )
