"""More servers of PostgreSQL beside that of a test (server.py), with its programs: other data, replicas, other databases; and what the
tests of administrators put into them."""
import os
import pathlib
import subprocess

VALUES = {"point3d": "'(1 2 1/3)'", "points3d": "'((0 0 0) (1/7 1 1))'", "vector3d": "'(0 0 1)'", "plane3d": "'(1 0 0 1)'", "rect3": "'(0 1 0 2 0 3)'",
          "region": "'((((0 0) (1 0) (0 1))))'", "surface3d": "'(((0 0 0) (1 0 0) (0 1 0)))'",
          "volume3d": "create_cube('(0 0 0)', '(1/3 2 3)')", "mesh3d": "create_cube('(0 0 0)', '(1 2 3)')::mesh3d"}
ALL_TYPES = "CREATE TABLE kinds AS SELECT i, " + ", ".join(f"{value}::{kind} AS {kind}_value" for kind, value in VALUES.items()) + \
            " FROM generate_series(1, 5) i"
AS_TEXTS = "SELECT i, " + ", ".join(f"as_text({kind}_value)" for kind in VALUES) + " FROM kinds ORDER BY i"

# Solids with an index, a view, a function, a default, a column that is computed, and a condition.
PARTS = "CREATE TABLE parts (i int PRIMARY KEY, solid volume3d NOT NULL DEFAULT '()', box float8 GENERATED ALWAYS AS (volume(solid)) STORED, " \
        "CHECK (volume(solid) >= 0)); " \
        "INSERT INTO parts SELECT i, create_cube(point3d(i, i % 7, 0), point3d(i + 1, i % 7 + 1, 1)) FROM generate_series(1, 2000) i; " \
        "CREATE INDEX parts_in_space ON parts USING gist (solid); ALTER TABLE parts ALTER solid SET STATISTICS 20; " \
        "CREATE INDEX parts_by_hash ON parts USING hash (solid); " \
        "CREATE VIEW seen AS SELECT i, volume(solid) AS volume, solid && rect3(100, 200, 0, 9, 0, 9) AS is_near FROM parts WHERE intersects(solid, rect3(10, 300, 0, 9, 0, 9)); " \
        "CREATE MATERIALIZED VIEW total AS SELECT union_agg(solid) AS solid FROM parts WHERE i < 20; " \
        "CREATE FUNCTION near(p point3d) RETURNS SETOF int LANGUAGE sql STABLE AS 'SELECT i FROM parts ORDER BY solid <-> p LIMIT 3'; ANALYZE parts"
ASKED = "SELECT count(*), sum(volume), count(*) FILTER (WHERE is_near) FROM seen; SELECT volume_exact(solid) FROM total; SELECT near('(70 0 5)'::point3d); " \
        "SET enable_seqscan = off; SELECT count(*) FROM parts WHERE solid && rect3(100.5, 200.5, 0, 9, 0, 9); SELECT sum(box) FROM parts"
WINDOW = "EXPLAIN SELECT FROM parts WHERE solid && rect3(100, 400, 0, 9, 0, 9)"


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
        if self.run("pg_ctl", "-D", self.data, "-l", self.folder / "log", "-w", "start", check=False).returncode != 0:
            raise AssertionError("the server does not start: " + (self.folder / "log").read_text()[-2000:])

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
