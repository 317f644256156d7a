"""The command line of a run: its kind of study, and faults that Snakemake does not explain."""

import sys
from argparse import ArgumentParser, Namespace
from pathlib import Path

import yaml

#: Named targets of workflow/rules/targets.smk, besides single figures.
PAPER_TARGETS = (
    "topography", "adhesion", "elastic", "plasticity", "asperities", "band", "fit", "classical",
    "sets", "claims", "figures", "pages", "answer",
)  # fmt: skip
#: `answer` makes all figures, too; `fit` needs measured forces.
OWN_TARGETS = ("answer", "topography", "adhesion", "band", "force", "fit")


def _options() -> Namespace:
    """Return the configuration files and the keys with values on the command line."""
    parser = ArgumentParser(add_help=False, allow_abbrev=False)
    parser.add_argument("--configfile", "--configfiles", nargs="*", default=[])
    parser.add_argument("--config", "-C", nargs="*", default=[])
    return parser.parse_known_args(sys.argv[1:])[0]


def cost_column() -> str:
    """Return the column of costs: of a quick study, of your surfaces or of the paper."""
    options = _options()
    if "config/quick.yaml" in options.configfile or "effort=quick" in options.config:
        return "quick"
    return "own" if _has_own_surfaces() else "full"


def error_line(exception: str, message: str) -> str:
    """Return the line of an error before the first job, or an empty text for other errors."""
    if exception == "MissingRuleException":
        return _missing_target_line(message.partition("produce ")[2].partition(" ")[0])
    return f"error: {message.strip().splitlines()[-1]}" if message.startswith("Traceback") else ""


def _missing_target_line(name: str) -> str:
    """Return the line of a target that no rule makes: the target it resembles, or all targets."""
    from hardcontact.config.faults import spelling_question
    from hardcontact.report.figures.listing import PAPER_FIGURES

    figures = () if _has_own_surfaces() else PAPER_FIGURES
    targets = OWN_TARGETS if _has_own_surfaces() else PAPER_TARGETS
    # Without measured forces no rule makes the target `fit`.
    question = spelling_question(name, {*targets, *figures} - {name})
    expected = "a target" if question else f"one of {', '.join(targets)}"
    return f"error: expected {expected}, or a file of the study, found {name}{question}"


def _has_own_surfaces() -> bool:
    """Return whether an overlay makes a study of your surfaces."""
    overlays = [yaml.safe_load(Path(path).read_bytes()) for path in _options().configfile]
    return any(overlay.get("published") == "none" for overlay in overlays)


def refuse_faults() -> None:
    """End a run with a line for each fault of its configuration.

    Snakemake names neither file, line nor key.
    """
    from hardcontact.config.faults import collect_faults
    from hardcontact.config.user_files import refuse_unreadable

    options = _options()
    faults: list[str] = []
    for path in options.configfile:
        with collect_faults(faults):
            refuse_unreadable(path)
    for word in options.config:
        with collect_faults(faults):
            _refuse_pair(word)
    if faults:
        sys.exit("\n".join(f"error: {fault}" for fault in faults))


def _refuse_pair(word: str) -> None:
    """Refuse a word of `--config` that is not KEY=VALUE, or whose key has dots."""
    key, equals, value = word.partition("=")
    if not equals:
        raise ValueError(
            f"--config: expected KEY=VALUE, found {word} (targets stand before --config)"
        )
    section, dot, name = key.partition(".")
    if dot:
        nested = f"{{{name.replace('.', ': {')}: {value}" + "}" * key.count(".")
        raise ValueError(f"--config: expected '{section}={nested}', found {word}")
