# Scans: substitutes where none was measured, then one door for both.


SKEWNESS = pd.read_csv("resources/spectra/height_distribution.csv").set_index("description").skewness


def description_of(surface):
    return row_of(surface, scans_of(surface)[0]).path


def skewness_of(surface):
    """Skewness of the heights of a substitute: another choice, or its description's."""
    choice = surface.partition(".")[2]
    if choice.startswith("skewness-"):
        return float(choice.removeprefix("skewness-"))
    return float(SKEWNESS.get(Path(description_of(surface)).stem, 0.0))


def definitions_of(surface):
    """What slope and curvature of Table 1 are read as for a substitute."""
    other = surface.endswith(f".{OTHER_CURVATURE}")
    return STUDY["topography"] | ({"curvature": OTHER_CURVATURE} if other else {})


def tables_of(w):
    """The tables of measured points that a description names."""
    description = description_of(w.surface)
    names = pd.read_csv(description).table.dropna().unique()
    return [os.path.relpath(Path(description).parent / name) for name in names]


rule calibrate_spectrum:
    # C_iso of a substitute, from its description and Table 1
    input:
        description=lambda w: description_of(w.surface),
        tables=tables_of,
        table1="resources/paper/table1.csv",
        published="resources/paper/parameters.csv",
        code=code("calibrate_spectrum.py"),
    output:
        f"{STORE}/spectra/{{surface}}-substitute.nc",
    params:
        canonical=lambda w: canonical(
            {
                "surface": plain(w.surface),
                "seed": STUDY["seed"],
                "table1": definitions_of(w.surface),
                "skewness": skewness_of(w.surface),
            }
        ),
    log:
        f"{STORE}/logs/calibrate_spectrum/{{surface}}.log",
    benchmark:
        f"{STORE}/benchmarks/calibrate_spectrum/{{surface}}.tsv"
    resources:
        mem_mb=1000,
    script:
        "../scripts/calibrate_spectrum.py"


rule extrapolate_spectrum:
    # C_iso of a measured surface, from its own scans
    input:
        scans=lambda w: expand(
            f"{STORE}/topography/{w.surface}/scan-{{scan}}-{w.shape}.nc",
            scan=scans_of(w.surface),
        ),
        code=code("extrapolate_spectrum.py"),
    output:
        f"{STORE}/spectra/{{surface}}-measured-{{shape}}.nc",
    params:
        canonical=canonical({}),
    log:
        f"{STORE}/logs/extrapolate_spectrum/{{surface}}-{{shape}}.log",
    benchmark:
        f"{STORE}/benchmarks/extrapolate_spectrum/{{surface}}-{{shape}}.tsv"
    script:
        "../scripts/extrapolate_spectrum.py"


def spectrum_of(surface):
    if BASIS[plain(surface)] == "measured":
        return f"{STORE}/spectra/{surface}-measured-{shape_of(surface)}.nc"
    return f"{STORE}/spectra/{surface}-substitute.nc"


rule synthesize_scan:
    # a substitute scan, in a format that microscopes' files share
    input:
        spectrum=lambda w: spectrum_of(w.surface),
        code=code("synthesize_scan.py"),
    output:
        f"{STORE}/substitutes/{{surface}}/scan-{{scan}}-{{shape}}.nc",
    params:
        canonical=lambda w: canonical(
            {
                "surface": plain(w.surface),
                "number": int(w.scan),
                "scan": {key: STUDY["scan"][key] for key in ("pixels", "size", "realization_pixels")},
                "seed": STUDY["seed"],
                "sphere_radius": STUDY["sphere"]["radius"] if w.surface == SPHERE else None,
            }
        ),
    log:
        f"{STORE}/logs/synthesize_scan/{{surface}}-{{scan}}-{{shape}}.log",
    benchmark:
        f"{STORE}/benchmarks/synthesize_scan/{{surface}}-{{scan}}-{{shape}}.tsv"
    resources:
        mem_mb=1000,
    script:
        "../scripts/synthesize_scan.py"


def scan_file(surface, scan):
    """The file a scan is read from: measured, or its substitute."""
    if BASIS[plain(surface)] == "measured":
        return row_of(surface, scan).path
    return f"{STORE}/substitutes/{surface}/scan-{scan}-{shape_of(surface)}.nc"


def undefined_pixels_of(surface):
    """What is done with undefined pixels; substitutes have none."""
    measured = BASIS[plain(surface)] == "measured"
    return STUDY["scan"]["undefined_pixels"] if measured else "refuse"


rule prepare_scan:
    # the plane removed, from the sphere's scans the sphere too; then mirror-stitched
    input:
        scan=lambda w: scan_file(w.surface, w.scan),
        code=code("prepare_scan.py"),
    output:
        scan=f"{STORE}/scans/{{surface}}/scan-{{scan}}-{{shape}}.nc",
        stitched=f"{STORE}/stitched/{{surface}}/scan-{{scan}}-{{shape}}.nc",
    params:
        canonical=lambda w: canonical(
            {
                "source": BASIS[plain(w.surface)],
                "dataset": row_of(w.surface, w.scan).dataset,
                "undefined_pixels": undefined_pixels_of(w.surface),
                "sphere_radius": STUDY["sphere"]["radius"] if w.surface == SPHERE else None,
            }
        ),
    log:
        f"{STORE}/logs/prepare_scan/{{surface}}-{{scan}}-{{shape}}.log",
    benchmark:
        f"{STORE}/benchmarks/prepare_scan/{{surface}}-{{scan}}-{{shape}}.tsv"
    script:
        "../scripts/prepare_scan.py"


def levelled(surface, scan):
    return f"{STORE}/scans/{surface}/scan-{scan}-{shape_of(surface)}.nc"


def stitched(surface, scan):
    return f"{STORE}/stitched/{surface}/scan-{scan}-{shape_of(surface)}.nc"
