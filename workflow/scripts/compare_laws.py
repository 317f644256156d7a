"""Fits, ratios and critical band of every law of attraction: laws.nc."""

from hardcontact.base import published
from hardcontact.base.dataset import read_all, stack
from hardcontact.base.job import job
from hardcontact.base.statistics import Sampling
from hardcontact.contact.all_surfaces import stacked_forces, with_names
from hardcontact.inference.published_fit import Pair
from hardcontact.paper.law_comparison import compare_laws
from hardcontact.surfaces.synthesis import SIDES

with job(snakemake) as job:
    params = job.parameters
    constants = published.constants(job.input.published_constants)["value"]
    scans = stack(read_all(params["scans"], job.input.scans), ["surface", "scan"])
    # Each scan is one realization of its masters.
    masters = {
        (*key, side): forces
        for side in SIDES
        for key, forces in read_all(params["scans"], getattr(job.input, side)).items()
    }
    laws = compare_laws(
        with_names(scans, {"labels": params["labels"], "basis": params["basis"]}),
        stacked_forces(masters),
        published.pull_off(job.input.published_pull_off),
        pair=Pair(constants["range_of_adhesion"], constants["work_of_adhesion"]),
        spacing=constants["equilibrium_spacing"],
        reference_surface=params["reference_surface"],
        tolerance=params["tolerance"],
        sampling=Sampling(params["seed"], params["samples"], params["confidence"]),
    )
    job.write(laws.assign_attrs(contacts=params["contacts"]), title="laws of attraction compared")
