"""The page on what decides the band, part by part."""

from pathlib import Path

from hardcontact.answer.captions import caption, web_png
from hardcontact.answer.insight_page import PARTS, AnsweredPart, insight_page
from hardcontact.records import published
from hardcontact.records.dataset import read
from hardcontact.records.job import job

WIDTH = 1400  # pixels of a figure: enough for a phone that has three for each of the page

with job(snakemake) as this:
    parts, substitutes, confidences = {}, {}, set()
    others = {"band": read(this.input.band)}
    files = zip(this.input.datasets, this.input.figures, this.input.captions, strict=True)
    for dataset, figure, template in files:
        made, name = read(dataset), Path(figure).stem
        given = made, *(others[one] for one in PARTS[name].beside)
        parts[name] = AnsweredPart(
            PARTS[name].question,
            PARTS[name].sentences(*given),
            PARTS[name].of_band(*given),
            web_png(Path(figure).read_bytes(), WIDTH),
            caption(Path(template).read_text("utf-8"), this.parameters),
        )
        substitutes |= dict.fromkeys(made["label"].values[made["basis"].values == "substitute"])
        confidences.add(float(made.attrs["confidence"]))
    (confidence,) = confidences
    constants = published.constants(this.input.published_constants)
    made_page = insight_page(parts, list(substitutes), confidence, constants, others["band"])
    this.write_text(made_page, "page")
    this.record("page")
