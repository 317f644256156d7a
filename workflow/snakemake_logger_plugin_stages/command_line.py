"""The words of Snakemake's command line that it does not explain itself when they are wrong."""

import sys
from argparse import ArgumentParser, Namespace
from functools import partial


def _options() -> Namespace:
    """Return the configuration files and the keys with values on the command line."""
    parser = ArgumentParser(add_help=False, allow_abbrev=False)
    parser.add_argument("--configfile", "--configfiles", nargs="*", default=[])
    parser.add_argument("--config", "-C", nargs="*", default=[])
    return parser.parse_known_args(sys.argv[1:])[0]


def effort() -> str:
    """Return the column of costs for the command line: "quick" for a first answer, else "full"."""
    options = _options()
    is_quick = "config/quick.yaml" in options.configfile or "effort=quick" in options.config
    return "quick" if is_quick else "full"


def error_line(exception: str, message: str) -> str:
    """Return the line of an error before the first job, or an empty text for other errors."""
    if exception == "MissingRuleException":
        name = message.partition("produce ")[2].partition(" ")[0]
        return f"error: expected a target of README.md or a file of the study, found {name}"
    return f"error: {message.strip().splitlines()[-1]}" if message.startswith("Traceback") else ""


def refuse_faults() -> None:
    """End a run with a line for each fault of its configuration.

    Snakemake names neither file, line nor key, and copies nested aliases until memory is full.
    """
    from hardcontact.config.configuration import refuse_unreadable
    from hardcontact.config.faults import refuse_all

    options = _options()
    checks = [partial(refuse_unreadable, path) for path in options.configfile]
    checks += [partial(_refuse_pair, word) for word in options.config]
    try:
        refuse_all(checks)
    except ValueError as error:
        sys.exit("\n".join(f"error: {fault}" for fault in str(error).splitlines()))


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
