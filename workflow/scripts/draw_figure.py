"""One figure as PDF, PNG and SVG, and the table it is drawn from."""

from hardcontact.base.job import job
from hardcontact.report.figures.drawing import draw_figure

with job(snakemake) as this:
    draw_figure(this.parameters["figure"], this.input, this.output)
