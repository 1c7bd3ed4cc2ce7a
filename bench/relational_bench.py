#!/usr/bin/env python3
"""Relational operators against the sqlite3 program: the same queries on the same tuples, alternately, in one run.

Prints per operator the medians of CPU time (user and system) and of wall time, their ratios (above 1: we are faster)
and the largest memory of both processes, then what the memory limit of the language does. Each query is a process of
its own, so start and end of the programs are in the times; memory below that of this script (some 16 MB) is not told
apart, since a process starts with the mark of the one that made it. Exit status: 0, or 1 if an answer differs or sqlite3 does
not do the work that a case is about.
"""

import argparse
import os
import signal
import statistics
import sys
import tempfile
import time
from dataclasses import dataclass

from relational_cases import MEMORY_QUERIES, cases, our_data, sqlite_data


@dataclass
class Run:
    cpu: float  # milliseconds
    wall: float
    memory: float  # MB
    answer: list  # rows of strings


class Program:
    """One of the two programs with its database file."""

    def __init__(self, name, arguments, reader):
        self.name, self.arguments, self.reader = name, arguments, reader

    def run(self, commands):
        """Runs commands in a process of its own and waits for its end."""
        with tempfile.TemporaryFile() as output:
            begin = time.monotonic()
            pid = os.posix_spawnp(self.arguments[0], [*self.arguments, commands], os.environ,
                                  file_actions=[(os.POSIX_SPAWN_DUP2, output.fileno(), 1)])
            _, status, used = os.wait4(pid, 0)
            wall = time.monotonic() - begin
            if status != 0:
                raise Failure(f"{self.name} failed: {commands[:300]}")
            output.seek(0)
            answer = self.reader(output.read().decode())
        return Run((used.ru_utime + used.ru_stime) * 1000, wall * 1000, used.ru_maxrss / 1024, answer)


class Failure(Exception):
    """The two programs differ, or one does not do what it is asked."""


def rows_of_ours(text):
    """Rows of nested lists: `((rel ...) ((1 2) (3 4)))` or `(int 5)`, one per line; strings hold no spaces."""
    rows = []
    for line in text.splitlines():
        if line.startswith("((rel"):
            values = line[line.index("))))") + 4:].strip() if "))))" in line else line
            rows += [row.split() for row in values.strip("() ").split(") (") if row]
        elif line.startswith("("):
            rows.append([line.strip("()").split(None, 1)[1]])
    return [[text_of(value) for value in row] for row in rows]


def rows_of_sqlite(text):
    return [[text_of(value) for value in line.split("|")] for line in text.splitlines()]


def text_of(value):
    """One spelling for equal numbers: sqlite3 prints 15 digits, we as many as tell the doubles apart."""
    value = value.strip('"')
    try:
        return f"{float(value):.12g}"
    except ValueError:
        return value


def compare(what, ours, theirs):
    if not ours or not theirs:
        raise Failure(f"{what}: no answer to compare")
    if ours == theirs:
        return
    for index, (a, b) in enumerate(zip(ours, theirs)):
        if a != b:
            raise Failure(f"{what}: row {index + 1} is {a}, of sqlite3 {b}")
    raise Failure(f"{what}: {len(ours)} rows, of sqlite3 {len(theirs)}")


