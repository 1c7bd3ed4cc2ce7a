"""Connections to a server of PostgreSQL over its socket, for tests that need more than psql: the moment of each answer, requests
to cancel, bytes of COPY. The protocol is version 3 (chapter "Frontend/Backend Protocol" of PostgreSQL's manual)."""
import dataclasses
import socket
import struct
import time

PROTOCOL = 196608
CANCEL = 80877102


class Lost(Exception):
    """The server has closed the connection."""


@dataclasses.dataclass
class Answer:
    rows: list = dataclasses.field(default_factory=list)  # of tuples of texts, None for NULL
    sql_state: str = ""  # of the first error
    message: str = ""  # likewise
    notices: list = dataclasses.field(default_factory=list)
    copied: bytes = b""  # what COPY TO STDOUT gave
    began: float = 0.0  # seconds of time.monotonic()
    ended: float = 0.0

    @property
    def value(self):
        return self.rows[-1][0] if self.rows else None


class Connection:
    def __init__(self, folder, database="postgres", user="postgres"):
        self.address = f"{folder}/.s.PGSQL.5432"
        self.socket = self._opened()
        self.buffer = bytearray()
        parameters = b"".join(text.encode() + b"\0" for text in ("user", user, "database", database)) + b"\0"
        self.socket.sendall(struct.pack("!ii", 8 + len(parameters), PROTOCOL) + parameters)
        self.pid = self.key = None
        answer = Answer()
        try:
            self._read_until_ready(answer)
        except Lost:
            self.close()
            raise Lost(answer.message or "the server has closed the connection") from None

    def close(self):
        self.socket.close()

    def query(self, sql, copy_in=None):
        """Runs statements; `copy_in` are the bytes for a COPY FROM STDIN among them."""
        answer = Answer(began=time.monotonic())
        self.send(sql)
        self._read_until_ready(answer, copy_in)
        return answer

    def send(self, sql):
        """Starts statements, whose answer `receive` waits for."""
        text = sql.encode() + b"\0"
        try:
            self.socket.sendall(b"Q" + struct.pack("!i", 4 + len(text)) + text)
        except OSError as error:
            raise Lost(str(error)) from error

    def receive(self):
        answer = Answer(began=time.monotonic())
        self._read_until_ready(answer)
        return answer

    def request_cancel(self):
        """What psql does at Ctrl-C."""
        with self._opened() as other:
            other.sendall(struct.pack("!iiii", 16, CANCEL, self.pid, self.key))
            other.recv(1)

    def _opened(self):
        made = socket.socket(socket.AF_UNIX)
        made.settimeout(3600)
        made.connect(self.address)
        return made

    def _bytes(self, count):
        while len(self.buffer) < count:
            try:
                more = self.socket.recv(1 << 16)
            except OSError as error:
                raise Lost(str(error)) from error
            if not more:
                raise Lost("the server has closed the connection")
            self.buffer += more
        taken = bytes(self.buffer[:count])
        del self.buffer[:count]
        return taken

    def _read_until_ready(self, answer, copy_in=None):
        while True:
            kind, length = struct.unpack("!ci", self._bytes(5))
            body = self._bytes(length - 4)
            if kind == b"Z":
                answer.ended = time.monotonic()
                return
            self._take(kind, body, answer, copy_in)

    def _take(self, kind, body, answer, copy_in):
        if kind == b"D":
            answer.rows.append(_row(body))
        elif kind in b"EN":
            fields = {field[:1]: field[1:].decode(errors="replace") for field in body.split(b"\0") if field}
            if kind == b"N":
                answer.notices.append(fields[b"M"])
            elif not answer.sql_state:
                answer.sql_state, answer.message = fields[b"C"], fields[b"M"]
        elif kind == b"d":
            answer.copied += body
        elif kind == b"K":
            self.pid, self.key = struct.unpack("!ii", body)
        elif kind == b"G":
            data = copy_in or b""
            self.socket.sendall(b"d" + struct.pack("!i", 4 + len(data)) + data + b"c" + struct.pack("!i", 4))


def _row(body):
    cells, place = [], 2
    for _ in range(struct.unpack_from("!h", body)[0]):
        size = struct.unpack_from("!i", body, place)[0]
        place += 4
        cells.append(None if size < 0 else body[place:place + size].decode())
        place += max(size, 0)
    return tuple(cells)
