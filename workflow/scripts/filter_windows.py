"""Pull-off on windows and whole random surfaces of one spectrum, with and without long waves."""

from hardcontact.insight.scan_windows import WindowFilters, filtered_window_forces
from hardcontact.records.job import job
from hardcontact.surfaces.spectrum import read_spectrum

with job(snakemake) as this:
    given, surface = this.parameters, this.parameters["surface"]
    spectrum = read_spectrum(this.input.spectrum)
    this.write(
        filtered_window_forces(surface, spectrum, WindowFilters(**given["filters"])),
        title=f"pull-off on windows of {surface} with and without long waves",
    )
