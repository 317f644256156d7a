# Untested: where this was written no Docker daemon was at hand to build it.
#   docker build -t study . && docker run -v "$PWD/results:/study/results" study --cores all
FROM python:3.11-slim
WORKDIR /study
COPY environment.txt .
RUN pip install --no-cache-dir -r environment.txt
COPY Snakefile README.md CITATION.cff ./
COPY config config
COPY profiles profiles
COPY resources resources
COPY workflow workflow
ENTRYPOINT ["snakemake"]
