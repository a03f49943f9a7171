"""OpenIGTLink's messages, decoded from the protocol's description alone: no library has a part in it.

https://github.com/openigtlink/OpenIGTLink/blob/master/Documents/Protocol: a header of 58 bytes, big-endian, and a body with its CRC.
"""

import collections
import socket
import struct
import time

HEADER = struct.Struct(">H12s20sQQQ")
POLYNOMIAL = 0x42F0E1EBA9EA3693  # of CRC-64-ECMA-182

Message = collections.namedtuple("Message", "kind device body")
Model = collections.namedtuple("Model", "points verts lines polygons strips fields")
Point = collections.namedtuple("Point", "label group colour position diameter")


def crc_table():
    table = []
    for byte in range(256):
        crc = byte << 56
        for _ in range(8):
            crc = (crc << 1 & (1 << 64) - 1) ^ (POLYNOMIAL if crc >> 63 else 0)
        table.append(crc)
    return table


TABLE = crc_table()


def crc64(body):
    crc = 0
    for byte in body:
        crc = (crc << 8 & (1 << 64) - 1) ^ TABLE[crc >> 56 ^ byte]
    return crc


def text_of(field):
    return field.split(b"\0")[0].decode("utf-8")


def packed(kind, device="", body=b"", version=1):
    """A message, as a client says it."""
    return HEADER.pack(version, kind.encode(), device.encode(), 0, len(body), crc64(body)) + body


def cells(body, at, count, size):
    found, end = [], at + size
    while at < end:
        (corners,) = struct.unpack_from(">I", body, at)
        found.append(struct.unpack_from(f">{corners}I", body, at + 4))
        at += 4 + 4 * corners
    assert len(found) == count and at == end, "cells do not fill their section"
    return found


def model_of(body):
    """POLYDATA: points as triples, cells by their corners, fields by (point or cell, name)."""
    npoints, *counts, nattributes = struct.unpack_from(">10I", body)
    sections = zip(counts[0::2], counts[1::2])
    at = 40
    points = list(struct.iter_unpack(">3f", body[at:at + 12 * npoints]))
    at += 12 * npoints
    kinds = []
    for count, size in sections:
        kinds.append(cells(body, at, count, size))
        at += size
    heads = [struct.unpack_from(">HI", body, at + 6 * i) for i in range(nattributes)]
    at += 6 * nattributes
    names = []
    start = at
    for _ in heads:
        end = body.index(b"\0", at)
        names.append(body[at:end].decode())
        at = end + 1
    at += (at - start) % 2
    fields = {}
    for (kind, size), name in zip(heads, names):
        assert kind in (0x0001, 0x1001), "scalars, of one component"
        where = "cell" if kind >> 8 & 0x10 else "point"
        fields[where, name] = struct.unpack_from(f">{size}f", body, at)
        at += 4 * size
    assert at == len(body), f"{len(body) - at} bytes are left"
    return Model(points, *kinds, fields)


def points_of(body):
    """POINT: 136 bytes each, as many as there are whole."""
    points = []
    for label, group, *rest in struct.iter_unpack(">64s32s4B4f20s", body[:len(body) // 136 * 136]):
        points.append(Point(text_of(label), text_of(group), tuple(rest[:4]), tuple(rest[4:7]), rest[7]))
    return points


def matrix_of(body):
    """TRANSFORM: three columns, then the place. Returns (columns, place)."""
    numbers = struct.unpack(">12f", body)
    columns = [numbers[3 * i:3 * i + 3] for i in range(4)]
    return columns[:3], columns[3]


def string_of(body):
    encoding, length = struct.unpack_from(">HH", body)
    assert encoding == 106 and length == len(body) - 4, "UTF-8, as long as it says"
    return body[4:].decode("utf-8")


def status_of(body):
    """(code, name, words)"""
    code, _, name = struct.unpack_from(">Hq20s", body)
    assert body[-1:] == b"\0"
    return code, text_of(name), body[30:-1].decode("utf-8")


def kinds_of(body):
    return [text_of(body[i:i + 12]) for i in range(0, len(body), 12)]


class Client:
    """Receives, and holds the latest message of each device; `all`: every one, in order."""

    def __init__(self, port, buffer=None):
        self.socket = socket.socket()
        if buffer:
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, buffer)
        self.socket.connect(("127.0.0.1", port))
        self.bytes, self.latest, self.all = b"", {}, []

    def close(self):
        self.socket.close()

    def say(self, data):
        self.socket.sendall(data)

    def receive(self, patience_s):
        """The next message; None where there is none in time. Raises ConnectionError where the other end closed."""
        until = time.monotonic() + patience_s
        while True:
            if len(self.bytes) >= HEADER.size:
                version, kind, device, _, size, crc = HEADER.unpack_from(self.bytes)
                if len(self.bytes) >= HEADER.size + size:
                    body, self.bytes = self.bytes[HEADER.size:HEADER.size + size], self.bytes[HEADER.size + size:]
                    assert version == 1 and crc == crc64(body), "the header does not fit its body"
                    message = Message(text_of(kind), text_of(device), body)
                    self.latest[message.device] = message
                    self.all.append(message)
                    return message
            left = until - time.monotonic()
            if left <= 0:
                return None
            self.socket.settimeout(left)
            try:
                more = self.socket.recv(1 << 20)
            except socket.timeout:
                return None
            if not more:
                raise ConnectionError("the link has closed the connection")
            self.bytes += more

    def until(self, holds, patience_s=60):
        """Receives until that holds of this client."""
        end = time.monotonic() + patience_s
        while not holds(self):
            if self.receive(max(0.01, end - time.monotonic())) is None and time.monotonic() > end:
                raise AssertionError(f"not in {patience_s} s; there were {[message.device for message in self.all]}")
        return self
