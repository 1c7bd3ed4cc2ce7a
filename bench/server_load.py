#!/usr/bin/env python3
"""Load of `algebra3d serve` on loopback: clients with mixed reads, and one writer.

    bench/server_load.py [PROGRAM] [--seconds N] [--clients N] [--processes N] [--left SHARE]

PROGRAM is by default the environment variable ALGEBRA3D_PROGRAM. Every answer is checked. Prints requests per second,
the latencies by kind, and what the server holds at the start, after the warm-up and at the end. Exit status: 1 if a
request failed, a change of the writer was lost, or memory, descriptors, threads or the log of the database have grown
since the warm-up.
"""
import argparse
import multiprocessing
import os
import random
import sys
import threading
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tests", "server"))
import served  # noqa: E402 (after the path is set)

ROWS = 20000
SOLIDS = 200
OPERATORS = ("volume", "union", "filter", "importSTL", "spatialJoin", "consume")
# What may be larger at the end than after the warm-up without being growth: allocators and logs breathe.
LARGEST_GROWTH = {"memory": 48.0, "descriptors": 24, "threads": 24, "log": 32.0}


def prepare(server):
    server.query(f'let Numbers = intstream(1, {ROWS}) transformstream extend[Name: "row"] consume')
    server.query(f"let Solids = intstream(1, {SOLIDS}) transformstream extend[Solid: "
                 "createCube(makePoint3D(.Elem, 0, 0), makePoint3D(.Elem + 1, 2, 3))] consume")
    server.query("let Log = intstream(1, 1) transformstream consume")


class Failure(Exception):
    pass


def expect(is_right, answer):
    if not is_right:
        raise Failure(repr(answer))


class Client:
    """Sends requests of all kinds, as a viewer and programs would. It leaves the share `left` of its results behind, as
    by a closed window; the server must drop them by itself."""

    def __init__(self, server, acknowledged, name, left):
        self.server = server
        self.acknowledged = acknowledged
        self.choice = random.Random(name)
        self.left = left
        self.headers = {"X-Algebra3d-Client": name}

    def _result(self, statement, **members):
        answer = self.server.post(statement, self.headers, **members)
        expect(answer.status == 200 and "result" in answer.json, answer)
        return answer.json["result"]

    def _leave(self, result):
        if self.choice.random() >= self.left:
            answer = self.server.ask("DELETE", f"/api/results/{result['id']}")
            expect(answer.status == 204, answer)

    def value(self):
        a, b = self.choice.randrange(1000), self.choice.randrange(1000)
        answer = self.server.post(f"query {a} + {b}")
        expect(answer.status == 200 and answer.json["value"] == a + b, answer)

    def events(self):
        answer = self.server.post(f"query intstream(1, {ROWS}) count", {"Accept": "text/event-stream"})
        expect(answer.status == 200 and b"event: result" in answer.body and str(ROWS).encode() in answer.body, answer)

    def table(self):
        result = self._result("query Numbers", rows=20)
        expect(result["count"] == ROWS, result)
        for _ in range(3):
            first = self.choice.randrange(ROWS - 100)
            answer = self.server.get(f"/api/results/{result['id']}/rows?from={first}&count=100")
            expect(answer.status == 200 and [row["Elem"] for row in answer.json["rows"]] ==
                   list(range(first + 1, first + 101)), answer)
        self._leave(result)

    def shapes(self):
        result = self._result("query Solids", rows=0)
        first = self.choice.randrange(SOLIDS - 20)
        answer = self.server.get(f"/api/results/{result['id']}/shapes?column=Solid&from={first}&count=20")
        expect(answer.status == 200 and answer.body[:4] == b"glTF", answer)
        self._leave(result)

    def file(self):
        result = self._result("query Solids feed filter[.Elem > 100] consume", rows=1)
        name = self.choice.choice(("stl", "stl-ascii", "obj", "off"))
        answer = self.server.get(f"/api/results/{result['id']}/file?row=7&column=Solid&format={name}")
        expect(answer.status == 200 and len(answer.body) > 100, answer)
        self._leave(result)

    def operators(self):
        answer = self.server.get(f"/api/operators/{self.choice.choice(OPERATORS)}")
        expect(answer.status == 200 and answer.json["examples"], answer)

    def objects(self):
        answer = self.server.get("/api/objects")
        expect(answer.status == 200 and len(answer.json) == 3, answer)

    def log(self):
        written = self.acknowledged.value
        answer = self.server.post("query Log count")
        expect(answer.status == 200 and answer.json["value"] >= written, answer)

    KINDS = (value, value, table, table, shapes, file, operators, objects, events, log)

    def work_until(self, deadline, note):
        while time.monotonic() < deadline:
            kind = self.choice.choice(self.KINDS)
            start = time.monotonic()
            try:
                kind(self)
                note(kind.__name__, time.monotonic() - start, None)
            except (OSError, Failure, ValueError) as error:
                note(kind.__name__, time.monotonic() - start, f"{type(error).__name__}: {error}"[:300])


