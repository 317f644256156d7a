"""Pull-off on masters of one surface, unfiltered and filtered at every cutoff."""

from hardcontact.base.dataset import read, stack
from hardcontact.contact.contact import Contact
from hardcontact.inference.filtered_masters import Filters, filtered_pull_off, master_from_spectrum
from hardcontact.records.job import Job, run_job
from hardcontact.surfaces.height_map import HeightMap, load_height_map
from hardcontact.surfaces.synthesis import SIDES, master_generator


def master(job: Job, side: str, index: int) -> HeightMap:
    """Read the master of a side and a realization, by its index, or make it from its spectrum."""
    params = job.parameters
    if params["masters_are_files"]:
        return load_height_map(job.input[f"{side}_masters"][index])
    realization = params["realizations"][index]
    rng = master_generator(params["seed"], params["surface"], realization, side, params["stream"])
    scan = load_height_map(job.input.scans[index])
    spectrum_data = read(job.input.spectra[index])
    return master_from_spectrum(side, rng, scan, params["sides"][side], spectrum_data)


with run_job(snakemake) as job:
    params = job.parameters
    loaded_contacts = [
        Contact(
            radius=params["radii"][0],
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
    forces = {
        (realization, side): filtered_pull_off(
            master(job, side, index),
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
