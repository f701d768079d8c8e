"""scanloom/__init__.pyi names what the module has, and nothing else."""

import ast
import os
import shutil
import subprocess
import unittest
from pathlib import Path

import scanloom
from support import EXAMPLES, SOURCE

STUB = ast.parse((SOURCE / "apps" / "python" / "scanloom" / "__init__.pyi").read_text())


def names_in(definition):
    named = (item for item in definition.body if isinstance(item, (ast.FunctionDef, ast.AnnAssign)))
    return {item.name if isinstance(item, ast.FunctionDef) else item.target.id for item in named}


def public(names):
    return {name for name in names if not name.startswith("_")}


class Stub(unittest.TestCase):
    def test_has_the_members_of_every_class(self):
        for stub in (item for item in STUB.body if isinstance(item, ast.ClassDef)):
            if stub.name in ("Configuration", "UsageError", "ScanloomWarning"):  # whose members are made by __init__
                continue
            members = public(dir(getattr(scanloom, stub.name)))
            inherited = {name for base in stub.bases if getattr(base, "id", "") == "Cloud" for name in dir(scanloom.Cloud)}
            self.assertEqual(public(names_in(stub)), members - inherited, stub.name)

    def test_has_every_name_of_the_module(self):
        defined = {item.name for item in STUB.body if isinstance(item, (ast.FunctionDef, ast.ClassDef))}
        self.assertEqual(defined, set(scanloom.__all__))


@unittest.skipUnless(shutil.which("mypy"), "mypy is missing")
class Mypy(unittest.TestCase):
    def checked(self, scripts):
        files = [Path(f"script_{number:02}.py") for number in range(1, len(scripts) + 1)]
        for file, script in zip(files, scripts):
            file.write_text(script)
        Path("mypy.ini").write_text("[mypy]\n[mypy-matplotlib.*]\nignore_missing_imports = True\n")
        return subprocess.run(["mypy", "--strict", *files], capture_output=True, text=True,
                              env={**os.environ, "MYPYPATH": str(Path(scanloom.__file__).parent.parent)})

    def test_accepts_the_examples_of_the_page(self):
        ended = self.checked(EXAMPLES)
        self.assertEqual(ended.returncode, 0, ended.stdout + ended.stderr)

    def test_refuses_what_fails_when_it_runs(self):
        ended = self.checked(["import scanloom\nscan = next(scanloom.scans('drive'))\nscan.stamp = 0\nscan.colour\n"])
        self.assertIn('Cannot assign to final attribute "stamp"', ended.stdout)
        self.assertIn('"Scan" has no attribute "colour"', ended.stdout)


if __name__ == "__main__":
    unittest.main()
