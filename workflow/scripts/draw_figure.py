"""One figure as PDF, PNG and SVG, and the table of its data."""

from hardcontact.base.job import job
from hardcontact.report.figures.drawing import draw_figure

with job(snakemake) as job:
    draw_figure(job.parameters["figure"], job.input, job.output)
