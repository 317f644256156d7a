"""A finished study described for archives: inputs, outputs, software, authors, as an RO-Crate.

RO-Crate 1.1 with the profile Process Run Crate 0.5 (https://w3id.org/ro/wfrun/process/0.5).
"""

import json
from pathlib import Path

from rocrate.model import ContextEntity, Person
from rocrate.rocrate import ROCrate

from hardcontact import provenance
from hardcontact.dataset import digest

__all__ = ["NAME", "describe", "described"]

NAME = "ro-crate-metadata.json"
PROFILE = "https://w3id.org/ro/wfrun/process/0.5"


def describe(folder, study, citation, versions):
    """The RO-Crate of a study's folder, as a dict to be written to `NAME` in it.

    folder: results/<study>; study: its name; citation: the mapping of CITATION.cff; versions:
    package -> version. Every file below the folder, but for logs and benchmarks, is an output with
    its SHA-256; what the study was made from is named by its path in the repository.
    """
    crate = ROCrate(version="1.1")
    paper = _paper(crate, citation["references"][0])
    root = crate.root_dataset
    root["name"] = f"{citation['title']}: study {study}"
    root["description"] = (
        "Datasets, verdicts and figures of a study of the pull-off force of rough contacts, after "
        f"{citation['references'][0]['title']}. Surfaces that are substitutes are named as such."
    )
    root["datePublished"] = str(citation["date-released"])
    root["license"] = _entity(
        crate, f"https://spdx.org/licenses/{citation['license']}", "CreativeWork",
        name=citation["license"],
    )  # fmt: skip
    root["author"] = [_author(crate, author) for author in citation["authors"]]
    root["citation"] = paper
    root["conformsTo"] = _entity(crate, PROFILE, "CreativeWork", name="Process Run Crate")
    outputs = [
        crate.add_file(dest_path=path.relative_to(folder).as_posix(), properties={"sha256": value})
        for path, value in _files(folder).items()
    ]
    found = provenance.traced(folder)
    inputs, code = [], []
    for path, value in provenance.sources(found).items():
        into = code if path.endswith((".py", "environment.txt")) else inputs
        into.append(_entity(crate, f"#{path}", "CreativeWork", name=path, sha256=value))
    software = _entity(
        crate, "#software", "SoftwareApplication", name=citation["title"], hasPart=code,
        license=root["license"], author=root["author"], citation=paper,
        softwareRequirements=[
            _entity(crate, f"#{name}", "SoftwareApplication", name=name, version=version)
            for name, version in versions.items()
        ],
    )  # fmt: skip
    action = crate.add_action(
        software, "#study", object=inputs, result=outputs, properties={"name": f"study {study}"}
    )
    root["mentions"] = action
    return crate.metadata.generate()


def described(folder):
    """Path -> SHA-256 of the files that the RO-Crate of a folder describes; none without one.

    Raises ValueError if it is damaged.
    """
    path = Path(folder, NAME)
    try:
        graph = json.loads(path.read_text())["@graph"] if path.is_file() else []
        return {
            Path(folder, entity["@id"]).as_posix(): entity["sha256"]
            for entity in graph
            if entity["@type"] == "File"
        }
    except (ValueError, KeyError, TypeError) as error:
        raise ValueError(
            f"{path}: expected a whole RO-Crate, found: {error}; delete it and run again"
        ) from None


def _files(folder):
    """The outputs of a study and their digests; not what differs from run to run."""
    return {
        path: digest([path])
        for path in sorted(Path(folder).rglob("*"))
        if path.is_file()
        and path.name not in (NAME, "report.html")
        and not path.name.startswith(".")
        and path.relative_to(folder).parts[0] not in ("logs", "benchmarks")
    }


def _entity(crate, identifier, kind, **properties):
    return crate.add(ContextEntity(crate, identifier, properties={"@type": kind, **properties}))


def _author(crate, author):
    """A person, or the group that a citation file names as an entity."""
    if "name" in author:
        identifier = f"#{author['name'].replace(' ', '-')}"
        return _entity(crate, identifier, "Organization", name=author["name"])
    name = f"{author['given-names']} {author['family-names']}"
    identifier = author.get("orcid", f"#{name.replace(' ', '-')}")
    return crate.add(Person(crate, identifier, properties={"name": name}))


def _paper(crate, reference):
    return _entity(
        crate, f"https://doi.org/{reference['doi']}", "ScholarlyArticle",
        name=reference["title"], datePublished=str(reference["year"]),
        author=[_author(crate, author) for author in reference["authors"]],
    )  # fmt: skip
