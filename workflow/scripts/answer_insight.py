"""The page on what decides the band, part by part."""

from pathlib import Path

from hardcontact.answer.captions import caption
from hardcontact.answer.insight_page import insight_page
from hardcontact.insight.prediction import validated_errors
from hardcontact.records import published
from hardcontact.records.dataset import read
from hardcontact.records.job import job

with job(snakemake) as this:
    datasets, figures = {}, {}
    for dataset, figure in zip(this.input.datasets, this.input.figures, strict=True):
        name = Path(figure).stem
        figures[name] = Path(figure).read_bytes(), caption(name, this.parameters)
        datasets[name] = read(dataset)
    constants = published.constants(this.input.published_constants)
    band, pixels = read(this.input.band), this.parameters["scan"]["pixels"]
    errors = validated_errors(this.input.validation)
    page = insight_page(datasets, band, figures, constants, pixels, errors)
    this.write_text(page, "page")
