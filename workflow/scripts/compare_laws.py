"""Fits, ratios and critical band of every law of attraction: laws.nc."""

from hardcontact.inference.inference import Pair
from hardcontact.insight.closed_form import Contact
from hardcontact.insight.interaction_laws import EXPONENTIAL
from hardcontact.insight.law_comparison import LawChoices, compare_laws, stacked_law_forces
from hardcontact.insight.local_law import local_law
from hardcontact.numbers.statistics import Sampling
from hardcontact.records import published
from hardcontact.records.dataset import read_all
from hardcontact.records.job import job
from hardcontact.surfaces.spectrum import read_spectrum
from hardcontact.surfaces.synthesis import SIDES

with job(snakemake) as this:
    given = this.parameters
    constants = published.constants(this.input.published_constants)["value"]
    forces, masters = stacked_law_forces(
        read_all(given["scans"], this.input.scans),
        {side: read_all(given["scans"], getattr(this.input, side)) for side in SIDES},
        {"labels": given["labels"], "basis": given["basis"]},
    )
    choices = LawChoices(
        given["reference_surface"],
        Pair(constants["range_of_adhesion"], constants["work_of_adhesion"]),
        constants["equilibrium_spacing"],
        given["tolerance"],
        Sampling(given["seed"], given["samples"], given["confidence"]),
    )
    compared = compare_laws(
        forces, masters, published.pull_off(this.input.published_pull_off), choices
    )
    paths = zip(given["surfaces"], this.input.spectra, strict=True)
    spectra = {surface: read_spectrum(path) for surface, path in paths}
    pair = choices.published_pair
    contact = Contact(given["sphere_radius"], *pair, given["area"])
    band = compared["critical_wavelength"].sel(law=EXPONENTIAL.name, case="equivalent")
    short_edge = band.sel(side="small", drop=True).rename(group="surface")
    this.write(
        compared.merge(local_law(spectra, contact, short_edge)).assign_attrs(
            contacts=given["contacts"]
        ),
        title="laws of attraction compared",
    )
