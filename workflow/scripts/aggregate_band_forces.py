"""Forces with a part of the roughness, relative to those with all of it: band_forces.nc."""

from hardcontact.base.dataset import add_labels_and_sources, read_by_name, stack
from hardcontact.inference.band_forces import band_ratios
from hardcontact.inference.scan_parts import parts_of_maps
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    radius, rho, confidence = params["radius"], params["rho"], params["confidence"]
    forces_by_surface = read_by_name(params["band_surfaces"], job.input.surfaces)
    ratios = {}
    for surface, forces in forces_by_surface.items():
        scan_parts = parts_of_maps(forces, radius, rho)
        ratios[(surface,)] = band_ratios(forces, scan_parts, confidence)
    # Only substitutes have whole surfaces; the forces on measured surfaces are NaN.
    band_forces = stack(ratios, ["surface"]).reindex(surface=params["surfaces"])
    # The bands are the same on all surfaces.
    first_surface = params["band_surfaces"][0]
    band_edge = forces_by_surface[first_surface]["band_edge"].isel(map=0, drop=True)
    band_forces = add_labels_and_sources(band_forces.assign(band_edge=band_edge), params)
    job.write(
        band_forces.assign_attrs(confidence=confidence, rho=rho),
        title="pull-off force with a part of the roughness, relative to that with all roughness",
    )
