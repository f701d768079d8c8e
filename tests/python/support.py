"""What the tests of the Python module share: a drive that the program simulated, and the program itself."""

import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np

PROGRAM = os.environ["SCANLOOM_PROGRAM"]
SOURCE = Path(os.environ["SCANLOOM_SOURCE"])
DRIVE = Path(os.environ["SCANLOOM_DRIVE"])  # folder of a recording with two lidars and an IMU
PAGE = (SOURCE / "doc" / "python.md").read_text()
EXAMPLES = re.findall(r"^```python\n(.*?)^```$", PAGE, re.DOTALL | re.MULTILINE)


def extrinsic(name):
    """body_T_name (4, 4): the rows behind its line in the recording."""
    lines = (DRIVE / "extrinsics.txt").read_text().splitlines()
    first = next(index for index, line in enumerate(lines) if line.startswith(f"T_body_{name} "))
    return np.array([line.split() for line in lines[first + 1 : first + 5]], dtype=float)


def program(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)


def python(script, **environment):
    """Runs a script in an interpreter of its own."""
    return subprocess.run([sys.executable, "-c", script], capture_output=True, text=True,
                          env={**os.environ, **environment})
