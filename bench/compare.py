#!/usr/bin/env python3
"""This tree against another state of it: the same benchmarks built from both, run alternately in pairs.

Called by `scripts/bench --compare REF [NAME...]`. REF is built in a temporary worktree; its programs stay in
build/compare/, so that a second comparison with it begins at once. Each pair is one run of the one and one of the other,
which begins changes from pair to pair. Printed per benchmark: the medians of the times, the median of the ratios of the
pairs (below 1: this tree is faster), the middle half of these ratios, and what follows: `faster` or `slower` only if
the median differs from 1 by more than --noise and equally fast programs would give so one-sided pairs in less than one
case of twenty (sign test; it takes six pairs at least).
Exit status: 0, also where something is slower.
"""

import argparse
import json
import math
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
KEPT = ROOT / "build" / "compare"
NAMES = (*sorted(path.stem.removesuffix("_bench") for path in (ROOT / "bench").glob("*_bench.cpp")), "relational")
# Benchmarks of other programs' code, which is the same in both.
PEERS = re.compile(
    r"cgal|corefine|nef|boost|admesh|assimp|epick|sqlite|mp[zq]_class|cpp_|int256|int512|fcl|openmesh|meshoptimizer|draco", re.I
)


def git(*arguments):
    return subprocess.run(["git", *arguments], cwd=ROOT, check=True, capture_output=True, text=True).stdout.strip()


def program_of(name):
    return "algebra3d" if name == "relational" else f"{name}_bench"


def path_of(name):
    return "algebra3d" if name == "relational" else f"bench/{name}_bench"


def build(tree, names):
    """Builds the benchmarks of a tree; the folder of the build."""
    folder = tree / "build" / "bench"
    subprocess.run(["cmake", "--preset", "bench"], cwd=tree, check=True, stdout=subprocess.DEVNULL)
    targets = [program_of(name) for name in names]
    subprocess.run(["cmake", "--build", folder, "--target", *targets, "--", "--quiet"], cwd=tree, check=True)
    return folder


def programs_before(reference, names):
    """The programs of the other state: {name: path}."""
    commit = git("rev-parse", "--verify", reference + "^{commit}")
    folder = KEPT / commit[:12]
    missing = [name for name in names if not (folder / program_of(name)).exists()]
    if missing:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix="algebra3d-compare-") as place:
            tree = pathlib.Path(place) / "tree"
            git("worktree", "add", "--detach", str(tree), commit)
            try:
                print(f"building {reference} ({commit[:12]})", flush=True)
                built = build(tree, missing)
                for name in missing:
                    shutil.copy2(built / path_of(name), folder / program_of(name))
            finally:
                git("worktree", "remove", "--force", str(tree))
    return {name: folder / program_of(name) for name in names}


def programs_now(names):
    print("building this tree", flush=True)
    folder = build(ROOT, names)
    return {name: folder / path_of(name) for name in names}


def listed(program):
    return subprocess.run([program, "--benchmark_list_tests"], check=True, capture_output=True,
                          text=True).stdout.split("\n")


def own_benchmarks(before, after, wanted):
    """Benchmarks that both programs have, in the order of the second."""
    known = set(listed(before))
    return [name for name in listed(after) if name and name in known and not PEERS.search(name) and wanted.search(name)]


def run_once(program, names, clock):
    """Milliseconds per benchmark in one process, by the CPU or by the clock on the wall."""
    pattern = "^(" + "|".join(re.escape(name) for name in names) + ")$"
    # Its results as JSON, in a file: some benchmarks print.
    with tempfile.NamedTemporaryFile(suffix=".json") as output:
        subprocess.run([program, f"--benchmark_filter={pattern}", f"--benchmark_out={output.name}",
                        "--benchmark_out_format=json"], check=True, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)
        results = json.load(output)["benchmarks"]
    scale = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}
    of_wall = lambda name: clock == "real" or "/real_time" in name  # work that other threads do
    return {result["name"]: result["real_time" if of_wall(result["name"]) else "cpu_time"] * scale[result["time_unit"]]
            for result in results
            if result.get("run_type") != "aggregate" and not result.get("error_occurred")}


def google_pairs(before, after, pairs, wanted, clock):
    """{benchmark: [(before, after), ...]}"""
    names = own_benchmarks(before, after, wanted)
    times = {name: [] for name in names}
    for pair in range(pairs if names else 0):
        order = [before, after] if pair % 2 == 0 else [after, before]
        done = {program: run_once(program, names, clock) for program in order}
        for name in names:
            if name in done[before] and name in done[after]:
                times[name].append((done[before][name], done[after][name]))
    return times