def run_clients(server, acknowledged, deadline, count, seed, left, reports):
    """One process of clients; puts its measurements into `reports` at the end."""
    measured, lock = [], threading.Lock()

    def note(*measurement):
        with lock:
            measured.append(measurement)
    clients = [Client(server, acknowledged, f"load-{seed}-{i}", left) for i in range(count)]
    threads = [threading.Thread(target=client.work_until, args=(deadline, note)) for client in clients]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    reports.put(measured)


def run_writer(server, acknowledged, deadline, reports):
    measured = []
    while time.monotonic() < deadline:
        start, error = time.monotonic(), None
        try:
            answer = server.post(f"query Log inserttuple[{acknowledged.value + 2}] count")
            expect(answer.status == 200, answer)
            acknowledged.value += 1
        except (OSError, Failure) as failure:
            error = f"{type(failure).__name__}: {failure}"[:300]
        measured.append(("write", time.monotonic() - start, error))
        time.sleep(0.05)
    reports.put(measured)


def held(server):
    figures = server.figures()
    log = server.path(server.database + "-wal")
    figures["log"] = os.path.getsize(log) / 2**20 if os.path.exists(log) else 0.0
    figures["processor"] = served.processor_seconds(server)
    return figures


def show_figures(when, figures):
    print(f"{when:>16}: {figures['memory']:7.1f} MB memory, {figures['descriptors']:3} descriptors, "
          f"{figures['threads']:3} threads, {figures['log']:6.1f} MB write-ahead log, "
          f"{figures['processor']:6.1f} s of processor", flush=True)


def show_latencies(measured, seconds):
    by_kind = {}
    for kind, duration, error in measured:
        if error is None:
            by_kind.setdefault(kind, []).append(duration)
    print(f"{len(measured)} exchanges in {seconds} s, {len(measured) / seconds:.1f} a second")
    print("      kind  number    median      99 %   longest")
    for kind, durations in sorted(by_kind.items()):
        durations.sort()
        shown = (durations[len(durations) // 2], durations[int(len(durations) * 0.99)], durations[-1])
        print(f"{kind:>10}{len(durations):8}" + "".join(f"{1000 * each:7.1f} ms" for each in shown))


def start_load(server, options, acknowledged, reports):
    deadline = time.monotonic() + options.seconds
    each, rest = divmod(options.clients, options.processes)
    processes = [multiprocessing.Process(target=run_writer, args=(server, acknowledged, deadline, reports))]
    for i in range(options.processes):
        count = each + (1 if i < rest else 0)
        processes.append(multiprocessing.Process(target=run_clients,
                                                 args=(server, acknowledged, deadline, count, i, options.left, reports)))
    for process in processes:
        process.start()
    return processes, deadline


def run(server, options):
    """The failures of a run, in words."""
    prepare(server)
    acknowledged, reports = multiprocessing.Value("q", 0), multiprocessing.Queue()
    show_figures("start", held(server))
    processes, deadline = start_load(server, options, acknowledged, reports)
    time.sleep(options.seconds / 5)
    warm = held(server)
    show_figures("after warm-up", warm)
    while time.monotonic() < deadline - options.seconds / 5:
        time.sleep(options.seconds / 5)
        show_figures(f"{options.seconds - deadline + time.monotonic():.0f} s", held(server))
    measured = [each for _ in processes for each in reports.get()]
    for process in processes:
        process.join()
    end = held(server)
    show_figures("end", end)
    show_latencies(measured, options.seconds)
    failures = [f"{kind}: {error}" for kind, _, error in measured if error]
    if server.query("query Log count")["value"] != acknowledged.value + 1:
        failures.append(f"changes were lost: {acknowledged.value} were acknowledged")
    failures += [f"{name} grew from {warm[name]:.1f} to {end[name]:.1f}" for name, most in LARGEST_GROWTH.items()
                 if end[name] - warm[name] > most]
    return failures


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", nargs="?")
    parser.add_argument("--seconds", type=int, default=300)
    parser.add_argument("--clients", type=int, default=50)
    parser.add_argument("--processes", type=int, default=5)
    parser.add_argument("--left", type=float, default=0.05, help="share of results that clients leave behind")
    options = parser.parse_args()
    if options.program:
        served.PROGRAM = os.path.abspath(options.program)
    with served.Served() as server:
        failures = run(server, options)
        status, seconds = server.end()
        print(f"ended with exit status {status} after {seconds:.1f} s")
    for failure in failures[:20]:
        print("FAILED:", failure)
    print(f"{len(failures)} failures")
    return 1 if failures or status != 0 else 0


if __name__ == "__main__":
    sys.exit(main())
