# Scans: substitutes where none was measured; all scans are then prepared in the same way.

from hardcontact.config.configuration import reading_keys
from hardcontact.config.grids import realization_pixels

SCAN_GRID = {
    **{key: STUDY["scan"][key] for key in ("pixels", "size")},
    "realization_pixels": realization_pixels(STUDY["scan"]["pixels"]),
}


rule calibrate_spectrum:
    """Make the spectrum of a substitute from its description and Table 1."""
    input:
        description=lambda w: SELECTION.description(w.surface),
        tables=lambda w: SELECTION.tables(w.surface),  # named by the description
        published_table1=PUBLISHED_TABLES["published_table1"],
        published_constants=PUBLISHED_TABLES["published_constants"],
        code=code_inputs("calibrate_spectrum.py"),
    output:
        PATTERNS.calibrated_spectrum,
    log:
        PATTERNS.log("calibrate_spectrum", PATTERNS.calibrated_spectrum),
    benchmark:
        PATTERNS.benchmark("calibrate_spectrum", PATTERNS.calibrated_spectrum)
    params:
        canonical=lambda w: canonical({"surface": w.surface}),
    script:
        "../scripts/calibrate_spectrum.py"


rule read_scan:
    """Read the file of a measured scan; no other rule does."""
    input:
        scan=lambda w: SELECTION.path(w.surface, int(w.scan)),
        code=code_inputs("read_scan.py"),
    output:
        PATTERNS.measurement,
    log:
        PATTERNS.log("read_scan", PATTERNS.measurement),
    benchmark:
        PATTERNS.benchmark("read_scan", PATTERNS.measurement)
    params:
        canonical=lambda w: canonical(
            reading_keys(STUDY, SELECTION.dataset(w.surface, int(w.scan)))
        ),
    script:
        "../scripts/read_scan.py"


rule measure_spectrum:
    """Join the spectra of all scans of a measured surface, each within its reliable band."""
    input:
        measurements=lambda w: FILES.measurements(w.surface),
        code=code_inputs("measure_spectrum.py"),
    output:
        PATTERNS.measured_spectrum,
    log:
        PATTERNS.log("measure_spectrum", PATTERNS.measured_spectrum),
    benchmark:
        PATTERNS.benchmark("measure_spectrum", PATTERNS.measured_spectrum)
    params:
        canonical=lambda w: canonical(FILES.measuring(w.surface)),
    script:
        "../scripts/measure_spectrum.py"


for scans, surfaces in FILES.scan_groups.items():

    rule:
        """Condition a group of substitute scans on Table 1, make them, and prepare them."""
        name:
            f"make_scans_{'_'.join(map(str, scans))}"
        input:
            spectrum=lambda w: FILES.spectrum(w.surface),
            published_table1=PUBLISHED_TABLES["published_table1"],
            published_constants=PUBLISHED_TABLES["published_constants"],
            code=code_inputs("make_scans.py"),
        output:
            substitutes=expand(PATTERNS.substitute, scan=scans, allow_missing=True),
            scans=expand(PATTERNS.levelled, scan=scans, allow_missing=True),
            stitched=expand(PATTERNS.stitched, scan=scans, allow_missing=True),
            conditioning=PATTERNS.conditioning.replace("{scan}", f"{scans[0]}"),
        log:
            PATTERNS.log("make_scans", PATTERNS.levelled.replace("{scan}", f"{scans[0]}")),
        benchmark:
            PATTERNS.benchmark("make_scans", PATTERNS.levelled.replace("{scan}", f"{scans[0]}"))
        wildcard_constraints:
            surface=any_name_pattern(surfaces),
        params:
            canonical=lambda w, scans=scans: parameters(
                surface=w.surface,
                scans=scans,
                scan=SCAN_GRID,
                seed=STUDY["seed"],
                sphere_radius=STUDY["sphere"]["radius"] if w.surface == SPHERE else None,
                has_features=w.surface in FILES.featured,
            ),
        script:
            "../scripts/make_scans.py"


rule prepare_scan:
    """Level a measured scan, subtract the sphere if it shows one, and stitch its mirror images."""
    input:
        measurement=PATTERNS.measurement,
        code=code_inputs("prepare_scan.py"),
    output:
        scan=PATTERNS.levelled,
        stitched=PATTERNS.stitched,
    log:
        PATTERNS.log("prepare_scan", PATTERNS.levelled),
    benchmark:
        PATTERNS.benchmark("prepare_scan", PATTERNS.levelled)
    wildcard_constraints:
        surface=any_name_pattern(
            name for name, basis in SELECTION.basis.items() if basis == "measured"
        ),
    params:
        canonical=lambda w: canonical(FILES.levelling(w.surface)),
    script:
        "../scripts/prepare_scan.py"
