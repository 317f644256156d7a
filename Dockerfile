# This image has not been built yet: no Docker daemon was at hand. To build it and run the study:
#   docker build -t study . && docker run -v "$PWD/results:/study/results" study --cores all
FROM python:3.11-slim
WORKDIR /study
COPY pyproject.toml environment.txt Snakefile README.md LICENSE CITATION.cff ./
COPY config config
COPY profiles profiles
COPY resources resources
COPY workflow workflow
# environment.txt reads workflow/constraints.txt and installs the library from workflow/ in place.
RUN pip install --no-cache-dir -r environment.txt
ENTRYPOINT ["snakemake"]
