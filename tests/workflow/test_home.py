"""A run by a user without an entry in passwd, whose home takes no files."""

import getpass
import os
from pathlib import Path

from snakemake_logger_plugin_stages.home import provide_home

#: The names that Python asks before it asks passwd.
NAMES = ("LOGNAME", "USER", "LNAME", "USERNAME")


def unknown_user(number):
    raise KeyError(f"getpwuid(): uid not found: {number}")


def test_an_unknown_user_gets_a_name_and_a_home(monkeypatch, tmp_path):
    for name in NAMES:
        monkeypatch.setenv(name, "")
    monkeypatch.setattr("pwd.getpwuid", unknown_user)
    monkeypatch.setenv("HOME", str(tmp_path / "missing"))
    provide_home(tmp_path / "given")
    assert getpass.getuser() == str(os.getuid())
    assert Path.home() == tmp_path / "given" and Path.home().is_dir()
    provide_home(tmp_path / "other")  # not needed, because the home takes files now
    assert Path.home() == tmp_path / "given"
