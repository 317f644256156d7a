"""Each quantitative statement of the paper beside what was computed, with its verdict."""

from hardcontact import claims, dataset, log

log.start(snakemake.log[0])
names = (
    "topography", "adhesion", "scales", "inference", "elastic", "indent", "asperities", "classical",
)  # fmt: skip
datasets = {name: dataset.read(snakemake.input[name]) for name in names}
evaluated = claims.evaluate(claims.read_claims(snakemake.input.claims), datasets)
with dataset.atomic_path(snakemake.output.claims) as path:
    evaluated.to_csv(path, index=False, float_format="%.6g")
dataset.record(
    snakemake.output.record,
    [snakemake.output.claims],
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
