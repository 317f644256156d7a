"""Height maps and spectra: levelling, metrics, filters, random surfaces, and substitutes.

Begin with `height_map` and `spectrum`. `levelling`, `filters` and `metrics` change or measure maps;
`topography` collects metrics and spectra. `synthesis` makes random surfaces from spectra.
`substitute_spectra` makes spectra from descriptions and `spectral_models`. `substitutes` makes
batches of scans that meet Table 1, `features` such batches with bumps or pits.
"""
