"""The description of a finished study for archives: inputs, outputs, software, authors.

It is an RO-Crate 1.1 of the profile Process Run Crate 0.5 (https://w3id.org/ro/wfrun/process/0.5).
"""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import yaml
from rocrate.model import ContextEntity
from rocrate.rocrate import ROCrate

from hardcontact.base import provenance
from hardcontact.base.code import PINS
from hardcontact.base.origin import digest

CRATE_FILE = "ro-crate-metadata.json"
PROFILE = "https://w3id.org/ro/wfrun/process/0.5"


def crate_text(
    folder: str | Path, study: str, citation: str | Path, versions: Mapping[str, str]
) -> str:
    """Return the RO-Crate of ``results/<study>`` as JSON text, for the file `CRATE_FILE` in it.

    Every file in the folder is an output with its SHA-256, except for logs, benchmarks, the
    crate itself and ``report.html``. Inputs are named by their paths in the repository. Equal files
    give an equal text.

    folder: ``results/<study>``.
    versions: the version of each package.
    Raises ValueError if a record of a result is damaged.
    """
    citation_data = yaml.safe_load(Path(citation).read_text("utf-8"))
    crate = ROCrate(version="1.1")
    paper = _add_paper(crate, citation_data["references"][0])
    _describe_root(crate, citation_data, study, paper)
    outputs = [
        crate.add_file(dest_path=path.relative_to(folder).as_posix(), properties={"sha256": sha256})
        for path, sha256 in _files(folder).items()
    ]
    inputs = list[ContextEntity]()
    code = list[ContextEntity]()
    for path, sha256 in provenance.sources(provenance.traced_records(folder)).items():
        entities = code if path.endswith((".py", *PINS)) else inputs
        entities.append(_add_entity(crate, f"#{path}", "CreativeWork", name=path, sha256=sha256))
    software = _add_entity(
        crate, "#software", "SoftwareApplication", name=citation_data["title"], hasPart=code,
        license=crate.root_dataset["license"], author=crate.root_dataset["author"], citation=paper,
        softwareRequirements=[
            _add_entity(crate, f"#{name}", "SoftwareApplication", name=name, version=version)
            for name, version in versions.items()
        ],
    )  # fmt: skip
    crate.root_dataset["mentions"] = crate.add_action(
        software, "#study", object=inputs, result=outputs, properties={"name": f"study {study}"}
    )
    return json.dumps(crate.metadata.generate(), indent=1, sort_keys=True, ensure_ascii=False)


def described_files(folder: str | Path) -> dict[str, str]:
    """Return the files that the RO-Crate of ``results/<study>`` describes.

    folder: ``results/<study>``.
    Returns path and SHA-256; empty if there is no crate.
    Raises ValueError if the crate is damaged.
    """
    path = Path(folder, CRATE_FILE)
    try:
        graph = json.loads(path.read_text("utf-8"))["@graph"] if path.is_file() else []
        return {
            Path(folder, entity["@id"]).as_posix(): entity["sha256"]
            for entity in graph
            if entity["@type"] == "File"
        }
    except (ValueError, KeyError, TypeError) as error:
        raise ValueError(
            f"{path}: expected a whole RO-Crate, found: {error}; delete it and run again"
        ) from None


def _files(folder: str | Path) -> dict[Path, str]:
    """Return the outputs of a study and their digests.

    Logs, benchmarks, hidden files, the crate itself and ``report.html`` are left out.
    """
    return {
        path: digest(path)
        for path in sorted(Path(folder).rglob("*"))
        if path.is_file()
        and path.name not in (CRATE_FILE, "report.html")
        and not any(part.startswith(".") for part in path.relative_to(folder).parts)
        and path.relative_to(folder).parts[0] not in ("logs", "benchmarks")
    }


def _describe_root(
    crate: ROCrate, citation: dict[str, Any], study: str, paper: ContextEntity
) -> None:
    """Describe the whole folder: title, content, authors and licence."""
    root = crate.root_dataset
    root["name"] = f"{citation['title']}: study {study}"
    root["description"] = (
        "Datasets, verdicts and figures of a study of the pull-off force of rough contacts, after "
        f"{citation['references'][0]['title']}. Surfaces that are substitutes are named as such."
    )
    root["datePublished"] = str(citation["date-released"])
    root["license"] = _add_entity(
        crate, f"https://spdx.org/licenses/{citation['license']}", "CreativeWork",
        name=citation["license"],
    )  # fmt: skip
    root["author"] = [_add_author(crate, author) for author in citation["authors"]]
    root["citation"] = paper
    root["conformsTo"] = _add_entity(crate, PROFILE, "CreativeWork", name="Process Run Crate")


def _add_entity(crate: ROCrate, identifier: str, kind: str, **properties: Any) -> ContextEntity:
    return crate.add(ContextEntity(crate, identifier, properties={"@type": kind, **properties}))


def _add_author(crate: ROCrate, author: dict[str, str]) -> ContextEntity:
    """Add a person, or the group that a citation file names as an entity."""
    name = author.get("name") or f"{author['given-names']} {author['family-names']}"
    identifier = author.get("orcid", f"#{name.replace(' ', '-')}")
    return _add_entity(
        crate, identifier, "Organization" if "name" in author else "Person", name=name
    )


def _add_paper(crate: ROCrate, reference: dict[str, Any]) -> ContextEntity:
    """Add the paper that the study is about."""
    return _add_entity(
        crate, f"https://doi.org/{reference['doi']}", "ScholarlyArticle",
        name=reference["title"], datePublished=str(reference["year"]),
        author=[_add_author(crate, author) for author in reference["authors"]],
    )  # fmt: skip
