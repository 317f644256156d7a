"""One figure as PDF, PNG and SVG, and the table it is drawn from."""

from hardcontact.figures.drawing import draw_figure
from hardcontact.records.job import job

with job(snakemake) as this:
    draw_figure(this.parameters["figure"], this.input, this.output)
