"""The checksums of pages of database files, as docs/file_format.md, "Database files", states them: a second source for tests, and a means
to damage a file where its pages are right."""
import ctypes
import ctypes.util

PAGE = 4096
UNCHECKED = ((18, 20), (24, 28), (40, 44), (68, 72), (92, 100))  # bytes of page 1


def page(content, index):
    return content[index * PAGE:(index + 1) * PAGE]


def checksum(content, number):
    """Of a page, as its last eight bytes have it."""
    library = ctypes.CDLL(ctypes.util.find_library("xxhash") or "libxxhash.so.0")
    library.XXH3_64bits_withSeed.restype = ctypes.c_uint64
    library.XXH3_64bits_withSeed.argtypes = [ctypes.c_char_p, ctypes.c_size_t, ctypes.c_uint64]
    counted = bytearray(content[:-8])
    if number == 1:
        for begin, end in UNCHECKED:
            counted[begin:end] = bytes(end - begin)
    return library.XXH3_64bits_withSeed(bytes(counted), len(counted), number).to_bytes(8, "little")


def stamped(content):
    """The file with right checksums."""
    return b"".join(page(content, i)[:-8] + checksum(page(content, i), i + 1) for i in range(len(content) // PAGE))


def stamp(database):
    """Gives the pages of a file right checksums, after other programs have changed it. Nobody has it open."""
    with open(database, "rb") as file:
        content = stamped(file.read())
    with open(database, "wb") as file:
        file.write(content)