def relational_pairs(before, after, pairs, wanted, tuples):
    """The same for the queries of relational_bench.py."""
    sys.dont_write_bytecode = True
    from relational_bench import Benchmark, Program, rows_of_ours  # beside this file
    from relational_cases import cases, our_data
    times = {}
    with tempfile.TemporaryDirectory(prefix="algebra3d-relational-") as folder:
        programs = [Program(name, [str(path), "--db", f"{folder}/{name}.db", "--format", "list", "-c"], rows_of_ours)
                    for name, path in (("algebra3d", before), ("sqlite3", after))]  # the names that Benchmark knows
        benchmark = Benchmark(*programs, pairs)
        for program in programs:
            program.run(";\n".join(our_data(tuples)))
        for case in cases(tuples):
            if not wanted.search(case.operator):
                continue
            twice = lambda pair: (pair[0], pair[0])
            if case.prepare:
                benchmark.both(twice(case.prepare))
            done = []
            for run in range(pairs):
                old, new = benchmark.both((case.ours, case.ours), run, case.repeat)
                done.append((old.cpu, new.cpu))
                if case.clean:
                    benchmark.both(twice(case.clean))
            if case.finish:
                benchmark.both(twice(case.finish))
            times[case.operator] = done
    return times


def sign_test(ratios):
    """How probable it is that so many pairs or more differ in one direction although both states are equally fast."""
    slower, faster = sum(ratio > 1 for ratio in ratios), sum(ratio < 1 for ratio in ratios)
    count, most = slower + faster, max(slower, faster)
    tail = sum(math.comb(count, k) for k in range(most, count + 1)) / 2 ** count
    return min(1.0, 2 * tail)


def verdict(ratios, noise):
    median = statistics.median(ratios)
    if abs(median - 1) <= noise or sign_test(ratios) > 0.05:
        return "as before" if len(ratios) >= 6 else "too few pairs to tell"
    return "faster" if median < 1 else "slower"


def summary(times, noise):
    ratios = [after / before for before, after in times]
    low, _, high = statistics.quantiles(ratios, n=4, method="inclusive") if len(ratios) > 1 else ratios * 3
    return {"before_ms": statistics.median(before for before, _ in times),
            "after_ms": statistics.median(after for _, after in times),
            "ratio": statistics.median(ratios), "quartiles": [low, high], "range": [min(ratios), max(ratios)],
            "pairs": len(ratios), "verdict": verdict(ratios, noise)}


def print_table(name, rows):
    print(f"\n== {name}\n| benchmark | before ms | after ms | ratio | middle half | verdict |\n"
          "|---|---:|---:|---:|---:|---|")
    for benchmark, row in rows.items():
        low, high = row["quartiles"]
        print(f"| {benchmark} | {row['before_ms']:.4g} | {row['after_ms']:.4g} | {row['ratio']:.3f} | "
              f"{low:.3f} to {high:.3f} | {row['verdict']} |", flush=True)


def parse_arguments():
    parser = argparse.ArgumentParser(prog="scripts/bench --compare", description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("reference", metavar="REF", help="a commit, branch or tag")
    parser.add_argument("names", metavar="NAME", nargs="*", help=f"of {', '.join(NAMES)}; without any: all")
    parser.add_argument("--pairs", type=int, default=10, help="runs of each program (10)")
    parser.add_argument("--filter", default="", metavar="REGEX", help="benchmarks whose names contain it")
    parser.add_argument("--clock", choices=("cpu", "real"), default="cpu",
                        help="CPU time of the thread that measures (cpu), or time on the wall: for work on many threads")
    parser.add_argument("--noise", type=float, default=0.02, help="largest difference that counts as noise (0.02)")
    parser.add_argument("--tuples", type=int, default=200_000, help="of the large relation of `relational` (200000)")
    parser.add_argument("--json", metavar="FILE", help="write the results there, too")
    options = parser.parse_args()
    unknown = set(options.names) - set(NAMES)
    if unknown:
        parser.error(f"unknown benchmark: {', '.join(sorted(unknown))}; there are {', '.join(NAMES)}")
    if options.pairs < 1:
        parser.error("--pairs: at least 1")
    return options


def main():
    options = parse_arguments()
    names = options.names or list(NAMES)
    wanted = re.compile(options.filter)
    before, after = programs_before(options.reference, names), programs_now(names)
    results = {}
    for name in names:
        if name == "relational":
            times = relational_pairs(before[name], after[name], options.pairs, wanted, options.tuples)
        else:
            times = google_pairs(before[name], after[name], options.pairs, wanted, options.clock)
        results[name] = {benchmark: summary(done, options.noise) for benchmark, done in times.items() if done}
        print_table(name, results[name])
    if options.json:
        report = {"before": git("rev-parse", options.reference), "after": git("describe", "--always", "--dirty"),
                  "processors": os.cpu_count(), "pairs": options.pairs, "results": results}
        pathlib.Path(options.json).write_text(json.dumps(report, indent=1) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
