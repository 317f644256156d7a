"""For which share of contacts the bearing area holds, and the force of those for which not."""

from hardcontact.insight.elastic_limit import elastic_limit, slope_index
from hardcontact.records.dataset import read, read_all
from hardcontact.records.job import job
from hardcontact.surfaces.spectrum import read_spectrum

with job(snakemake) as this:
    given = this.parameters
    limit = elastic_limit(
        read_all(given["scans"], this.input.scans),
        read(this.input.elastic),
        given,
        given["confidence"],
    )
    spectra = dict(zip(given["surfaces"], map(read_spectrum, this.input.spectra), strict=True))
    modulus, hardness = limit.attrs["effective_modulus"], limit.attrs["hardness"]
    this.write(
        limit.assign(slope_index=slope_index(spectra, modulus, hardness)),
        title="contacts for which the bearing area holds, and forces of the others",
    )
