#!/usr/bin/env python3
"""How relations over several servers (docs/scaling.md) grow: a simulation from constants that were measured.

    bench/scaling_growth.py      prints the table of the page

Solids are cubes whose edges are so many times the mean distance of neighbours, in random places; tiles are cubes of equal
numbers. What is simulated: how many tiles a solid's box meets, and so the rows of a tile. What is multiplied: bytes of queries and
the time of the coordinator, by the constants.
"""
import random

# Measured on 2026-11-30, each statement for the second time in its session. Bytes: by scripts/cluster with two servers (four foreign
# servers), of a count over 8 and over 64 tiles, and what a join had more. Time: processor time of the coordinator's process alone, of
# a count over 512 tiles (94 ms) and over 2,048 (858 ms) on three servers; waiting for many asynchronous scans grows with the square
# of their number. Tables with more tiles than that are extrapolated by the same parabola.
BYTES_OF_A_TILE = 370
BYTES_OF_A_SERVER = 560
MORE_BYTES_OF_A_JOIN = 200
TILE_MS = 0.105
SQUARED_TILE_MS = 1.53e-4
MOST_TILES_MEASURED = 2048
TILES_OF_A_SERVER = 4
SAMPLE = 20000


def copies(edge, tile, dice):
    """The mean number of tiles that a cube meets; lengths in mean distances of neighbours."""
    def along_an_axis():
        low = dice.random() * tile
        return int((low + edge) // tile) + 1
    return sum(along_an_axis() * along_an_axis() * along_an_axis() for _ in range(SAMPLE)) / SAMPLE


def amount(number):
    for unit, size in (("G", 1e9), ("M", 1e6), ("k", 1e3)):
        if number >= size:
            return f"{number / size:.3g} {unit}"
    return f"{number:.0f}"


def main():
    dice = random.Random(1)
    print("| solids | servers | tiles | rows of a tile | copies of a solid, edge 0.5 / 2 / 10 | bytes of a join's count | the coordinator plans and asks for |")
    print("|---:|---:|---:|---:|---|---:|---:|")
    for solids in (10**6, 10**7, 10**8, 10**9, 10**10):
        for servers in (1, 10, 100, 1000):
            if not 10**5 <= solids / servers <= 10**9:
                continue
            tiles = servers * TILES_OF_A_SERVER
            edge_of_tile = (solids / tiles) ** (1 / 3)
            found = [copies(edge, edge_of_tile, dice) for edge in (0.5, 2, 10)]
            total_bytes = tiles * (BYTES_OF_A_TILE + MORE_BYTES_OF_A_JOIN) + servers * BYTES_OF_A_SERVER
            seconds = (tiles * TILE_MS + tiles**2 * SQUARED_TILE_MS) / 1e3
            is_measured = tiles <= MOST_TILES_MEASURED
            print(f"| {amount(solids)} | {servers} | {tiles} | {amount(solids / tiles * found[0])} | {' / '.join(f'{each:.3f}' for each in found)} | "
                  f"{amount(total_bytes)}B | {seconds:.2g} s{'' if is_measured else ' (extrapolated)'} |")


if __name__ == "__main__":
    main()
