# Topography: rms metrics and PSDs by scan; Table 1.


rule measure_topography:
    input:
        scan=f"{STORE}/scans/{{surface}}/scan-{{scan}}-{{shape}}.nc",
        code=code("measure_topography.py"),
    output:
        f"{STORE}/topography/{{surface}}/scan-{{scan}}-{{shape}}.nc",
    params:
        canonical=canonical({}),
    log:
        f"{STORE}/logs/measure_topography/{{surface}}-{{scan}}-{{shape}}.log",
    benchmark:
        f"{STORE}/benchmarks/measure_topography/{{surface}}-{{scan}}-{{shape}}.tsv"
    script:
        "../scripts/measure_topography.py"


rule aggregate_topography:
    input:
        scans=[
            f"{STORE}/topography/{surface}/scan-{scan}-{shape_of(surface)}.nc"
            for surface in SURFACES
            for scan in scans_of(surface)
        ],
        spectra=[spectrum_of(surface) for surface in SURFACES],
        examples=[levelled(surface, scans_of(surface)[0]) for surface in SURFACES],
        sphere=scan_file(SPHERE, scans_of(SPHERE)[0]),
        code=code("aggregate_topography.py"),
    output:
        f"{RESULTS}/topography.nc",
    params:
        canonical=canonical(
            {
                "scans": [[surface, scan] for surface in SURFACES for scan in scans_of(surface)],
                "labels": LABELS,
                "basis": BASIS,
                "sphere_surface": SPHERE,
                "sphere_dataset": row_of(SPHERE, scans_of(SPHERE)[0]).dataset,
                "undefined_pixels": undefined_pixels_of(SPHERE),
                "table1": STUDY["topography"],
                "reference_surface": STUDY["reference_surface"],
                "confidence": STUDY["inference"]["confidence"],
            }
        ),
    log:
        f"{RESULTS}/logs/aggregate_topography.log",
    benchmark:
        f"{RESULTS}/benchmarks/aggregate_topography.tsv"
    script:
        "../scripts/aggregate_topography.py"


rule topography:
    input:
        rules.aggregate_topography.output,
