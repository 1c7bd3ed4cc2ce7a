"""More servers of PostgreSQL beside that of a test (server.py), with its programs: other data, replicas, other databases."""
import os
import pathlib
import subprocess


class Cluster:
    """The data in a folder and the server on them. `programs` is the folder `server` of a test's own server."""

    def __init__(self, programs, folder):
        self.binaries = pathlib.Path(programs) / "server/lib/postgresql/15/bin"
        self.folder = pathlib.Path(folder)
        self.data = self.folder / "data"

    def run(self, program, *arguments, text=None, check=True, **options):
        """A program of PostgreSQL, as the user who may run servers."""
        user = ["setpriv", "--reuid=postgres", "--regid=postgres", "--init-groups"] if os.getuid() == 0 else []
        made = subprocess.run([*user, self.binaries / program, *map(str, arguments)], input=text, capture_output=True, encoding="utf-8",
                              cwd=self.folder, **options)
        if check and made.returncode != 0:
            raise AssertionError(f"{program} {' '.join(map(str, arguments))}: {made.stdout}{made.stderr}")
        return made

    def make_folder(self):
        self.folder.mkdir()
        if os.getuid() == 0:
            subprocess.run(["chown", "postgres", self.folder], check=True)

    def make(self, *settings):
        self.make_folder()
        self.run("initdb", "-D", self.data, "-U", "postgres", "-A", "trust", "-E", "UTF8", "--locale", "C.UTF-8", "--no-sync")
        self.set(*settings)

    def set(self, *settings):
        with open(self.data / "postgresql.conf", "a", encoding="utf-8") as file:
            file.write("\n".join(["", "listen_addresses = ''", f"unix_socket_directories = '{self.folder}'", *settings, ""]))

    def start(self):
        self.run("pg_ctl", "-D", self.data, "-l", self.folder / "log", "-w", "start")

    def stop(self, how="fast"):
        if (self.data / "postmaster.pid").exists():
            self.run("pg_ctl", "-D", self.data, "-m", how, "stop", check=False)

    def sql(self, text, database="postgres", check=True):
        """The rows of statements, unaligned."""
        made = self.run("psql", "-X", "-qAt", "-v", "VERBOSITY=verbose", "-v", "ON_ERROR_STOP=1", "-h", self.folder, "-U", "postgres", "-d", database,
                        "-f", "-", text=text, check=False)
        if check and made.returncode != 0:
            raise AssertionError(f"{text[:200]}: {made.stderr}")
        return made.stdout.splitlines() if check else made
