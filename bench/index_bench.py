#!/usr/bin/env python3
"""Stored indexes against sqlite3's own index and R-tree: what a fresh process needs for one answer or one change.

Each question is a process of its own, of either program in turn, over a relation of `--tuples` tuples with a number, a text and a box.
Prints medians of wall time and CPU time, the largest memory, and the pages that a change appends to the log. The base
line is a process that opens the database and asks nothing of it. Exit status: 0, or 1 if an answer differs.
"""

import argparse
import os
import statistics
import sys
import tempfile

from relational_bench import Failure, Program, rows_of_ours, rows_of_sqlite

FRAME_BYTES = 4096 + 24
SIDE = 1000.0

# A box of side 1 at a place that the number of the tuple gives, by the same formulas in both programs. The remainders are those of
# prime numbers, so that the boxes lie all over.
OURS = """
let R = intstream(1, {n}) transformstream extend[No: (.Elem * 7919) mod 1000003, Name: num2string((.Elem * 104729) mod 1000003),
  X: ((.Elem * 611953) mod 1000003) / 1000.0, Y: ((.Elem * 746773) mod 1000003) / 1000.0,
  Z: ((.Elem * 882377) mod 1000003) / 1000.0]
  projectextend[No, Name; B: rectangle3(.X, .X + 1.0, .Y, .Y + 1.0, .Z, .Z + 1.0)] consume;
let Plain = R feed head[1000] consume
"""
SQLITE = """
PRAGMA journal_mode = WAL;
CREATE TABLE r(id INTEGER PRIMARY KEY, No INTEGER, Name TEXT);
CREATE VIRTUAL TABLE b USING rtree(id, minx, maxx, miny, maxy, minz, maxz);
WITH RECURSIVE i(e) AS (SELECT 1 UNION ALL SELECT e + 1 FROM i WHERE e < {n})
  INSERT INTO r SELECT e, (e * 7919) % 1000003, CAST((e * 104729) % 1000003 AS TEXT) FROM i;
"""
SQLITE_BOXES = """
WITH p AS (SELECT id AS e, ((id * 611953) % 1000003) / 1000.0 AS x, ((id * 746773) % 1000003) / 1000.0 AS y,
  ((id * 882377) % 1000003) / 1000.0 AS z FROM r)
  INSERT INTO b SELECT e, x, x + 1, y, y + 1, z, z + 1 FROM p
"""
WINDOW = (400.0, 420.0, 500.0, 520.0, 100.0, 130.0)


def builds():
    """(name, ours, sqlite): each is run once."""
    yield "build: index of numbers", "let R_No = R createbtree[No]", "CREATE INDEX r_no ON r(No)"
    yield "build: index of texts", "let R_Name = R createbtree[Name]", "CREATE INDEX r_name ON r(Name)"
    yield "build: R-tree", "let R_B = R creatertree[B]", SQLITE_BOXES


