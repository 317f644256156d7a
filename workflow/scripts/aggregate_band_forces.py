"""The force with a part of the roughness, relative to all roughness: band_forces.nc."""

from hardcontact.base.dataset import add_surface_names, read_by_name, stack
from hardcontact.inference.band_forces import band_ratios
from hardcontact.inference.scan_parts import parts_of_maps
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    radius, rho, confidence = params["radius"], params["rho"], params["confidence"]
    forces = read_by_name(params["band_surfaces"], job.input.surfaces)
    ratios = {
        (surface,): band_ratios(
            surface_forces, parts_of_maps(surface_forces, radius, rho), confidence
        )
        for surface, surface_forces in forces.items()
    }
    # The bands are the same on all surfaces.
    band_edge = next(iter(forces.values()))["band_edge"].isel(map=0, drop=True)
    # Only substitutes have whole surfaces; the forces on measured surfaces are NaN.
    band_forces = stack(ratios, ["surface"]).reindex(surface=params["surfaces"])
    job.write(
        add_surface_names(band_forces.assign(band_edge=band_edge), params).assign_attrs(
            confidence=confidence, rho=rho
        ),
        title="pull-off force with a part of the roughness, relative to that with all roughness",
    )
