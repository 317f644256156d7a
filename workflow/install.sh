#!/bin/sh
# Makes the environment .venv with the packages of workflow/lock.txt and, if it is named, of another list.
set -e
cd "$(dirname "$0")/.."

for python in python3 python3.14 python3.13 python3.12 python3.11; do
    if "$python" -c 'import sys; sys.exit(not (3, 11) <= sys.version_info < (3, 15))' 2>/dev/null; then
        echo "Installs into .venv: one to two minutes."
        "$python" -m venv .venv
        # pip compiles one module after the other, compileall on all cores.
        .venv/bin/pip install --quiet --no-compile --require-hashes -r workflow/lock.txt ${1:+-r "$1"}
        .venv/bin/pip install --quiet --no-compile --no-deps --editable .
        .venv/bin/python -m compileall -q -j 0 .venv/lib workflow >/dev/null || true # templates are no modules
        exit
    fi
done
echo "python3: expected Python 3.11 to 3.14 on the PATH, found $(python3 --version 2>&1)" >&2
exit 1
