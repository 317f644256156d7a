"""Pull-off forces on masters of one surface, unfiltered and filtered at every cutoff."""

from dataclasses import replace

from hardcontact.base.dataset import read_dataset, stack
from hardcontact.contact.contact import Contact
from hardcontact.inference.forces_on_masters import Filters, filtered_pull_off
from hardcontact.records.job import run_job
from hardcontact.surfaces.height_map import load_height_map
from hardcontact.surfaces.spectrum import spectrum_of_dataset
from hardcontact.surfaces.synthesis import SIDES, master_generator, synthesize_master

with run_job(snakemake) as job:
    params = job.parameters
    seed, surface, stream = params["seed"], params["surface"], params["stream"]
    radii, ranges = params["radii"], params["ranges"]
    contact_grid = {name: params[name] for name in ("window", "contacts_per_row")}
    # `filtered_pull_off` replaces the radius by each of the radii.
    contacts = [
        Contact(radius=radii[0], **contact_grid, **loading) for loading in params["loadings"]
    ]
    sphere = load_height_map(job.input.sphere) if job.input.sphere else None
    sides = [side for side in SIDES if side in params["sides"]]  # JSON sorted them.
    forces = {}
    for index, realization in enumerate(params["realization_numbers"]):
        for side in sides:
            settings = params["sides"][side]
            if master_paths := job.input.get(f"{side}_masters"):  # The purpose is `edges`.
                master = load_height_map(master_paths[index])
            else:  # For other purposes the job makes the master.
                scan = load_height_map(job.input.scans[index])
                spectrum_data = read_dataset(job.input.spectra[index])
                # A sampled spectrum comes with a factor for the heights of the scan.
                factor = spectrum_data.attrs.get("height_factor", 1.0)
                scan = replace(scan, heights=scan.heights * factor)
                spectrum = spectrum_of_dataset(spectrum_data)
                rng = master_generator(seed, surface, realization, side, stream)
                master = synthesize_master(side, rng, scan, settings, spectrum)
                del scan  # The forces need the memory.
            filters = Filters(side, settings["pixels"], settings["cutoffs"])
            forces[realization, side] = filtered_pull_off(
                master, filters, contacts, sphere, radii, ranges
            )
    title = f"pull-off of filtered masters of {surface}"
    job.write(stack(forces, ["realization", "side"]), title)
