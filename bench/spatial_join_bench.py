#!/usr/bin/env python3
"""Exact spatial joins of many small solids (nuclei) with few large branching ones (vessels), and of small solids with
each other, through the program.

Usage: bench/spatial_join_bench.py PROGRAM [--nuclei N] [--vessels N] [--folder DIR]

Prints for each join its time, the pairs of boxes and of solids per second, and the exact tests for each pair, from
`explain query`. The data lie in a cube whose size keeps their density, whatever their number: 200,000 nuclei of 288
triangles and 1,000 vessels of some 30,000 triangles by default.
"""

import argparse
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import time

NUCLEUS_CORNERS = 18  # of its circles: 288 triangles
VESSEL_CELLS = 3700  # some 30,000 triangles
STEP = 4  # cells from one branching to the next


def branching_cells(dice):
    """The cells of a tree in a grid, whose branches keep apart: they follow the edges of a grid STEP times as coarse."""
    start = (0, 0, 0)
    nodes, open_nodes, cells = {start}, [start], {start}
    while len(cells) < VESSEL_CELLS:
        index = dice.randrange(max(0, len(open_nodes) - 6), len(open_nodes))
        node = open_nodes[index]
        axis, sign = dice.choice([0, 0, 0, 1, 2]), dice.choice([1, 1, -1])
        ahead = tuple(c + sign if i == axis else c for i, c in enumerate(node))
        if ahead in nodes:
            if dice.random() < 0.3 and len(open_nodes) > 1:
                open_nodes.pop(index)
            continue
        nodes.add(ahead)
        open_nodes.append(ahead)
        for k in range(STEP + 1):
            cells.add(tuple(STEP * c + (sign * k if i == axis else 0) for i, c in enumerate(node)))
    return cells


def surface_of(cells, dice, origin, size):
    """Points and triangles of the surface of cells; the points are moved a little, so that no faces are coplanar."""
    numbers, points, triangles = {}, [], []

    def number(corner):
        if corner not in numbers:
            numbers[corner] = len(points)
            points.append([origin[i] + size * (corner[i] + dice.uniform(-0.12, 0.12)) for i in range(3)])
        return numbers[corner]

    for cell in cells:
        for axis in range(3):
            for sign in (0, 1):
                beside = tuple(c + (2 * sign - 1 if i == axis else 0) for i, c in enumerate(cell))
                if beside in cells:
                    continue
                u, v = [(1, 2), (2, 0), (0, 1)][axis]
                ring = [(0, 0), (1, 0), (1, 1), (0, 1)]
                if sign == 0:
                    ring.reverse()
                corners = []
                for a, b in ring:
                    corner = list(cell)
                    corner[axis] += sign
                    corner[u] += a
                    corner[v] += b
                    corners.append(number(tuple(corner)))
                triangles.append(corners[:3])
                triangles.append([corners[0], corners[2], corners[3]])
    return points, triangles


def write_off(file, points, triangles):
    lines = ["OFF", f"{len(points)} {len(triangles)} 0"]
    lines += [f"{x:.9g} {y:.9g} {z:.9g}" for x, y, z in points]
    lines += [f"3 {a} {b} {c}" for a, b, c in triangles]
    file.write_text("\n".join(lines) + "\n")


class Data:
    def __init__(self, program, folder, nuclei, vessels):
        self.program, self.database = program, folder / "joins.db"
        self.folder, self.nuclei, self.vessels = folder, nuclei, vessels
        self.size = 2.5 * nuclei ** (1 / 3)

    def run(self, commands):
        done = subprocess.run([self.program, "--db", self.database, "--format", "list", "-c", commands],
                              capture_output=True, text=True, cwd=self.folder, check=False)
        if done.returncode != 0:
            sys.exit(f"failed: {commands}\n{done.stdout}{done.stderr}")
        return done.stdout

    def make(self):
        if self.database.exists():
            return
        dice = random.Random(18)
        with (self.folder / "nuclei.csv").open("w") as file:
            file.write("No,X,Y,Z,R\n")
            for number in range(self.nuclei):
                place = ",".join(f"{dice.uniform(0, self.size):.6f}" for _ in range(3))
                file.write(f"{number + 1},{place},{dice.uniform(0.5, 1):.4f}\n")
        vessels = self.folder / "vessels"
        vessels.mkdir(exist_ok=True)
        for number in range(self.vessels):
            origin = [dice.uniform(0, self.size) for _ in range(3)]
            write_off(vessels / f"v{number:05d}.off", *surface_of(branching_cells(dice), dice, origin, 0.3))
        self.run("let Nuclei = importCSV('nuclei.csv') projectextend[No; S: createSphere(makePoint3D(.X, .Y, .Z), .R, "
                 f"{NUCLEUS_CORNERS})] consume")
        subprocess.run([self.program, "import", "--db", self.database, "--relation", "Imported", "--quiet", vessels],
                       check=False)
        self.run("let Vessels = Imported feed projectextend[; V: .Solid] addcounter[Id, 1] consume")

    def explain(self, name, query):
        begin = time.monotonic()
        plan = self.run(f"explain query {query}")
        seconds = time.monotonic() - begin
        operator = re.search(r"(\w*Join)\[", query)[1]
        row = re.search(rf"\(\d+ {operator} .*?' \d+ (\d+) [\d.]+ -?\d+ '([^']*)'", plan)
        tuples, stages = (int(row[1]), row[2]) if row else (0, plan)
        counts = {what: int(count) for count, what in re.findall(r"(\d+) ([a-z ]+)", stages)}
        pairs = counts.get("pairs of boxes", counts.get("candidates by boxes", 0))
        print(f"{name:34} {seconds:8.2f} s  {tuples:9} results  {pairs:9} pairs of boxes  {pairs / seconds:10.0f} pairs/s  "
              f"{counts.get('exact tests', 0) / max(1, pairs):8.1f} exact tests each\n    {stages}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--nuclei", type=int, default=200_000)
    parser.add_argument("--vessels", type=int, default=1_000)
    parser.add_argument("--folder", type=pathlib.Path, help="keeps the data for the next run")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = given.folder or pathlib.Path(temporary)
        folder.mkdir(exist_ok=True)
        data = Data(given.program.resolve(), folder.resolve(), given.nuclei, given.vessels)
        data.make()
        print(data.run("query Nuclei count; query Vessels count; query Vessels feed filter[isdefined(.V)] extend[N: size(.V)] avg[N]"))
        data.explain("nuclei that meet vessels", 'Nuclei feed Vessels feed spatialJoin[S, V; "intersects"] count')
        data.explain("nuclei near vessels", "Nuclei feed Vessels feed distanceJoin[S, V, 0.5] count")
        data.explain("10 nearest nuclei of vessels", "Vessels feed Nuclei feed knnJoin[V, S, 10] count")
        data.explain("10 nearest vessels of 1000 nuclei", "Nuclei feed head[1000] Vessels feed knnJoin[S, V, 10] count")
        data.explain("nuclei that meet each other", 'Nuclei feed spatialSelfJoin[S; "intersects"] count')


if __name__ == "__main__":
    main()
