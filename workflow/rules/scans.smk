# Scans, read or made as substitutes: levelled, mirrored, and their roughness computed.
# Names in capitals that are not defined here: common.smk and surfaces.smk.

from hardcontact.files.paths import any_name_pattern


rule calibrate_spectrum:
    """Make the spectrum of a substitute from its description and its rows of Table 1, if any."""
    input:
        **DESCRIPTION_INPUTS,
        published_table1=PUBLISHED_TABLES["published_table1"],
        published_constants=PUBLISHED_TABLES["published_constants"],
    output:
        STORE.calibrated_spectra,
    params:
        parameters=lambda w: dict(surface=w.surface),
    script:
        "../scripts/calibrate_spectrum.py"


rule read_scan:
    """Read the file of a measured scan. Other rules read the output, and no file of a microscope."""
    input:
        scan=lambda w: SELECTION.path(w.surface, int(w.scan)),
    output:
        STORE.measurements,
    params:
        # Settings: undefined_pixels, unit, map_size, mask.
        parameters=lambda w: dict(
            dataset=SELECTION.dataset(w.surface, int(w.scan)), **SETTINGS["measurements"]
        ),
    script:
        "../scripts/read_scan.py"


# Each scan counts only at its reliable wavelengths. Beyond all of them the joined spectrum is extrapolated.
rule measure_spectrum:
    """Level the scans of a measured surface, find their defects, and join their spectra."""
    input:
        measurements=lambda w: FILES.measurement_paths(w.surface),
    output:
        STORE.measured_spectra,
    params:
        parameters=lambda w: dict(
            tip_radii=SELECTION.tip_radii(w.surface),
            sphere_radius=PLAN.sphere_radius(w.surface),
            **SETTINGS["measured_spectra"],  # levelling
        ),
    script:
        "../scripts/measure_spectrum.py"


for scan_numbers, surfaces in PLAN.scan_batches.items():

    rule:
        """Make a batch of substitute scans, conditioned on Table 1; level and mirror them."""
        name:
            f"make_scans_{'_'.join(map(str, scan_numbers))}"
        input:
            **SUBSTITUTE_INPUTS,
        output:
            **{
                f"levelled_{n}": STORE.levelled_scans.replace("{scan}", f"{n}")
                for n in scan_numbers
            },
            **{
                f"mirrored_{n}": STORE.mirrored_scans.replace("{scan}", f"{n}")
                for n in scan_numbers
            },
            conditioning=STORE.conditioning.replace("{scan}", f"{scan_numbers[0]}"),
        wildcard_constraints:
            surface=any_name_pattern(surfaces),
        params:
            # Snakemake calls the function after the loop. The default keeps the scans of this rule.
            parameters=lambda w, scan_numbers=scan_numbers: dict(
                surface=w.surface,
                scan_numbers=scan_numbers,
                sphere_radius=PLAN.sphere_radius(w.surface),
                has_features=w.surface == PLAN.featured_surface,
                **SETTINGS["substitute_scans"],  # seed, scan_grid, featured_surface
            ),
        script:
            "../scripts/make_scans.py"


rule prepare_scan:
    """Level a measured scan, subtract the sphere if it shows one, and mirror it."""
    input:
        measurement=STORE.measurements,
    output:
        levelled=STORE.levelled_scans,
        mirrored=STORE.mirrored_scans,
    wildcard_constraints:
        surface=any_name_pattern(SELECTION.measured_surfaces),
    params:
        parameters=lambda w: dict(
            sphere_radius=PLAN.sphere_radius(w.surface), **SETTINGS["measured_scans"]  # levelling
        ),
    script:
        "../scripts/prepare_scan.py"


rule aggregate_topography:
    """Compute rms metrics and power spectra of all scans, with averages: topography.nc."""
    input:
        scans=FILES.paths(STORE.levelled_scans, PLAN.scan_ids),
        spectra=[FILES.spectrum_path(surface) for surface in SELECTION.surfaces],
        # How the substitutes of each surface meet Table 1.
        conditionings=[
            FILES.path(
                STORE.conditioning, surface, scan=SELECTION.contact_scan_numbers(surface)[0]
            )
            for surface in SELECTION.substitutes
        ],
        # The first scan of each surface, which figures show as a map.
        examples=[
            FILES.path(
                STORE.levelled_scans, surface, scan=SELECTION.contact_scan_numbers(surface)[0]
            )
            for surface in SELECTION.surfaces
        ],
    output:
        RESULTS.dataset("topography"),
    params:
        parameters=dict(
            scan_ids=PLAN.scan_ids,
            surfaces=SELECTION.surfaces,
            conditioned=SELECTION.substitutes,
            attributes=dict(
                **LABELS_AND_SOURCES,
                sphere_surface=SELECTION.sphere_surface,
                reference_surface=STUDY["reference_surface"],
                confidence=STUDY["intervals"]["confidence"],
            ),
        ),
    script:
        "../scripts/aggregate_topography.py"
