"""Height maps and spectra: levelling, metrics, filters, random surfaces, and substitutes.

Begin with `height_map` and `spectrum`. `levelling`, `filters` and `metrics` change or measure maps;
`topography` collects metrics and spectra. `synthesis` makes random surfaces from spectra.
`substitute_spectra` makes spectra from descriptions and `spectral_models`. Scans of `substitutes`
meet Table 1 in batches, those of `features` with bumps or pits.
"""
