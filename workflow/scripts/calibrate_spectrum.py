"""C_iso of a substitute surface, from its description and the published Table 1."""

from hardcontact.base import published
from hardcontact.base.job import job
from hardcontact.surfaces.substitute_spectra import rows_of_surface, substitute_spectrum

with job(snakemake) as this:
    surface = this.parameters["surface"]
    this.write(
        substitute_spectrum(
            this.input.description,
            rows_of_surface(
                published.table1(this.input.published_table1), surface, **this.parameters["table1"]
            ),
            published.constants(this.input.published_constants),
        ),
        title=f"power spectral density of the substitute for {surface}",
    )
