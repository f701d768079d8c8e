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
    def test_gives_mypy_the_types_of_the_page_s_examples(self):
        files = [Path(f"example_{number:02}.py") for number in range(1, len(EXAMPLES) + 1)]
        for file, example in zip(files, EXAMPLES):
            file.write_text(example)
        Path("mypy.ini").write_text("[mypy-matplotlib.*]\nignore_missing_imports = True\n")
        ended = subprocess.run(["mypy", "--strict", *files], capture_output=True, text=True,
                               env={**os.environ, "MYPYPATH": str(Path(scanloom.__file__).parent.parent)})
        self.assertEqual(ended.returncode, 0, ended.stdout + ended.stderr)


if __name__ == "__main__":
    unittest.main()
