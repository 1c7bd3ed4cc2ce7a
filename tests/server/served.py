"""A running `algebra3d serve` and its clients, for the tests of the server.

    with Served() as server:
        server.query("query 1")["value"]

The program is the environment variable ALGEBRA3D_PROGRAM, or the first argument of the test.
"""
import gzip
import http.client
import json
import os
import re
import select
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = os.path.abspath(shutil.which(os.environ.get("ALGEBRA3D_PROGRAM", "algebra3d")) or "algebra3d")
CUBE = "createCube(makePoint3D(0, 0, 0), makePoint3D(1, 1, 1))"
# Runs for minutes, in little memory, and can be ended at any time.
LONG = "query intstream(1, 2000000000) count"


class Answer:
    """An answer: `status`, `headers` (names in lower case), `body`."""

    def __init__(self, status, headers, body):
        self.status = status
        self.headers = {name.lower(): value for name, value in headers}
        self.body = body

    @property
    def json(self):
        packed = self.headers.get("content-encoding") == "gzip"
        return json.loads((gzip.decompress(self.body) if packed else self.body).decode("utf-8"))

    @property
    def error(self):
        return self.json["error"]

    def __repr__(self):
        return f"{self.status} {self.body[:300]!r}"


class Served:
    """A server on a database in a scratch folder, which is its working folder."""

    def __init__(self, *options, database="parts.db", environment=None, folder=None):
        self.own_folder = folder is None
        self.folder = folder or tempfile.mkdtemp(prefix="algebra3d-server-")
        self.database = self.path(database)
        self.token = None
        self.temporary = self.path("temporary")
        os.makedirs(self.temporary, exist_ok=True)
        self.errors = open(self.path("errors"), "w+b")
        surroundings = {name: value for name, value in os.environ.items() if name != "ALGEBRA3D_TOKEN"}
        surroundings["TMPDIR"] = self.temporary
        self.process = subprocess.Popen(
            [PROGRAM, "serve", "--db", database, *(() if "--read-only" in options else ("--create",)),
             *(() if "--port" in options else ("--port", "0")), *options],
            stdout=subprocess.PIPE, stderr=self.errors, cwd=self.folder, env={**surroundings, **(environment or {})})
        self.port = self._read_port()
        self.authority = f"127.0.0.1:{self.port}"

    def _read_port(self):
        said = b""
        while b"Ctrl-C" not in said:
            ready, _, _ = select.select([self.process.stdout], [], [], 60)
            piece = os.read(self.process.stdout.fileno(), 4096) if ready else b""
            if not piece:
                self.close()
                raise AssertionError(f"the server did not start: {said!r}")
            said += piece
        return int(re.search(rb"http://[^/]*:(\d+)/", said).group(1))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def path(self, name):
        return os.path.join(self.folder, name)

    def close(self):
        """Ends the server and removes its folder."""
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        self.process.stdout.close()
        self.errors.close()
        if self.own_folder:
            shutil.rmtree(self.folder, ignore_errors=True)

    def end(self, by=signal.SIGTERM, within=60):
        """Ends the server by a signal; its exit status and the seconds it took."""
        start = time.monotonic()
        self.process.send_signal(by)
        return self.process.wait(timeout=within), time.monotonic() - start

    def is_running(self):
        return self.process.poll() is None

    # Requests

    def ask(self, method, path, body=None, headers=None, timeout=60):
        """One request as a good client sends it."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=timeout)
        all_headers = dict(headers or {})
        if self.token:
            all_headers.setdefault("Authorization", f"Bearer {self.token}")
        try:
            connection.request(method, path, body, all_headers)
            response = connection.getresponse()
            return Answer(response.status, response.getheaders(), response.read())
        finally:
            connection.close()

    def get(self, path, **options):
        return self.ask("GET", path, **options)

    def post(self, statement, headers=None, timeout=60, **members):
        """Sends a statement; the answer of any status."""
        return self.ask("POST", "/api/query", json.dumps({"statement": statement, **members}), headers, timeout)

    def query(self, statement, **members):
        """Runs a statement, which must succeed; the object of its answer."""
        answer = self.post(statement, **members)
        if answer.status != 200:
            raise AssertionError(f"{statement[:200]}: {answer}")
        return answer.json

    def connect(self, timeout=30):
        connection = socket.create_connection(("127.0.0.1", self.port), timeout=timeout)
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        return connection

    def send(self, content, timeout=30):
        """Sends bytes as they are; the first answer, or None if nothing comes back."""
        with self.connect(timeout) as connection:
            try:
                connection.sendall(content)
            except (BrokenPipeError, ConnectionResetError):
                pass  # an early answer may be there all the same
            return first_answer(connection)

    def request_text(self, method, path, *headers, body=b""):
        """The text of a request with the right Host and the header lines given."""
        head = [f"{method} {path} HTTP/1.1", f"Host: {self.authority}", *headers]
        return "\r\n".join(head).encode("utf-8", "surrogateescape") + b"\r\n\r\n" + body

    def begin(self, statement, *headers, **members):
        """Sends a statement and leaves the answer in the connection that is returned."""
        body = json.dumps({"statement": statement, **members}).encode()
        connection = self.connect()
        connection.sendall(self.request_text("POST", "/api/query", f"Content-Length: {len(body)}", *headers, body=body))
        return connection

    # What the server holds

    def statements(self):
        return self.get("/api/statements").json

    def figures(self):
        """Resident memory in megabytes, descriptors and threads."""
        process = f"/proc/{self.process.pid}"
        with open(f"{process}/status") as status:
            text = status.read()
        return {"memory": int(re.search(r"VmRSS:\s+(\d+)", text).group(1)) / 1024,
                "descriptors": len(os.listdir(f"{process}/fd")),
                "threads": int(re.search(r"Threads:\s+(\d+)", text).group(1))}

    def run_shell(self, commands, *options, timeout=60):
        """Runs commands in another process on the same database."""
        return subprocess.run([PROGRAM, "--db", self.database, *options, "-c", commands], capture_output=True, text=True,
                              timeout=timeout, cwd=self.folder)


def processor_seconds(server):
    """Seconds of processor that a server has used."""
    with open(f"/proc/{server.process.pid}/stat") as file:
        user, system = file.read().rpartition(")")[2].split()[11:13]
    return (int(user) + int(system)) / os.sysconf("SC_CLK_TCK")


def received(connection):
    """All bytes that come until the other side closes."""
    content = b""
    try:
        while piece := connection.recv(1 << 16):
            content += piece
    except ConnectionResetError:
        pass
    return content


def first_answer(connection):
    """The next answer of a connection that may stay open, or None if it ends without one."""
    content = b""
    try:
        while not is_whole(content) and (piece := connection.recv(1 << 16)):
            content += piece
    except ConnectionResetError:
        pass
    return answer_of(content)


def is_whole(content):
    """Whether the bytes are a whole answer, by the length that it gives, or its last chunk."""
    while content.startswith(b"HTTP/1.1 100") and b"\r\n\r\n" in content:
        content = content.partition(b"\r\n\r\n")[2]
    head, end, body = content.partition(b"\r\n\r\n")
    length = re.search(rb"(?i)\r\ncontent-length: (\d+)", head)
    if b"transfer-encoding: chunked" in head.lower():
        return body.endswith(b"0\r\n\r\n")
    return bool(end) and (len(body) >= int(length.group(1)) if length else head[9:12] in (b"204", b"304"))


def answer_of(content):
    """Bytes of one HTTP answer, or None for none. Interim answers (100) are left out."""
    while content.startswith(b"HTTP/1.1 100"):
        content = content.partition(b"\r\n\r\n")[2]
    if not content:
        return None
    head, _, body = content.partition(b"\r\n\r\n")
    lines = head.decode("latin-1").split("\r\n")
    return Answer(int(lines[0].split()[1]), [tuple(line.split(": ", 1)) for line in lines[1:]], body)


def wait_until(condition, within=10):
    """Whether the condition comes true in time."""
    deadline = time.monotonic() + within
    while not condition():
        if time.monotonic() > deadline:
            return False
        time.sleep(0.02)
    return True


class ServerTest(unittest.TestCase):
    """A test with one server for all its cases, which must be there, and answer, after each of them."""
    OPTIONS = ()

    ENVIRONMENT = {}

    @classmethod
    def setUpClass(cls):
        cls.server = Served(*cls.OPTIONS, environment=cls.ENVIRONMENT)
        cls.server.token = cls.ENVIRONMENT.get("ALGEBRA3D_TOKEN")

    @classmethod
    def tearDownClass(cls):
        """Whatever the cases have done, the server ends as it should."""
        try:
            status, _ = cls.server.end()
            if status != 0:
                raise AssertionError(f"the server ended with exit status {status}")
        finally:
            cls.server.close()

    def setUp(self):
        # A case that has ended the server has failed; the others shall say what they have to say.
        if not self.server.is_running():
            self.server.close()
            self.setUpClass()

    def tearDown(self):
        self.assertTrue(self.server.is_running(), "the server has ended")
        self.assertEqual(self.server.get("/api/server").status, 200)
        self.assertTrue(wait_until(lambda: self.server.statements() == []), "statements are left")

    def expect_refusal(self, answer, status, code, words=""):
        """An error response: its status, its code, and words of its message."""
        self.assertIsNotNone(answer, "the connection was closed without an answer")
        self.assertEqual(answer.status, status, answer)
        self.assertEqual(answer.headers["content-type"], "application/json")
        self.assertEqual(answer.error["code"], code, answer)
        self.assertIn(words, answer.error["message"])


def main():
    """Runs the tests of the main module with the program of the first argument, if there is one."""
    global PROGRAM
    arguments = sys.argv[1:]
    if arguments and os.path.exists(arguments[0]):
        PROGRAM = os.path.abspath(arguments.pop(0))
    unittest.main(module="__main__", argv=[sys.argv[0], *arguments])
