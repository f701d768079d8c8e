"""scanloom/__init__.pyi names what the module has, and nothing else."""

import ast
import unittest

import scanloom
from support import SOURCE

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


if __name__ == "__main__":
    unittest.main()