def questions(count):
    window = ", ".join(str(each) for each in WINDOW)
    minx, maxx, miny, maxy, minz, maxz = WINDOW
    number = (count // 2 * 7919) % 1000003
    text = (count // 3 * 104729) % 1000003
    yield "nothing", "query 1", "SELECT 1"
    yield ("lookup of a number", f"query R_No R exactmatch[{number}] count", f"SELECT count(*) FROM r WHERE No = {number}")
    yield ("lookup of a text", f'query R_Name R exactmatch["{text}"] count',
           f"SELECT count(*) FROM r WHERE Name = '{text}'")
    yield ("1000 numbers", f"query R_No R range[5000, 5999] count",
           "SELECT count(*) FROM r WHERE No BETWEEN 5000 AND 5999")
    yield ("window, tuples", f"query R_B R windowintersects[rectangle3({window})] count",
           f"SELECT count(*) FROM b JOIN r USING(id) WHERE maxx >= {minx} AND minx <= {maxx} AND maxy >= {miny} AND "
           f"miny <= {maxy} AND maxz >= {minz} AND minz <= {maxz}")
    yield ("window, first tuple", f"query R_B R windowintersects[rectangle3({window})] head[1] count",
           f"SELECT count(*) FROM (SELECT r.id FROM b JOIN r USING(id) WHERE maxx >= {minx} AND minx <= {maxx} AND "
           f"maxy >= {miny} AND miny <= {maxy} AND maxz >= {minz} AND minz <= {maxz} LIMIT 1)")


def changes(count):
    """(name, ours, sqlite): {i} is the number of the run."""
    ours = "query {relation} updatebyid[{tuple}; {attribute}: {value}] count"
    box = "rectangle3({i} + 0.5, {i} + 1.5, {i} + 0.5, {i} + 1.5, {i} + 0.5, {i} + 1.5)"
    tuple_id = "{i} * " + str(max(1, count // 50)) + " + 7"
    yield ("change of a box, no index", ours.format(relation="Plain", tuple="{i} + 7", attribute="B", value=box), "SELECT 1")
    yield ("change of a box", ours.format(relation="R", tuple=tuple_id, attribute="B", value=box),
           "UPDATE b SET minx = {i} + 0.5, maxx = {i} + 1.5, miny = {i} + 0.5, maxy = {i} + 1.5, minz = {i} + 0.5, "
           "maxz = {i} + 1.5 WHERE id = " + tuple_id)
    yield ("change of a number, no index", ours.format(relation="Plain", tuple="{i} + 7", attribute="No", value="{i} + 9"),
           "SELECT 1")
    yield ("change of a number", ours.format(relation="R", tuple=tuple_id, attribute="No", value="{i} + 9"),
           "UPDATE r SET No = {i} + 9 WHERE id = " + tuple_id)


def log_pages(file):
    try:
        return max(0, os.path.getsize(file + "-wal") - 32) // FRAME_BYTES
    except FileNotFoundError:
        return 0


class Keeper:
    """Another connection to a database, so that the end of a process does not move its log into the file."""

    def __init__(self, file):
        import sqlite3
        self.connection = sqlite3.connect(file)
        self.connection.execute("PRAGMA wal_autocheckpoint = 0")
        self.connection.execute("SELECT count(*) FROM sqlite_schema").fetchall()

    def empty_log(self):
        self.connection.execute("PRAGMA wal_checkpoint(TRUNCATE)").fetchall()

    def close(self):
        self.connection.close()


def show(name, ours, theirs, pages=None):
    wall = [statistics.median(run.wall for run in runs) for runs in (ours, theirs)]
    cpu = [statistics.median(run.cpu for run in runs) for runs in (ours, theirs)]
    memory = [max(run.memory for run in runs) for runs in (ours, theirs)]
    text = "" if pages is None else f"  {statistics.median(pages[0]):5.0f} {statistics.median(pages[1]):5.0f}"
    print(f"{name:30} {wall[0]:9.1f} {wall[1]:9.1f}   {cpu[0]:9.1f} {cpu[1]:9.1f}   {memory[0]:6.0f} {memory[1]:6.0f}{text}",
          flush=True)


def compare(ours, theirs, folder, count, repetitions):
    files = [os.path.join(folder, name) for name in ("ours.db", "theirs.db")]
    ours.run(OURS.format(n=count))
    theirs.run(SQLITE.format(n=count))
    print(f"{count} tuples; milliseconds on the clock, of CPU; MB; pages in the log: ours, sqlite3")
    for name, our_query, their_query in builds():
        show(name, [ours.run(our_query)], [theirs.run(their_query)])
    for name, our_query, their_query in questions(count):
        runs = [(ours.run(our_query), theirs.run(their_query)) for _ in range(repetitions)]
        for own, other in runs:
            if own.answer != other.answer:
                raise Failure(f"{name}: {own.answer}, sqlite3 {other.answer}")
        show(name, *zip(*runs))
    keepers = [Keeper(file) for file in files]
    for name, our_query, their_query in changes(count):
        runs, pages = [], []
        for i in range(repetitions):
            for keeper in keepers:
                keeper.empty_log()
            runs.append((ours.run(our_query.format(i=i)), theirs.run(their_query.format(i=i))))
            pages.append([log_pages(file) for file in files])
        show(name, *zip(*runs), list(zip(*pages)))
    for keeper in keepers:
        keeper.close()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", help="the algebra3d program")
    parser.add_argument("--tuples", type=int, default=1_000_000)
    parser.add_argument("--repetitions", type=int, default=9)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="algebra3d_index_bench_") as folder:
        ours = Program("algebra3d", [os.path.abspath(options.program), "--format", "list", "--db",
                                     os.path.join(folder, "ours.db"), "-c"], rows_of_ours)
        theirs = Program("sqlite3", ["sqlite3", "-batch", os.path.join(folder, "theirs.db")], rows_of_sqlite)
        try:
            compare(ours, theirs, folder, options.tuples, options.repetitions)
        except Failure as failure:
            sys.exit(str(failure))


if __name__ == "__main__":
    main()
