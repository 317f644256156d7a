"""Mean pressure of elastic contact relative to the hardness, by shortest wavelength."""

from hardcontact.base.job import job
from hardcontact.contact.all_surfaces import with_names
from hardcontact.contact.elastic_limit import pressure_over_hardness
from hardcontact.contact.smooth_sphere import PAPER_MODULUS
from hardcontact.surfaces.spectrum import read_spectrum

with job(snakemake) as job:
    params = job.parameters
    hardness = params["hardness"]
    paths = zip(params["surfaces"], job.input.spectra, strict=True)
    spectra = {surface: read_spectrum(path) for surface, path in paths}
    index = pressure_over_hardness(spectra, PAPER_MODULUS, hardness).to_dataset(
        name="pressure_over_hardness"
    )
    job.write(
        with_names(index, params).assign_attrs(effective_modulus=PAPER_MODULUS, hardness=hardness),
        title="mean pressure of elastic contact over the hardness, by shortest wavelength",
    )
