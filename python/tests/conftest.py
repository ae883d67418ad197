"""The command of the package, for comparison."""

import subprocess
import sys

import pytest


@pytest.fixture
def command():
    def run(*arguments: str, code: int = 0) -> str:
        done = subprocess.run(
            [sys.executable, "-m", "liouville", *arguments],
            capture_output=True,
            encoding="utf-8",
            timeout=300,
        )
        assert done.returncode == code, done.stderr
        return done.stdout

    return run
