"""The program `hardcontact`: it carries out the command with which its line begins."""

import os
import sys

from hardcontact.commands.new import new_study
from hardcontact.commands.parser import join_units
from hardcontact.commands.request import new_arguments
from hardcontact.config.faults import raise_faults


def main() -> int:
    """Carry out the command line: `new`, `predict`, `verify`, `compare`; return the exit code."""
    words = join_units(sys.argv[1:])
    try:
        # A terminal would obey control characters, and tables are written in UTF-8.
        raise_faults(
            f"{word!r}: expected printable characters in UTF-8, found others"
            for word in words
            if not word.isprintable()
        )
        if words[:1] == ["predict"]:
            from hardcontact.commands.predict import predict, predict_arguments

            print(predict(predict_arguments(words[1:])))
        elif words[:1] == ["verify"]:
            from hardcontact.commands.verify import verify, verify_arguments

            text, code = verify(verify_arguments(words[1:]))
            print(text, flush=True)
            return code
        elif words[:1] == ["compare"]:
            from hardcontact.commands.compare import compare, compare_arguments

            print(compare(compare_arguments(words[1:])))
        else:
            print(new_study(new_arguments(words)))
        sys.stdout.flush()
    except BrokenPipeError:  # The reader of the output has ended, such as `head`.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except ValueError as error:
        for line in dict.fromkeys(str(error).splitlines()):
            print(f"error: {line}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("Stopped before anything was written.", file=sys.stderr)
        return 130
    return 0
