# Contacts that repeat at one place of the sphere.


rule repeat_contact:
    """Press one place of the sphere onto places of a scan and of a large surface."""
    input:
        substrate=PATTERNS.stitched_substrate,
        sphere=PATTERNS.stitched_sphere,
        spectrum=lambda w: FILES.spectrum(w.surface),
        published_constants=PUBLISHED["published_constants"],
        code=code_inputs("repeat_contact.py"),
    output:
        PATTERNS.repeated_contact,
    log:
        PATTERNS.log("repeat_contact", PATTERNS.repeated_contact),
    benchmark:
        PATTERNS.benchmark("repeat_contact", PATTERNS.repeated_contact)
    resources:
        mem_mb=1500,
    params:
        canonical=lambda w: canonical(
            {
                "surface": w.surface,
                "scan": int(w.scan),
                "contact": {
                    **{key: STUDY["contact"][key] for key in ("hardness", "window", "count")},
                    "preload": FILES.repeated_loads[w.load]["preload"],
                },
                "radius": STUDY["sphere"]["radius"],
                "orders": INSIGHT["orders"],
                "size": max(INSIGHT["sizes"]),
                "seed": STUDY["seed"],
            }
        ),
    script:
        "../scripts/repeat_contact.py"


rule aggregate_repeated_contact:
    """Gather repeated contact of all scans: repeated_contact.nc."""
    input:
        pairs=list(FILES.repeated),
        published_constants=PUBLISHED["published_constants"],
        code=code_inputs("aggregate_repeated_contact.py"),
    output:
        PATTERNS.dataset("repeated_contact"),
    log:
        PATTERNS.log("aggregate_repeated_contact"),
    benchmark:
        PATTERNS.benchmark("aggregate_repeated_contact")
    resources:
        mem_mb=1000,
    params:
        canonical=canonical(
            {
                "pairs": list(FILES.repeated.values()),
                **NAMED_SURFACES,
                "confidence": STUDY["inference"]["confidence"],
            }
        ),
    script:
        "../scripts/aggregate_repeated_contact.py"
