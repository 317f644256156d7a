# Robustness: the headline numbers under other choices, each from fewer contacts and realizations.

VARIED = STUDY["robustness"]
PROBE = "rough" if STUDY["scales"]["sphere_roughness"] else "smooth"
OTHER_PROBE = {"rough": "smooth", "smooth": "rough"}[PROBE]

# Preload and hardness: the study's, then with each other preload and each other hardness.
LOADS = (
    [[STUDY["contact"]["preload"], STUDY["contact"]["hardness"]]]
    + [[preload, STUDY["contact"]["hardness"]] for preload in VARIED["preloads"]]
    + [[STUDY["contact"]["preload"], hardness] for hardness in VARIED["hardnesses"]]
)


def varied(surface, choice):
    """A surface as a choice for substitutes has it: by its own name where that changes nothing."""
    if BASIS[surface] == "measured":
        return surface
    other = f"{surface}.{choice}"
    if choice == OTHER_CURVATURE:
        bands = pd.read_csv(description_of(surface))
        calibrated = bands.hurst.isna() & bands.model.isin(["self-affine", "power law"])
        return other if calibrated.any() else surface
    return other if skewness_of(other) != skewness_of(surface) else surface


def variant(name, label, group, choice=None, load=0, probe=PROBE):
    """One variant: the surfaces, the load (its place in LOADS) and the probe it is computed with."""
    surfaces = [varied(surface, choice) if choice else surface for surface in SUBSTRATES]
    return {
        "name": name,
        "label": label,
        "group": group,
        "surfaces": surfaces,
        "load": load,
        "probe": probe,
    }


def in_words(keys, group, unit, first):
    """A variant for each value of a key that loads are made of, as the configuration writes it."""
    return [
        variant(
            f"{group}-{token(text, unit)}",
            f"{group} {text.replace(' u', ' µ')}",
            group,
            load=first + k,
        )
        for k, text in enumerate(keys)
    ]


VARIANTS = [
    variant("baseline", "as the study", "baseline"),
    variant(
        OTHER_CURVATURE,
        f"curvature of Table 1: {OTHER_CURVATURE.replace('_', ' ')}",
        "curvature",
        choice=OTHER_CURVATURE,
    ),
    *(
        variant(choice, f"heights of skewness {choice.removeprefix('skewness-')}", "heights", choice)
        for choice in CHOICES
        if choice != OTHER_CURVATURE
    ),
    variant(f"{OTHER_PROBE}_sphere", f"{OTHER_PROBE} sphere in Fig. 6", "sphere", probe=OTHER_PROBE),
    *in_words(config["robustness"]["preloads"], "preload", "uN", 1),
    *in_words(config["robustness"]["hardnesses"], "hardness", "GPa", 1 + len(VARIED["preloads"])),
]


rule vary_adhesion:
    # forces of one pair of scans, of a surface or of one variant of it
    input:
        substrate=f"{STORE}/stitched/{{surface}}/scan-{{scan}}-flat.nc",
        sphere=f"{STORE}/stitched/{SPHERE}/scan-{{sphere_scan}}-sphere-{{radius}}.nc",
        code=code("vary_adhesion.py"),
    output:
        f"{STORE}/robustness/{PAIR}.nc",
    params:
        canonical=lambda w: canonical(
            {
                "surface": w.surface,
                "loads": LOADS,
                "count": VARIED["count"],
                "window": STUDY["contact"]["window"],
                "ranges": STUDY["adhesion"]["ranges"],
                "radius": STUDY["sphere"]["radius"],
            }
        ),
    log:
        f"{STORE}/logs/vary_adhesion/{PAIR}.log",
    benchmark:
        f"{STORE}/benchmarks/vary_adhesion/{PAIR}.tsv"
    resources:
        mem_mb=1000,
    script:
        "../scripts/vary_adhesion.py"


FILTERED_VARIANT = "{radius}/{load}/{range}/{surface}/realization-{realization}/{side}-{probe}"


rule vary_scales:
    # forces of one small master without the scales beyond each cutoff
    input:
        scan=scan_of_realization,
        spectrum=lambda w: spectrum_of(w.surface),
        sphere=lambda w: stitched(SPHERE, scans_of(SPHERE)[0]) if w.probe == "rough" else [],
        code=code("vary_scales.py"),
    output:
        f"{STORE}/robustness/{FILTERED_VARIANT}.nc",
    params:
        canonical=lambda w: canonical(
            {
                "surface": plain(w.surface),
                "realization": int(w.realization),
                "side": w.side,
                "seed": STUDY["seed"],
                "scales": STUDY["scales"][w.side] | VARIED[w.side],
                "rho": STUDY["scales"]["range"],
                "loads": LOADS if w.probe == PROBE else LOADS[:1],
                "count": VARIED["count"],
                "window": STUDY["contact"]["window"],
                "radius": STUDY["sphere"]["radius"],
            }
        ),
    log:
        f"{STORE}/logs/vary_scales/{FILTERED_VARIANT}.log",
    benchmark:
        f"{STORE}/benchmarks/vary_scales/{FILTERED_VARIANT}.tsv"
    resources:
        mem_mb=2000,
    wildcard_constraints:
        probe="smooth|rough",
    script:
        "../scripts/vary_scales.py"


VARIED_PAIRS = pairs_of(dict.fromkeys(s for one in VARIANTS for s in one["surfaces"]))
VARIED_MASTERS = list(
    dict.fromkeys(
        (surface, realization, side, one["probe"])
        for one in VARIANTS
        for surface in one["surfaces"]
        for realization in range(1, VARIED["realizations"] + 1)
        for side in ("small", "large")
    )
)


rule aggregate_robustness:
    input:
        adhesion=[pair_file("robustness", *pair) for pair in VARIED_PAIRS],
        scales=[
            rules.vary_scales.output[0].format(
                radius=RADIUS,
                load=LOAD,
                range=RANGE,
                surface=surface,
                realization=realization,
                side=side,
                probe=probe,
            )
            for surface, realization, side, probe in VARIED_MASTERS
        ],
        pull_off="resources/paper/pull_off.csv",
        published="resources/paper/parameters.csv",
        code=code("aggregate_robustness.py"),
    output:
        f"{RESULTS}/robustness.nc",
    params:
        canonical=canonical(
            {
                **{
                    key: STUDY["inference"][key]
                    for key in ("bootstrap_samples", "confidence", "error_threshold")
                },
                "variants": VARIANTS,
                "pairs": VARIED_PAIRS,
                "masters": VARIED_MASTERS,
                "substrates": SUBSTRATES,
                "probe": PROBE,
                **{f"pixels_{side}": VARIED[side]["pixels"] for side in ("small", "large")},
                "count": VARIED["count"],
                "tolerance": STUDY["scales"]["tolerance"],
                "range": STUDY["scales"]["range"],
                "reference_surface": STUDY["reference_surface"],
                "seed": STUDY["seed"],
                "sphere_radius": STUDY["sphere"]["radius"],
                "basis": BASIS,
            }
        ),
    log:
        f"{RESULTS}/logs/aggregate_robustness.log",
    benchmark:
        f"{RESULTS}/benchmarks/aggregate_robustness.tsv"
    resources:
        mem_mb=2000,
    script:
        "../scripts/aggregate_robustness.py"


rule robustness:
    input:
        rules.aggregate_robustness.output,
