# Scales: multi-scale masters, cutoff filters, pull-off of each filtered surface.


def scan_of_realization(w):
    """Realization k builds on scan k, beginning again when the scans are used up."""
    scans = scans_of(w.surface)
    return stitched(w.surface, scans[(int(w.realization) - 1) % len(scans)])


def master_parameters(side, *keys):
    settings = {key: STUDY["scales"][side][key] for key in keys}
    return lambda w: canonical(
        {
            "surface": w.surface,
            "realization": int(w.realization),
            "seed": STUDY["seed"],
            **settings,
        }
    )


rule synthesize_small_scale_master:
    input:
        scan=scan_of_realization,
        spectrum=lambda w: spectrum_of(w.surface),
        code=code("synthesize_small_scale_master.py"),
    output:
        f"{STORE}/masters/{{surface}}/realization-{{realization}}/small.nc",
    params:
        canonical=master_parameters("small", "pixels", "transition"),
    log:
        f"{STORE}/logs/synthesize_small_scale_master/{{surface}}-{{realization}}.log",
    benchmark:
        f"{STORE}/benchmarks/synthesize_small_scale_master/{{surface}}-{{realization}}.tsv"
    resources:
        mem_mb=3000,
    script:
        "../scripts/synthesize_small_scale_master.py"


rule synthesize_large_scale_master:
    input:
        scan=scan_of_realization,
        spectrum=lambda w: spectrum_of(w.surface),
        code=code("synthesize_large_scale_master.py"),
    output:
        f"{STORE}/masters/{{surface}}/realization-{{realization}}/large.nc",
    params:
        canonical=master_parameters("large", "tiles", "transition"),
    log:
        f"{STORE}/logs/synthesize_large_scale_master/{{surface}}-{{realization}}.log",
    benchmark:
        f"{STORE}/benchmarks/synthesize_large_scale_master/{{surface}}-{{realization}}.tsv"
    resources:
        mem_mb=2000,
    script:
        "../scripts/synthesize_large_scale_master.py"


FILTERED = "{radius}/{load}/{range}/{surface}/realization-{realization}/{side}/cutoff-{cutoff}"


rule compute_filtered_pull_off:
    # one cutoff of one master; cutoff none is the unfiltered surface
    input:
        master=f"{STORE}/masters/{{surface}}/realization-{{realization}}/{{side}}.nc",
        sphere=(
            stitched(SPHERE, scans_of(SPHERE)[0]) if STUDY["scales"]["sphere_roughness"] else []
        ),
        code=code("compute_filtered_pull_off.py"),
    output:
        f"{STORE}/scales/{FILTERED}.nc",
    params:
        canonical=lambda w: canonical(
            {
                "contact": STUDY["contact"],
                "radius": STUDY["sphere"]["radius"],
                "rho": STUDY["scales"]["range"],
                "pixels": STUDY["scales"][w.side]["pixels"],
                "side": w.side,
                "cutoff": None if w.cutoff == "none" else float(w.cutoff.removesuffix("nm")),
            }
        ),
    log:
        f"{STORE}/logs/compute_filtered_pull_off/{FILTERED}.log",
    benchmark:
        f"{STORE}/benchmarks/compute_filtered_pull_off/{FILTERED}.tsv"
    resources:
        mem_mb=3000,
    script:
        "../scripts/compute_filtered_pull_off.py"


FILTERS = [
    (surface, realization, side, cutoff)
    for surface in SUBSTRATES
    for realization in REALIZATIONS
    for side in ("small", "large")
    for cutoff in ["none"] + cutoff_tokens(side)
]


rule aggregate_scales:
    input:
        filtered=[
            rules.compute_filtered_pull_off.output[0].format(
                radius=RADIUS,
                load=LOAD,
                range=RANGE,
                surface=surface,
                realization=realization,
                side=side,
                cutoff=cutoff,
            )
            for surface, realization, side, cutoff in FILTERS
        ],
        code=code("aggregate_scales.py"),
    output:
        f"{RESULTS}/scales.nc",
    params:
        canonical=canonical(
            {
                "filters": FILTERS,
                "labels": LABELS,
                "basis": BASIS,
                "rho": STUDY["scales"]["range"],
                "sphere_radius": STUDY["sphere"]["radius"],
            }
        ),
    log:
        f"{RESULTS}/logs/aggregate_scales.log",
    benchmark:
        f"{RESULTS}/benchmarks/aggregate_scales.tsv"
    script:
        "../scripts/aggregate_scales.py"


rule scales:
    input:
        rules.aggregate_scales.output,
