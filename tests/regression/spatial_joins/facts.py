#!/usr/bin/env python3
"""Writes types.test and solids.test beside it; `--check` tells whether they are what it would write.

The expected values come from here and not from the program. All sets are parallel to the axes and have corners on a grid
of half units, so each is a set of open cells of that grid: points, edges, squares and cubes. A cell is three numbers, one
for each axis: an even one is a coordinate in quarters of a unit, an odd one the open interval between its neighbours.
The predicates are then operations on finite sets, taken from docs/spatial-relations.md word by word.
"""
import itertools
import pathlib
import sys

FOLDER = pathlib.Path(__file__).parent


def span(low, high):
    """The cells of a closed interval on one axis."""
    return range(round(4 * low), round(4 * high) + 1)


def box_cells(box):
    return set(itertools.product(*(span(*box[2 * i : 2 * i + 2]) for i in range(3))))


def dimension(cell):
    return sum(c % 2 for c in cell)


def around(cell, axis):
    """The cells one dimension higher that this one bounds, along an axis in which it is a coordinate."""
    return [cell[:axis] + (cell[axis] + step,) + cell[axis + 1 :] for step in (-1, 1)]


def closure(cells):
    closed = set()
    for cell in cells:
        closed |= set(itertools.product(*([c - 1, c, c + 1] if c % 2 else [c] for c in cell)))
    return closed


class Shape:
    """A closed set: its cells, those of its interior, and closed boxes that cover it, for distances."""

    def __init__(self, name, literal, cells, interior, boxes):
        self.name, self.literal, self.cells, self.interior, self.boxes = name, literal, cells, interior, boxes


def numbers(values):
    return " ".join(f"{v:g}" for v in values)


def point(name, p):
    cells = box_cells([p[0], p[0], p[1], p[1], p[2], p[2]])
    return Shape(name, f"({numbers(p)})", cells, cells, [[c for v in p for c in (v, v)]])


def points(name, *all_points):
    boxes = [[c for v in p for c in (v, v)] for p in all_points]
    cells = set().union(*(box_cells(b) for b in boxes)) if boxes else set()
    return Shape(name, "(" + " ".join(f"({numbers(p)})" for p in all_points) + ")", cells, cells, boxes)


def rect3(name, *box):
    inner = [range(r[0], r[-1] + 1) if len(r) == 1 else range(r[0] + 1, r[-1])
             for r in (span(*box[2 * i : 2 * i + 2]) for i in range(3))]
    return Shape(name, f"({numbers(box)})", box_cells(box), set(itertools.product(*inner)), [list(box)])


def rectangle_corners(box, turned=False):
    """The corners of a flat box in order around it."""
    flat = next(i for i in range(3) if box[2 * i] == box[2 * i + 1])
    u, v = [(flat + 1) % 3, (flat + 2) % 3]
    corners = []
    for at_u, at_v in ((0, 0), (1, 0), (1, 1), (0, 1)):
        p = [0, 0, 0]
        p[flat], p[u], p[v] = box[2 * flat], box[2 * u + at_u], box[2 * v + at_v]
        corners.append(p)
    return corners[::-1] if turned else corners


def triangles(corners):
    return [(corners[0], corners[1], corners[2]), (corners[0], corners[2], corners[3])]


def literal_of(all_triangles):
    return "(" + " ".join("(" + " ".join(f"({numbers(p)})" for p in t) + ")" for t in all_triangles) + ")"


def surface(name, *rectangles):
    """Rectangles that have whole edges in common. The interior is all but the edges of a single square."""
    squares = {c for box in rectangles for c in box_cells(box) if dimension(c) == 2}
    cells = closure(squares)
    border = set()
    for cell in cells:
        if dimension(cell) != 1:
            continue
        beside = [c for axis in range(3) if cell[axis] % 2 == 0 for c in around(cell, axis)]
        if sum(c in squares for c in beside) == 1:
            border |= closure({cell})
    text = literal_of([t for box in rectangles for t in triangles(rectangle_corners(box))])
    return Shape(name, text, cells, cells - border, [list(b) for b in rectangles])


def sides(box, inward=False):
    result = []
    for axis in range(3):
        for end in (0, 1):
            side = list(box)
            side[2 * axis] = side[2 * axis + 1] = box[2 * axis + end]
            result += triangles(rectangle_corners(side, turned=(end == 0) != inward))
    return result


