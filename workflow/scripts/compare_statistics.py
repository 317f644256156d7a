"""The scatter of pull-off forces by their law, compared with published and computed scatter."""

import pandas as pd

from hardcontact.base import published
from hardcontact.base.dataset import read
from hardcontact.base.job import job
from hardcontact.contact.all_surfaces import with_names
from hardcontact.contact.contact import Contact
from hardcontact.surfaces.spectrum import read_spectrum
from hardcontact.theory.force_scatter import MEAN_ERROR, force_scatter, with_comparison

with job(snakemake) as job:
    params = job.parameters
    work = published.constants(job.input.published_constants)["value"]["work_of_adhesion"]
    paths = zip(params["surfaces"], job.input.spectra, strict=True)
    spectra = {surface: read_spectrum(path) for surface, path in paths}
    heights = published.table1(job.input.published_table1)
    heights = heights[heights["quantity"] == "afm_rms_height"].set_index("surface")
    deviations = (heights["uncertainty"] / heights["value"]).reindex(params["surfaces"]).fillna(0)
    scatter = force_scatter(
        spectra,
        Contact(radius=params["radius"], range=params["rho"], work=work, **params["load"]),
        params["ranges"],
        deviations,
        tolerance=MEAN_ERROR,
        confidence=params["confidence"],
    )
    compared = with_comparison(
        scatter,
        read(job.input.fit),
        published.pull_off(job.input.published_pull_off),
        pd.read_csv(job.input.validation),
    )
    job.write(
        with_names(compared.assign_attrs(reference_rho=params["rho"]), params),
        title="scatter of pull-off forces by the law of their statistics",
    )