class Benchmark:
    def __init__(self, ours, sqlite, runs):
        self.ours, self.sqlite, self.runs = ours, sqlite, runs

    def make(self, tuples):
        self.ours.run(";\n".join(our_data(tuples)))
        self.sqlite.run(";\n".join(sqlite_data(tuples)) + ";")

    def both(self, pair, run=0, repeat=1):
        """Our run and sqlite3's; their order alternates."""
        programs = [(self.ours, pair[0]), (self.sqlite, pair[1])]
        done = {}
        for program, command in programs if run % 2 == 0 else reversed(programs):
            done[program.name] = program.run("; ".join([command.replace("{run}", str(run))] * repeat) + ";")
        return done["algebra3d"], done["sqlite3"]

    def prove(self, what, pair):
        ours, theirs = self.both(pair)
        compare(what, ours.answer, theirs.answer)

    def check_plan(self, case):
        plan = "\n".join("|".join(row) for row in self.sqlite.run("EXPLAIN QUERY PLAN " + case.sqlite).answer)
        if case.plan not in plan:
            raise Failure(f"{case.operator}: sqlite3 does not '{case.plan}':\n{plan}")

    def measure(self, case):
        """Medians of (CPU time, wall time, memory), ours and sqlite3's."""
        if case.prepare:
            self.both(case.prepare)
        if case.plan:
            self.check_plan(case)
        pairs = []
        for run in range(self.runs):
            ours, theirs = self.both((case.ours, case.sqlite), run, case.repeat)
            if case.ours.startswith("query"):
                compare(case.operator, ours.answer, theirs.answer)
            if case.clean:
                self.both(case.clean)
            pairs.append((ours, theirs))
        if case.proof:
            self.prove(case.operator, case.proof)
        if case.finish:
            self.both(case.finish)
        figures = ("cpu", "wall", "memory")
        return [[statistics.median(getattr(pair[side], figure) for pair in pairs) for figure in figures]
                for side in (0, 1)]

    def operators(self, tuples, wanted):
        print("| operator | ours ms | sqlite3 ms | ratio | ours wall | sqlite3 wall | ratio | ours MB | sqlite3 MB |")
        print("|---|---:|---:|---:|---:|---:|---:|---:|---:|")
        for case in cases(tuples):
            if wanted and not any(word in case.operator for word in wanted):
                continue
            (cpu, wall, memory), (their_cpu, their_wall, their_memory) = self.measure(case)
            print(f"| {case.operator} | {cpu:.0f} | {their_cpu:.0f} | {their_cpu / cpu:.2f} | {wall:.0f} | "
                  f"{their_wall:.0f} | {their_wall / wall:.2f} | {memory:.0f} | {their_memory:.0f} |", flush=True)

    def memory(self):
        print("\n| operator | default: ms, MB | limit of 16 MB: ms, MB |\n|---|---:|---:|")
        for operator, query in MEMORY_QUERIES.items():
            free, limited = self.ours.run(query), self.ours.run('set "memory" = 16; ' + query)
            compare(operator + " with a memory limit", limited.answer, free.answer)
            print(f"| {operator} | {free.cpu:.0f}, {free.memory:.0f} | {limited.cpu:.0f}, {limited.memory:.0f} |",
                  flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("program", help="the program algebra3d")
    parser.add_argument("--tuples", type=int, default=1_000_000, help="of the large relation, in thousands (1000000)")
    parser.add_argument("--runs", type=int, default=5, help="of each query in each program (5)")
    parser.add_argument("--only", nargs="*", default=[], help="operators whose name contains one of these words")
    parser.add_argument("--no-memory", action="store_true", help="without the table of the memory limit")
    options = parser.parse_args()
    if options.tuples % 10_000 != 0 or not 10_000 <= options.tuples <= 1_000_000:
        parser.error("--tuples: a multiple of 10000 up to 1000000")
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # so that the folder goes then, too
    with tempfile.TemporaryDirectory(prefix="algebra3d-relational-") as folder:
        ours = Program("algebra3d", [os.path.abspath(options.program), "--db", f"{folder}/ours.db", "--format", "list",
                                     "-c"], rows_of_ours)
        sqlite = Program("sqlite3", ["sqlite3", f"{folder}/sqlite.db"], rows_of_sqlite)
        benchmark = Benchmark(ours, sqlite, options.runs)
        try:
            benchmark.make(options.tuples)
            benchmark.operators(options.tuples, options.only)
            if not options.no_memory:
                benchmark.memory()
        except Failure as failure:
            print(f"relational_bench: {failure}", file=sys.stderr)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
