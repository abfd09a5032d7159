#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes hills.png beside itself: a grey height field of 16 bit, 128 x 128, rolling hills with a hollow in the middle."""
import math
import pathlib
import struct
import zlib

SIZE = 128


def height(u, v):
    """0 to 1 for u, v in 0 to 1."""
    waves = 0.3 * math.sin(5.1 * u + 1.3) * math.cos(4.3 * v) + 0.15 * math.sin(11.7 * u + 7.9 * v)
    hollow = math.exp(-((u - 0.5) ** 2 + (v - 0.35) ** 2) / 0.05)
    return 0.5 + waves + 0.35 * (v - 0.5) - 0.3 * hollow


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


cells = [[height(x / (SIZE - 1), 1 - y / (SIZE - 1)) for x in range(SIZE)] for y in range(SIZE)]
low = min(map(min, cells))
high = max(map(max, cells))
rows = b"".join(b"\0" + b"".join(struct.pack(">H", round(65535 * (c - low) / (high - low))) for c in row) for row in cells)
header = struct.pack(">IIBBBBB", SIZE, SIZE, 16, 0, 0, 0, 0)
png = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")
(pathlib.Path(__file__).resolve().parent / "hills.png").write_bytes(png)