def solid(name, box, without=None):
    """A box, or a box with a box as its cavity."""
    cubes = {c for c in box_cells(box) if dimension(c) == 3}
    boxes = [list(box)]
    if without:
        cubes -= box_cells(without)
        boxes = []
        for axis in range(3):
            for low, high in ((box[2 * axis], without[2 * axis]), (without[2 * axis + 1], box[2 * axis + 1])):
                slab = list(box)
                slab[2 * axis], slab[2 * axis + 1] = low, high
                boxes.append(slab)
    cells = closure(cubes)
    interior = {c for c in cells if all(n in cubes for n in
                itertools.product(*([v] if v % 2 else [v - 1, v + 1] for v in c)))}
    text = literal_of(sides(box) + (sides(without, inward=True) if without else []))
    return Shape(name, text, cells, interior, boxes)


def squared_distance(a, b):
    def gap(s, t, i):
        return max(0, s[2 * i] - t[2 * i + 1], t[2 * i] - s[2 * i + 1])
    return min(sum(gap(s, t, i) ** 2 for i in range(3)) for s in a.boxes for t in b.boxes)


PREDICATES = {
    "intersects": lambda a, b: bool(a.cells & b.cells),
    "touches": lambda a, b: bool(a.cells & b.cells) and not a.interior & b.interior,
    "inside": lambda a, b: a.cells <= b.cells,
    "contains": lambda a, b: a.cells >= b.cells,
    "covers": lambda a, b: a.cells >= b.cells,
    "coveredBy": lambda a, b: a.cells <= b.cells,
    "overlaps": lambda a, b: bool(a.interior & b.interior) and not a.cells <= b.cells and not a.cells >= b.cells,
}

CUBE = [0, 4, 0, 4, 0, 4]
INNER = [1, 3, 1, 3, 1, 3]

