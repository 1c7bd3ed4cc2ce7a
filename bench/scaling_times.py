#!/usr/bin/env python3
"""Relations over several servers (docs/scaling.md) beside one server and beside the embedded program.

    bench/scaling_times.py PROGRAM [--servers N] [--parts N] [--rounds N]

PROGRAM lies in the build whose extension is measured. Starts scripts/cluster in a folder of its own, and copies its undivided tables
into a database of the program by `algebra3d pull`. Prints a table: for each statement the processor time of all servers of the
cluster together, of the one server with the undivided tables, and of the program, which may use one processor here; the ratio of the first to the
others; and the median time on the clock. Processor time, since other work on the machine changes it little. Answers are compared.
"""
import argparse
import os
import pathlib
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "postgres"))
from connection import Connection  # noqa: E402

BOX = "10, 30, 10, 30, 0, 30"
PAIRS = "SELECT count(*) FROM parts_local a JOIN tools_local b ON {}(a.solid, b.solid{})"
JOINED = "query Parts_local feed {a} Tools_local feed {b} "
# What is asked: of the cluster, of one server, of the program.
CASES = (
    ("count of all", "SELECT parts_count()", "SELECT count(*) FROM parts_local", "query Parts_local count"),
    ("count in a window", f"SELECT parts_count(rect3({BOX}))", f"SELECT count(*) FROM parts_local WHERE solid && rect3({BOX})",
     f"query Parts_Solid Parts_local windowintersects[rectangle3({BOX})] count"),
    ("10 nearest", "SELECT count(*) FROM parts_near('(50 50 15)', 10)",
     "SELECT count(*) FROM (SELECT FROM parts_local ORDER BY solid <-> '(50 50 15)'::point3d LIMIT 10) q",
     'query Parts_Solid Parts_local distancescan[makePoint3D(50, 50, 15), 10, "exact"] count'),
    ("count of pairs that intersect", "SELECT count FROM parts_tools_count", PAIRS.format("intersects", ""),
     JOINED + 'spatialJoin[Solid_a, Solid_b; "intersects"] count'),
    ("count of pairs within 1.5", "SELECT count(*) FROM parts_tools_within(1.5)", PAIRS.format("within_distance", ", 1.5"),
     JOINED + "distanceJoin[Solid_a, Solid_b, 1.5] count"),
    ("sum of volumes", "SELECT round(parts_volume()::numeric, 6)", "SELECT round(sum(volume(solid))::numeric, 6) FROM parts_local",
     "query round(Parts_local feed extend[V: volume(.Solid)] sum[V], 6)"),
    ("extent", "SELECT min_d(parts_extent(), 1)", "SELECT min_d(extent(solid), 1) FROM parts_local", "query minD(Parts_local feed extent[Solid], 1)"),
    ("union", "SELECT round(volume(parts_union())::numeric, 6)", "SELECT round(volume(union_agg(solid))::numeric, 6) FROM parts_local",
     "query round(volume(Parts_local feed union_aggr[Solid]), 6)"),
)


class Servers:
    """Processor time of the processes of servers, by their folders."""

    def __init__(self, folders):
        self.folders = folders

    def seconds(self):
        ticks = 0
        for folder in self.folders:
            postmaster = int((folder / "data/postmaster.pid").read_text().split()[0])
            for process in (postmaster, *map(int, pathlib.Path(f"/proc/{postmaster}/task/{postmaster}/children").read_text().split())):
                try:
                    fields = pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()
                except FileNotFoundError:
                    continue
                ticks += int(fields[11]) + int(fields[12])
            # Of children that have ended.
            fields = pathlib.Path(f"/proc/{postmaster}/stat").read_text().rsplit(")", 1)[1].split()
            ticks += int(fields[13]) + int(fields[14])
        return ticks / os.sysconf("SC_CLK_TCK")

    def measure(self, connection, sql, rounds):
        """Answer, processor seconds and median seconds of a statement, the first time left out."""
        answer = connection.query(sql)
        if answer.sql_state:
            sys.exit(f"bench/scaling_times.py: {answer.message}: {sql}")
        before, times = self.seconds(), []
        # Ticks are hundredths of seconds.
        while len(times) < rounds or (self.seconds() - before < 0.3 and len(times) < 40 * rounds):
            answer = connection.query(sql)
            times.append(answer.ended - answer.began)
        return float(answer.value), (self.seconds() - before) / len(times), statistics.median(times)


def measure_program(command, query, rounds):
    def seconds(count):
        before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
        done = subprocess.run([*command, "-c", "; ".join([query] * count)], capture_output=True, encoding="utf-8", check=False)
        if done.returncode:
            sys.exit(f"bench/scaling_times.py: {done.stderr}: {query}")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return done.stdout, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, time.monotonic() - began

    # Starting the program is left out.
    _, one, one_clock = seconds(1)
    count = max(rounds, min(40 * rounds, int(0.3 / max(one, 0.001))))
    output, many, many_clock = seconds(count + 1)
    return float(output.split()[-1].rstrip(')')), max(many - one, 0) / count, max(many_clock - one_clock, 0) / count


def amount(seconds):
    return f"{1000 * seconds:.1f} ms" if seconds < 1 else f"{seconds:.2f} s"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--servers", type=int, default=2)
    parser.add_argument("--parts", type=int, default=4000)
    parser.add_argument("--rounds", type=int, default=5)
    options = parser.parse_args()
    program = options.program.resolve()
    folder = pathlib.Path(tempfile.mkdtemp(prefix="a3dscale-", dir="/tmp"))
    cluster = [ROOT / "scripts/cluster", "--build", program.parent, "--folder", folder]
    database = [program, "--db", folder / "parts.db"]
    try:
        subprocess.run([*cluster, "start", str(options.servers), str(options.parts)], check=True)
        for table in ("parts_local", "tools_local"):
            subprocess.run([program, "pull", "--db", folder / "parts.db", "--pg", f"host={folder}/0 dbname=postgres user=postgres", "--table", table, "--quiet"], check=True)
        subprocess.run([*database, "-c", "let Parts_Solid = Parts_local creatertree[Solid]"], check=True, stdout=subprocess.DEVNULL)
        connection = Connection(folder / "0")
        connection.query("SET max_parallel_workers_per_gather = 0")
        nodes = Servers([folder / str(i) for i in range(options.servers + 1)])
        print(f"{options.parts} parts, {options.servers} servers; processor time, and the median on the clock\n")
        print("| statement | cluster | one server | program | cluster to one server | cluster to program | on the clock |\n|---|---:|---:|---:|---:|---:|---|")
        for name, divided, whole, query in CASES:
            found = [nodes.measure(connection, divided, options.rounds), nodes.measure(connection, whole, options.rounds),
                     measure_program(["taskset", "-c", "0", *database], query, options.rounds)]
            if max(answers := [each[0] for each in found]) - min(answers) > 1e-9 * abs(max(answers)):
                sys.exit(f"bench/scaling_times.py: {name}: answers differ: {answers}")
            cpu = [max(each[1], 1e-5) for each in found]
            print(f"| {name} | {' | '.join(map(amount, cpu))} | {cpu[0] / cpu[1]:.2g} | {cpu[0] / cpu[2]:.2g} | {' / '.join(amount(each[2]) for each in found)} |", flush=True)
    finally:
        subprocess.run([*cluster, "stop"], check=False)
        shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    main()
