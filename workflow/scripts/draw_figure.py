"""One figure as PDF, PNG and SVG."""

from hardcontact.records.job import run_job
from hardcontact.report.figures.drawing import draw_figure

with run_job(snakemake) as job:
    inputs = {name: job.input[name] for name in job.parameters["inputs"]}
    draw_figure(job.parameters["figure"], job.parameters["title"], inputs, job.output)
