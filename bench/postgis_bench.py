#!/usr/bin/env python3
"""The extension of PostgreSQL beside PostGIS with SFCGAL, in one private server (scripts/postgres) that is made for the run.

Usage: bench/postgis_bench.py PROGRAM [--whole] [--rows N] [--connections N...] [--only PART...]

PROGRAM lies in the build whose extension is measured. Needs postgresql-15-postgis-3 and postgresql-15-postgis-3-scripts.
Prints a table of medians of the processor time that a backend takes for each call, which other work on the machine changes
little, and how often each was measured. Answers of PostGIS that take more than a
few seconds are measured once; those that take minutes are quoted from an earlier measurement on a machine of the same
kind ("quoted"), and measured with --whole. N are the rows of COPY,
and of push and pull (10,000); --only load measures these alone.

Spheres are geodesic: the faces of an icosahedron, each divided by a frequency, with corners on the unit sphere. The
second of a pair is rotated about (1, sqrt 2, sqrt 3) by sqrt(2)/7 rad and moved by 0.3 in x.

PARTS are operations, numbers, copy, parts (an intersection in two parts), index (builds, windows, nearest ones and a join of boxes, of
100,000 solids), join (exact self join of 10,000 solids of 80 triangles, beside PostGIS and beside the program's own join, on one
processor each) and parallel (union_agg by workers, on the clock).
"""

import argparse
import math
import os
import pathlib
import re
import resource
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "postgres"))
from connection import Connection  # noqa: E402

# Seconds of PostGIS 3.3.2 with SFCGAL 1.4.1, processor time.
QUOTED = {"volume 1280": 335, "self join": 148}