TYPES = {
    "point3d": ("Points", [
        point("centre", (2, 2, 2)), point("in a face", (4, 2, 2)), point("in an edge", (4, 4, 2)),
        point("corner", (4, 4, 4)), point("away", (9, 9, 9)), point("within", (0.5, 0.5, 0.5))]),
    "points3d": ("Sets", [
        points("inside", (2, 2, 2), (0.5, 0.5, 0.5)), points("centre", (2, 2, 2)),
        points("in and at the corner", (2, 2, 2), (4, 4, 4)), points("far away", (9, 9, 9), (8, 9, 9)),
        points("at the floor", (1, 1, 0), (2, 2, 0), (3, 3, 0)), points("in and out", (2, 2, 2), (9, 9, 9)),
        points("none")]),
    "rect3": ("Boxes", [
        rect3("cube", *CUBE), rect3("inner", *INNER), rect3("flat, in a face", 1, 3, 1, 3, 0, 0),
        rect3("segment", 2, 2, 2, 2, -1, 5), rect3("segment in an edge", 0, 4, 4, 4, 4, 4),
        rect3("beside", 4, 6, 1, 3, 1, 3), rect3("at the corner", 4, 6, 4, 6, 4, 6),
        rect3("flat, across", -1, 5, -1, 5, 2, 2)]),
    "surface3d": ("Sheets", [
        surface("in the floor", [1, 3, 1, 3, 0, 0]), surface("in the middle", [1, 3, 1, 3, 2, 2]),
        surface("across", [-1, 5, -1, 5, 2, 2]), surface("wall", [2, 2, 0, 4, 0, 4]),
        surface("corner", [0, 2, 0, 4, 2, 2], [2, 2, 0, 4, 2, 4]),
        surface("skin", *[[CUBE[j] if j // 2 != i // 2 else CUBE[i] for j in range(6)] for i in range(6)]),
        surface("away", [8, 9, 8, 9, 9, 9])]),
    "volume3d": ("Solids", [
        solid("cube", CUBE), solid("inner", INNER), solid("at the face", [4, 6, 1, 3, 1, 3]),
        solid("at the edge", [4, 6, 4, 6, 1, 3]), solid("at the corner", [4, 6, 4, 6, 4, 6]),
        solid("away", [5, 6, 0, 1, 0, 1]), solid("crossing", [2, 6, 2, 6, 2, 6]),
        solid("inside, at the face", [0, 2, 1, 3, 1, 3]), solid("beam", [-1, 5, 1, 3, 1, 3]),
        solid("hollow", CUBE, INNER), solid("core", [1.5, 2.5, 1.5, 2.5, 1.5, 2.5]), solid("twin", CUBE)]),
}


def let(type_name):
    relation, shapes = TYPES[type_name]
    rows = "\n  ".join(f'({i + 1} "{s.name}" {s.literal})' for i, s in enumerate(shapes))
    return (f"let {relation} = [const rel(tuple([No: int, Name: string, Shape: {type_name}])) value (\n  {rows}\n"
            f'  (0 "unknown" undefined))];\n')


def holding(left, right, holds):
    return [(i + 1, j + 1) for i, a in enumerate(left) for j, b in enumerate(right)
            if a.cells and b.cells and holds(a, b)]


def case(name, pairs, query):
    rows = " ".join(f"({a} {b})" for a, b in pairs)
    return f"#testcase {name}\n#yields set ((rel (tuple ((A int) (B int)))) ({rows}))\n{query}\n\n"


def result(query):
    return f"query {query} projectextend[; A: .No_a, B: .No_b] consume;"


def types_test():
    text = ["# Joins of stored relations of every two spatial types by every predicate and by distance, as a join of two\n"
            "# streams and with an index. Written by facts.py, which computes the answers.\n"
            "#setup spatial_joins_types\ncreate database spatial_joins_types;\nopen database spatial_joins_types;\n"]
    for type_name, (relation, _) in TYPES.items():
        text += [let(type_name), f"let {relation}_shape_rtree = {relation} creatertree[Shape];\n"]
    text.append("\n")
    for left_type, right_type in itertools.product(TYPES, TYPES):
        (left_name, left), (right_name, right) = TYPES[left_type], TYPES[right_type]
        both = f"{left_type}_and_{right_type}"
        streams = f"{left_name} feed {{a}} {right_name} feed {{b}}"
        for predicate, holds in PREDICATES.items():
            text.append(case(f"{both}_{predicate}", holding(left, right, holds),
                             result(f'{streams} spatialJoin[Shape_a, Shape_b; "{predicate}"]')))
        for predicate in ("intersects", "inside"):
            text.append(case(f"{both}_{predicate}_by_index", holding(left, right, PREDICATES[predicate]),
                             result(f"{left_name} feed {{a}} loopjoin[fun(t: TUPLE) {right_name}_shape_rtree {right_name} "
                                    f"windowintersects[attr(t, Shape_a)] {{b}} filter[attr(t, Shape_a) {predicate} .Shape_b]]")))
        for distance in (0, 1.5, 5):
            near = holding(left, right, lambda a, b, d=distance: squared_distance(a, b) <= d * d)
            text.append(case(f"{both}_within_{distance}", near, result(f"{streams} distanceJoin[Shape_a, Shape_b, {distance:g}]")))
    return "".join(text).rstrip("\n") + "\n"


FRAMES = {
    "as_they_are": "",
    "tiny": " scale[Origin, 4.909093465297727e-91]",
    "huge": " scale[Origin, 2.037035976334486e90]",
    "far_away": " translate[makeVector3D(1099511627776, -549755813888, 274877906944)]",
    "turned": " rotate[Origin, makeVector3D(0, 0, 1), 90]",
    "mirrored": " scaleDir[Origin, makeVector3D(-1, 1, 1)]",
}


def solids_test():
    _, solids = TYPES["volume3d"]
    text = ["# Joins of a stored relation of solids with itself by every predicate: as they are, tiny, huge, far away, turned and\n"
            "# mirrored, all exactly. The scales are powers of two. Written by facts.py, which computes the answers.\n"
            "#setup spatial_joins_solids\ncreate database spatial_joins_solids;\nopen database spatial_joins_solids;\n",
            let("volume3d"), "let Origin = makePoint3D(0, 0, 0);\n"]
    for frame, change in FRAMES.items():
        text.append(f"let In_{frame} = Solids feed projectextend[No; Shape: .Shape{change}] consume;\n")
    text.append("\n")
    for frame in FRAMES:
        streams = f"In_{frame} feed {{a}} In_{frame} feed {{b}}"
        for predicate, holds in PREDICATES.items():
            text.append(case(f"solids_{frame}_{predicate}", holding(solids, solids, holds),
                             result(f'{streams} spatialJoin[Shape_a, Shape_b; "{predicate}"]')))
    return "".join(text).rstrip("\n") + "\n"


def main():
    files = {"types.test": types_test(), "solids.test": solids_test()}
    if sys.argv[1:] == ["--check"]:
        wrong = [name for name, text in files.items() if (FOLDER / name).read_text() != text]
        sys.exit(f"not what facts.py writes: {', '.join(wrong)}" if wrong else 0)
    for name, text in files.items():
        (FOLDER / name).write_text(text)


main()
