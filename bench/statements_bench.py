#!/usr/bin/env python3
"""What a statement costs that has nothing to do: starts of the program, statements through a pipe, and over HTTP on
connections that stay open. Beside the first two the sqlite3 program, in the same run.

    bench/statements_bench.py PROGRAM [--starts N] [--statements N]

Times are of the processor, of all threads; those of HTTP are the server's, without its clients.
"""
import argparse
import http.client
import json
import os
import re
import resource
import subprocess
import tempfile
import threading
import time


def processor_time(command, content=None):
    """Seconds of the processor and of the clock that a process takes."""
    before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    subprocess.run(command, input=content, stdout=subprocess.DEVNULL, check=True)
    clock, after = time.monotonic() - begin, resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, clock


def show(name, ours, peer):
    print(f"{name:34} {ours:9.1f} {peer:9.1f} {ours / peer:7.2f}")


def measure_starts(program, folder, count):
    ours = theirs = 0.0
    for _ in range(count):
        ours += processor_time([program, "--db", f"{folder}/a.db", "-c", "query 1"])[0]
        theirs += processor_time(["sqlite3", f"{folder}/s.db", "select 1"])[0]
    show("a start", ours / count * 1e6, theirs / count * 1e6)


def measure_pipe(name, program, folder, count, ours, theirs):
    """The share of one statement, without the start of the program."""
    results = []
    for command, statement in (([program, "--db", f"{folder}/a.db"], ours), (["sqlite3", f"{folder}/s.db"], theirs)):
        start = processor_time(command, f"{statement};\n".encode())
        whole = processor_time(command, f"{statement};\n".encode() * (count + 1))
        results.append([(all_of_them - alone) / count * 1e6 for all_of_them, alone in zip(whole, start)])
    show(name, results[0][0], results[1][0])
    show("  by the clock", results[0][1], results[1][1])


class Server:
    def __init__(self, program, folder):
        self.process = subprocess.Popen([program, "serve", "--db", "a.db", "--port", "0"], stdout=subprocess.PIPE,
                                        cwd=folder)
        said = b""
        while b"Ctrl-C" not in said:
            said += os.read(self.process.stdout.fileno(), 4096)
        self.port = int(re.search(rb"http://[^/]*:(\d+)/", said).group(1))

    def seconds(self):
        with open(f"/proc/{self.process.pid}/stat") as file:
            return sum(map(int, file.read().rpartition(")")[2].split()[11:13])) / os.sysconf("SC_CLK_TCK")

    def ask(self, count, keeps):
        connection = http.client.HTTPConnection("127.0.0.1", self.port)
        headers = {} if keeps else {"Connection": "close"}
        for i in range(count):
            connection.request("POST", "/api/query", json.dumps({"statement": f"query {i}"}), headers)
            if json.load(connection.getresponse())["value"] != i:
                raise SystemExit("the answer is wrong")
        connection.close()

    def ask_by(self, clients, count, keeps):
        """Microseconds of the server's processor for a statement, and statements a second."""
        before, begin = self.seconds(), time.monotonic()
        threads = [threading.Thread(target=self.ask, args=(count // clients, keeps)) for _ in range(clients)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        return (self.seconds() - before) / count * 1e6, count / (time.monotonic() - begin)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--starts", type=int, default=200)
    parser.add_argument("--statements", type=int, default=20000)
    options = parser.parse_args()
    program = os.path.abspath(options.program)
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "--db", f"{folder}/a.db", "-c", "let A = 1"], check=True, stdout=subprocess.DEVNULL)
        subprocess.run(["sqlite3", f"{folder}/s.db", "pragma journal_mode = wal; create table a(x); insert into a values (1)"], check=True,
                       stdout=subprocess.DEVNULL)
        print(f"{'microseconds':34} {'ours':>9} {'sqlite3':>9} {'ratio':>7}")
        measure_starts(program, folder, options.starts)
        measure_pipe("a number through a pipe", program, folder, options.statements, "query 1", "select 1")
        measure_pipe("a stored value through a pipe", program, folder, options.statements, "query A", "select x from a")
        server = Server(program, folder)
        try:
            for clients, keeps in ((1, False), (1, True), (8, True)):
                ours, rate = server.ask_by(clients, options.statements // (1 if keeps else 4), keeps)
                name = f"a statement over HTTP, {clients} client{'s'[:clients - 1]}{'' if keeps else ', closing'}"
                print(f"{name:38} {ours:5.1f}; {1e6 / ours:.0f} in a second of the processor, {rate:.0f} by the clock "
                      "with the clients")
        finally:
            server.process.terminate()
            server.process.wait()


if __name__ == "__main__":
    main()
