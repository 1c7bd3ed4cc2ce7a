"""A server of PostgreSQL with the extension for the tests of a class: in a folder of its own, ended and removed afterwards."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else \
    os.path.dirname(os.environ.get("ALGEBRA3D_PROGRAM", ""))


class Answer:
    def __init__(self, process):
        self.rows = process.stdout.splitlines()
        self.messages = process.stderr
        self.sql_states = re.findall(r"ERROR:  (\w{5}):", process.stderr)

    @property
    def value(self):
        return self.rows[-1] if self.rows else None


class OwnServer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="a3dpg-", dir="/tmp")
        cls.addClassCleanup(shutil.rmtree, cls.folder, True)
        cls.addClassCleanup(cls.script, "stop")
        cls.script("start", check=True)

    @classmethod
    def script(cls, *arguments, check=False, text=None):
        return subprocess.run([ROOT / "scripts" / "postgres", "--build", BUILD, "--folder", cls.folder, *arguments],
                              input=text, capture_output=True, encoding="utf-8", check=check)

    def sql(self, text, *options):
        """Runs statements in one session; the rows of all of them, unaligned."""
        return Answer(self.script("psql", "-qAt", "-v", "VERBOSITY=verbose", *options, "-f", "-", text=text))

    def value(self, expression):
        answer = self.sql(f"SELECT {expression}")
        self.assertEqual(answer.sql_states, [], answer.messages)
        return answer.value