def sphere(frequency):
    """Points and triangles; 20 * frequency^2 of these."""
    t = (1 + math.sqrt(5)) / 2
    corners = [(-1, t, 0), (1, t, 0), (-1, -t, 0), (1, -t, 0), (0, -1, t), (0, 1, t), (0, -1, -t), (0, 1, -t), (t, 0, -1), (t, 0, 1),
               (-t, 0, -1), (-t, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6), (7, 1, 8),
             (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    numbers, points, triangles = {}, [], []

    def number(face, weights):
        # Weights of the corners, equal on the edge that two faces share.
        key = tuple(sorted((corner, weight) for corner, weight in zip(face, weights) if weight))
        if key not in numbers:
            point = [sum(corners[corner][axis] * weight for corner, weight in key) for axis in range(3)]
            length = math.sqrt(sum(c * c for c in point))
            numbers[key] = len(points)
            points.append(tuple(c / length for c in point))
        return numbers[key]

    for face in faces:
        for i in range(frequency):
            for j in range(frequency - i):
                k = frequency - i - j
                a, b, c = number(face, (k, i, j)), number(face, (k - 1, i + 1, j)), number(face, (k - 1, i, j + 1))
                triangles.append((a, b, c))
                if k > 1:
                    triangles.append((b, number(face, (k - 2, i + 1, j + 1)), c))
    return points, triangles


def turned(points):
    """Rotated and moved as the second of a pair is."""
    axis = [c / math.sqrt(6) for c in (1, math.sqrt(2), math.sqrt(3))]
    cos, sin = math.cos(math.sqrt(2) / 7), math.sin(math.sqrt(2) / 7)
    result = []
    for p in points:
        dot = sum(a * c for a, c in zip(axis, p))
        cross = (axis[1] * p[2] - axis[2] * p[1], axis[2] * p[0] - axis[0] * p[2], axis[0] * p[1] - axis[1] * p[0])
        q = [c * cos + x * sin + a * dot * (1 - cos) for c, x, a in zip(p, cross, axis)]
        result.append((q[0] + 0.3, q[1], q[2]))
    return result


def beside(points):
    return [(x + 2.01, y, z) for x, y, z in points]


def value_list(points, triangles):
    return "(" + " ".join("(" + " ".join("(%r %r %r)" % points[c] for c in t) + ")" for t in triangles) + ")"


def well_known_text(points, triangles):
    rings = ("((" + ",".join("%r %r %r" % points[c] for c in (*t, t[0])) + "))" for t in triangles)
    return "POLYHEDRALSURFACE Z (" + ",".join(rings) + ")"


class Bench:
    def __init__(self, connection, is_whole):
        self.connection = connection
        self.is_whole = is_whole
        self.lines = []

    def run(self, sql):
        answer = self.connection.query(sql)
        if answer.sql_state:
            raise RuntimeError(f"{answer.sql_state} {answer.message[:300]}: {sql[:300]}")
        return answer

    def seconds(self, sql, runs, per_statement=1):
        """The median for each call, and the answer of the last."""
        times = []
        for _ in range(runs):
            begin = self.processor_seconds()
            answer = self.run(sql)
            times.append((self.processor_seconds() - begin) / per_statement)
        return statistics.median(times), answer

    def processor_seconds(self):
        """Of all threads of the backend."""
        tasks = pathlib.Path(f"/proc/{self.connection.pid}/task").iterdir()
        return sum(int((task / "schedstat").read_text().split()[0]) for task in tasks) / 1e9

    def row(self, name, ours, peer=None, key=None, runs=9, peer_runs=5, calls=1):
        """Measures `ours`, a statement with `calls` calls, and `peer`, with one, or quotes it."""
        self.seconds(ours, 1)
        own, answer = self.seconds(ours, runs, calls)
        how, their = "", None
        if key in QUOTED and not self.is_whole:
            their, how = QUOTED[key], "quoted"
        elif peer is not None:
            their, _ = self.seconds(peer, peer_runs)
            how = f"median of {peer_runs}" if peer_runs > 1 else "once"
        self.line(name, own, their, f"{runs} runs of {calls}", how)
        return answer

    def line(self, name, own, their, how, peer_how):
        ratio = "" if their is None else f"{their / own:,.{0 if their > 10 * own else 1}f}"
        cells = (name, shown(own), "" if their is None else shown(their), ratio, how, peer_how)
        self.lines.append("| " + " | ".join(cells) + " |")
        print(self.lines[-1], flush=True)


def shown(seconds):
    if seconds >= 1:
        return f"{seconds:.3g} s"
    return f"{seconds * 1000:.3g} ms"


def prepare(bench):
    bench.run("SET client_min_messages = warning; CREATE EXTENSION IF NOT EXISTS postgis; CREATE EXTENSION IF NOT EXISTS postgis_sfcgal")
    bench.run("CREATE TABLE shapes (triangles int, which text, solid volume3d, geom geometry)")
    for frequency in (2, 4, 8, 16):
        points, triangles = sphere(frequency)
        for which, moved in (("first", points), ("second", turned(points)), ("beside", beside(points))):
            bench.run(f"INSERT INTO shapes VALUES ({len(triangles)}, '{which}', '{value_list(moved, triangles)}', "
                      f"'{well_known_text(moved, triangles)}')")
    bench.run("ANALYZE shapes")


def pairs(call, triangles, second="second", calls=1, column="solid"):
    a, b = f"a.{column}", f"b.{column}"
    return f"SELECT count({call.format(a=a, b=b)}) FROM shapes a, shapes b, generate_series(1, {calls}) WHERE " \
           f"a.triangles = {triangles} AND b.triangles = {triangles} AND a.which = 'first' AND b.which = '{second}'"


def measure_operations(bench):
    for name, ours, peer in (("union", "union_of({a}, {b})", "ST_3DUnion({a}, {b})"),
                             ("intersection", "intersection({a}, {b})", "ST_3DIntersection({a}, {b})"),
                             ("difference", "difference({a}, {b})", "ST_3DDifference({a}, {b})")):
        bench.row(f"{name} of two spheres of 80 triangles", pairs(ours, 80, calls=200),
                  pairs(peer, 80, column="geom"), peer_runs=3, calls=200)
        bench.row(f"{name} of two spheres of 320 triangles", pairs(ours, 320, calls=100),
                  pairs(peer, 320, column="geom"), peer_runs=1, calls=100)
    bench.row("union of two spheres of 5,120 triangles", pairs("union_of({a}, {b})", 5120, calls=10), calls=10)


def measure_numbers(bench):
    for triangles, calls, key in ((80, 1000, None), (320, 1000, None), (1280, 500, "volume 1280")):
        one = f"FROM shapes WHERE triangles = {triangles} AND which = 'first'"
        bench.row(f"volume of {triangles:,} triangles", f"SELECT sum(volume(solid)) FROM shapes, generate_series(1, {calls}) "
                  f"WHERE triangles = {triangles} AND which = 'first'", f"SELECT ST_Volume(ST_MakeSolid(geom)) {one}", key=key, calls=calls,
                  peer_runs=3 if triangles == 80 else 1)
    for triangles, peer_runs in ((320, 3), (1280, 3), (5120, 1)):
        bench.row(f"distance of two spheres of {triangles:,} triangles", pairs("distance({a}, {b})", triangles, "beside", 20),
                  pairs("ST_3DDistance({a}, {b})", triangles, "beside", column="geom"), calls=20,
                  peer_runs=peer_runs)


def measure_copy(bench, folder, rows):
    bench.run(f"CREATE TABLE ours (i int, v volume3d); CREATE TABLE theirs (i int, v geometry);"
              f"INSERT INTO ours SELECT i, round_coordinates(translate(solid, vector3d(i / 3.0, 0, 0))) FROM shapes, generate_series(1, {rows}) i "
              f"WHERE triangles = 1280 AND which = 'first';"
              f"INSERT INTO theirs SELECT i, ST_Translate(geom, i / 3.0, 0, 0) FROM shapes, generate_series(1, {rows}) i "
              f"WHERE triangles = 1280 AND which = 'first'; CHECKPOINT")
    for name, statement in (("out", "COPY {table} TO '{file}' (FORMAT binary)"),
                            ("in, ours with proof", "TRUNCATE back_{table}; COPY back_{table} FROM '{file}' (FORMAT binary)")):
        times = {"ours": [], "theirs": []}
        bench.run("CREATE TABLE IF NOT EXISTS back_ours (LIKE ours); CREATE TABLE IF NOT EXISTS back_theirs (LIKE theirs)")
        for _ in range(3):
            for table in times:  # in turns
                times[table].append(bench.seconds(statement.format(table=table, file=f"{folder}/{table}.copy"), 1)[0])
        bench.line(f"COPY BINARY {name}, {rows:,} solids of 1,280 triangles", statistics.median(times["ours"]),
                   statistics.median(times["theirs"]), "3 runs in turns", "3 runs in turns")
    sizes = bench.run("SELECT pg_total_relation_size('back_ours'), pg_total_relation_size('back_theirs')").rows[0]
    files = [os.path.getsize(f"{folder}/{table}.copy") for table in ("ours", "theirs")]
    print(f"tables: ours {int(sizes[0]) / 1e6:,.1f} MB, PostGIS {int(sizes[1]) / 1e6:,.1f} MB (ratio {int(sizes[1]) / int(sizes[0]):.2f}); "
          f"files of COPY: {files[0] / 1e6:,.1f} MB and {files[1] / 1e6:,.1f} MB")
    same = bench.run("SELECT count(*) FROM ours JOIN back_ours b USING (i) WHERE ours.v = b.v").value
    print(f"of {rows:,} rows {same} came back equal")


class Load:
    """A client that loads a table: its time by the clock, and the processor time of the client and its backends."""

    def __init__(self, folder):
        self.postmaster = pathlib.Path(folder, "data", "postmaster.pid").read_text().split()[0]

    def ended_backends(self):
        fields = pathlib.Path(f"/proc/{self.postmaster}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[13]) + int(fields[14])) / os.sysconf("SC_CLK_TCK")

    def seconds(self, command):
        before, clock, backends = os.times(), time.monotonic(), self.ended_backends()
        subprocess.run(command, check=True, capture_output=True)
        clock = time.monotonic() - clock
        after = os.times()
        time.sleep(0.5)  # until the backends have ended
        client = after.children_user + after.children_system - before.children_user - before.children_system
        return clock, client, self.ended_backends() - backends


def measure_load(bench, folder, program, rows, connections):
    """Relation to table by `push`, table to relation by `pull`, beside psql's \\copy of the same solids for PostGIS."""
    load, database = Load(folder), f"{folder}/load.db"
    server = f"host={folder} user=postgres dbname=postgres"
    move = {"pull": [program, "pull", "--pg", server, "--db", database, "--table", "ours", "--replace", "--quiet"]}
    for count in connections:
        move[f"push, {count} connection{'s' if count > 1 else ''}"] = [
            program, "push", "--pg", server, "--db", database, "--relation", "Ours", "--table", "pushed", "--connections", str(count), "--quiet"]
    psql = ["psql", "-X", "-q", "-h", folder, "-U", "postgres", "postgres", "-c"]
    for form in ("binary", "text"):
        subprocess.run([*psql, f"\\copy theirs TO '{folder}/theirs.{form}' (FORMAT {form})"], check=True)
        move[f"PostGIS, \\copy in {form} format"] = [*psql, f"\\copy loaded FROM '{folder}/theirs.{form}' (FORMAT {form})"]
    times = {name: [] for name in move}
    for _ in range(3):
        for name, command in move.items():  # in turns
            bench.run("DROP TABLE IF EXISTS pushed, loaded; CREATE TABLE loaded (LIKE theirs); CHECKPOINT")
            times[name].append(load.seconds(command))
    print(f"\n{rows:,} solids of 1,280 triangles, medians of 3 in turns: seconds by the clock, of the processor in client and server")
    medians = {name: [statistics.median(column) for column in zip(*each)] for name, each in times.items()}
    peer = next(each for name, each in medians.items() if "binary" in name)
    for name, (clock, client, backends) in medians.items():
        print(f"| {name} | {clock:.2f} s | {client:.2f} s | {backends:.2f} s | "
              f"{peer[0] / clock:.2f} times PostGIS in binary format by the clock, {sum(peer[1:]) / (client + backends):.2f} by the processor |")


TWO_PARTS = {
    "ours": "WITH s AS (SELECT create_cube('(0 0 0)', '(3 3 1)') - create_cube('(1 0 0)', '(2 2 1)') AS clamp, "
            "create_cube('(-1 -1 0)', '(4 0.2 1)') AS bar) SELECT volume(clamp * bar), (SELECT count(*) FROM components(clamp * bar)) FROM s",
    "PostGIS": "WITH s AS (SELECT ST_MakeSolid(ST_Extrude('POLYGON((0 0,1 0,1 2,2 2,2 0,3 0,3 3,0 3,0 0))', 0, 0, 1)) AS clamp, "
               "ST_MakeSolid(ST_Extrude('POLYGON((-1 -1,4 -1,4 0.2,-1 0.2,-1 -1))', 0, 0, 1)) AS bar) "
               "SELECT ST_Volume(ST_MakeSolid(ST_3DIntersection(clamp, bar))) FROM s"}


def ask_for_two_parts(connection):
    for name, sql in TWO_PARTS.items():
        answer = connection.query(sql)
        print(f"volume of an intersection in two parts, {name}: " +
              (f"{answer.sql_state} {answer.message[:120]}" if answer.sql_state else " in ".join(answer.rows[0]) + (
                  " parts" if name == "ours" else "")))


def cube_text(side):
    """A box at the origin as 12 triangles of PostGIS."""
    points = [tuple(side * (bits >> axis & 1) for axis in range(3)) for bits in range(8)]
    faces = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    return well_known_text(points, [triangle for a, b, c, d in faces for triangle in ((a, b, c), (a, c, d))])


def prepare_boxes(bench, count):
    """Two tables of boxes with sides of 1.2, evenly in a cube, as solids of both kinds; windows and points."""
    place = "random() * 100 AS x, random() * 100 AS y, random() * 100 AS z"
    bench.run("SELECT setseed(0.375)")
    for table in ("boxes", "others"):
        bench.run(f"CREATE TABLE {table}_places AS SELECT i, {place} FROM generate_series(1, {count}) i; CREATE TABLE our_{table} AS SELECT i, "
                  f"create_cube(point3d(x, y, z), point3d(x + 1.2, y + 1.2, z + 1.2)) AS v FROM {table}_places; "
                  f"CREATE TABLE their_{table} AS SELECT i, ST_Translate('{cube_text(1.2)}', x, y, z) AS v FROM {table}_places")
    bench.run(f"CREATE TABLE windows AS SELECT i, rect3(x, x + 3, y, y + 3, z, z + 3) AS ours, ST_MakeLine(ST_MakePoint(x, y, z), ST_MakePoint(x + 3, y + 3, z + 3)) "
              f"AS theirs FROM (SELECT i, {place} FROM generate_series(1, {count // 10}) i) w; CREATE TABLE asked AS SELECT i, point3d(x, y, z) AS ours, "
              f"ST_MakePoint(x, y, z) AS theirs FROM (SELECT i, {place} FROM generate_series(1, {count // 100}) i) p")
    bench.run("VACUUM ANALYZE")


def measure_index(bench):
    count = 100_000
    prepare_boxes(bench, count)
    drop = "DROP INDEX IF EXISTS by_space; "
    bench.row(f"index build, {count:,} solids", f"{drop}CREATE INDEX by_space ON our_boxes USING gist (v)",
              f"DROP INDEX IF EXISTS their_space; CREATE INDEX their_space ON their_boxes USING gist (v gist_geometry_ops_nd)", runs=5)
    # PostGIS finds the nearest boxes by the distances of boxes; solids are found by their own.
    bench.run("CREATE TABLE rect_boxes AS SELECT i, bbox(v) AS v FROM our_boxes; CREATE INDEX ON rect_boxes USING gist (v)")
    bench.run("VACUUM ANALYZE our_boxes, their_boxes, rect_boxes")
    answers = {}
    for name, query, calls in (
            (f"join of the boxes of {count:,} and {count:,} solids", "SELECT count(*) FROM {0}_others a JOIN {0}_boxes b ON a.v {1} b.v", 1),
            (f"a window on {count:,} solids", "SELECT count(*) FROM windows w JOIN {0}_boxes b ON b.v {1} w.{2}", count // 10),
            (f"the 10 nearest of {count:,} boxes", "SELECT count(*) FROM asked a, LATERAL (SELECT i FROM {4}_boxes b ORDER BY b.v {3} a.{2} LIMIT 10) n", count // 100),
            (f"the 10 nearest of {count:,} solids", "SELECT count(*) FROM asked a, LATERAL (SELECT i FROM {0}_boxes b ORDER BY b.v {3} a.{2} LIMIT 10) n", count // 100)):
        ours, theirs = query.format("our", "&&", "ours", "<->", "rect"), query.format("their", "&&&", "theirs", "<<->>", "their")
        own, answers["ours"] = bench.seconds(ours, 5, calls)
        peer, answers["theirs"] = bench.seconds(theirs, 3, calls)
        bench.line(name, own, peer, f"5 runs of {calls}", f"3 runs of {calls}")
        print(f"  rows: {answers['ours'].value} and {answers['theirs'].value}")
        for query in (ours, theirs):
            print("  plan:", " / ".join(row[0].strip() for row in bench.run(f"EXPLAIN {query}").rows))


def prepare_solids(bench, count):
    """Solids of 80 triangles, about one and a half partners by boxes each."""
    bench.run(f"SELECT setseed(0.625); CREATE TABLE solid_places AS SELECT i, random() * 52 AS x, random() * 52 AS y, random() * 52 AS z FROM generate_series(1, {count}) i;"
              "CREATE TABLE our_solids AS SELECT i, round_coordinates(translate(solid, vector3d(x, y, z))) AS v FROM solid_places, shapes WHERE triangles = 80 AND which = 'first';"
              "CREATE TABLE their_solids AS SELECT i, ST_Translate(geom, x, y, z) AS v FROM solid_places, shapes WHERE triangles = 80 AND which = 'first';"
              "CREATE INDEX ON our_solids USING gist (v); CREATE INDEX ON their_solids USING gist (v gist_geometry_ops_nd)")
    bench.run("VACUUM ANALYZE our_solids, their_solids")


def seconds_of_program(program, folder, rows):
    """Processor time of the program's own join of the same solids, on one processor, and its number of pairs."""
    def run(commands):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(["taskset", "-c", "0", program, "--db", f"{folder}/joined.db", "--format", "list", "-c", commands], capture_output=True,
                              text=True, cwd=folder, check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done.stdout
    pathlib.Path(folder, "solids.csv").write_text("No,S\n" + "".join(f'{i},"{solid}"\n' for i, solid in rows))
    run("let Solids = importCSV('solids.csv', [const rel(tuple([No: int, S: volume3d])) value ()]) consume")
    join = 'query Solids feed spatialSelfJoin[S; "intersects"] count'
    idle = statistics.median(run("query Solids feed filter[.No < 0] count")[0] for _ in range(3))
    results = [run(join) for _ in range(5)]
    return statistics.median(seconds for seconds, _ in results) - idle, re.search(r"\d+", results[0][1])[0]


def measure_join(bench, program, folder):
    count = 10_000
    prepare_solids(bench, count)
    query = "SELECT count(*) FROM {0}_solids a JOIN {0}_solids b ON {1} WHERE a.i < b.i"
    ours = query.format("our", "intersects(a.v, b.v)")
    answer = bench.row(f"exact self join of {count:,} solids of 80 triangles", ours, query.format("their", "a.v &&& b.v AND ST_3DIntersects(a.v, b.v)"), key="self join",
                       runs=5, peer_runs=1)
    print("  plan:", " / ".join(row[0].strip() for row in bench.run(f"EXPLAIN {ours}").rows))
    boxes = bench.run(query.format("our", "a.v && b.v")).value
    rows = bench.run("SELECT i, as_text(v) FROM our_solids").rows
    own, _ = bench.seconds(ours, 5)
    embedded, pairs = seconds_of_program(program, folder, rows)
    print(f"  pairs: {answer.value} of {boxes} by boxes; the program's own join, on one processor: {pairs} pairs in {shown(embedded)}; "
          f"here {shown(own)}, {own / embedded:.2f} times as much")


def measure_parallel(bench):
    """On the clock, in turns, as if the extension allowed it; the leader computes, too."""
    bench.run("UPDATE pg_proc SET proparallel = 's' WHERE proname = 'union_agg'")
    bench.run("CREATE TABLE IF NOT EXISTS united AS SELECT i, translate(solid, vector3d(i % 25 * 1.7, i / 25 % 20 * 1.7, i / 500 * 1.7)) AS v "
              "FROM generate_series(1, 10000) i, shapes WHERE triangles = 80 AND which = 'first'")
    bench.run("VACUUM ANALYZE united")
    bench.run("SET algebra3d.memory = '2GB'; SET min_parallel_table_scan_size = 0; SET parallel_setup_cost = 0; SET parallel_tuple_cost = 0")
    times = {0: [], 1: [], 2: []}
    for _ in range(3):
        for workers in times:
            begin = time.monotonic()
            answer = bench.run(f"SET max_parallel_workers_per_gather = {workers}; SELECT volume(union_agg(v)), size(union_agg(v)) FROM united")
            times[workers].append(time.monotonic() - begin)
            print(f"  {workers} workers: {times[workers][-1]:.2f} s, {answer.rows[-1]}")
    alone = statistics.median(times[0])
    print("plan:", " / ".join(row[0].strip() for row in bench.run("EXPLAIN SELECT volume(union_agg(v)) FROM united").rows))
    print(f"union_agg of 10,000 solids of 80 triangles, on the clock: {alone:.2f} s alone; " +
          ", ".join(f"{workers} workers {alone / statistics.median(times[workers]):.2f} times as fast" for workers in (1, 2)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--whole", action="store_true")
    parser.add_argument("--rows", type=int, default=10000)
    parser.add_argument("--connections", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--only", nargs="+", default=["operations", "numbers", "copy", "load", "parts", "index", "join", "parallel"])
    options = parser.parse_args()
    if not pathlib.Path("/usr/share/postgresql/15/extension/postgis_sfcgal.control").exists():
        print("left out: postgresql-15-postgis-3 and postgresql-15-postgis-3-scripts are not installed")
        return
    with tempfile.TemporaryDirectory(prefix="a3dgis-", dir="/var/tmp") as folder:
        script = [ROOT / "scripts" / "postgres", "--build", pathlib.Path(options.program).resolve().parent, "--folder", folder]
        subprocess.run([*script, "start"], check=True)
        try:
            connection = Connection(folder)
            bench = Bench(connection, options.whole)
            prepare(bench)
            print("| work | ours | PostGIS | ratio | ours measured | PostGIS measured |\n|---|---:|---:|---:|---|---|")
            # The times are those of one backend.
            bench.run("SET max_parallel_workers_per_gather = 0")
            parts = {"operations": lambda: measure_operations(bench), "numbers": lambda: measure_numbers(bench),
                     "copy": lambda: measure_copy(bench, folder, options.rows),
                     "load": lambda: measure_load(bench, folder, options.program, options.rows, options.connections),
                     "parts": lambda: ask_for_two_parts(connection), "index": lambda: measure_index(bench),
                     "join": lambda: measure_join(bench, pathlib.Path(options.program).resolve(), folder),
                     "parallel": lambda: measure_parallel(bench)}
            for part in options.only:
                parts[part]()
            connection.close()
        finally:
            subprocess.run([*script, "stop"], check=True)


if __name__ == "__main__":
    main()
