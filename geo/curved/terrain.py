#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""terrain.py: writes terrain.stl, two hills and a valley in 384 coarse triangles, as a survey might deliver them."""
import math
import struct

COLUMNS, ROWS, STEP = 16, 12, 100.0


def height(x, y):
    hill = 220 * math.exp(-((x - 500) ** 2 + (y - 700) ** 2) / 260 ** 2)
    ridge = 150 * math.exp(-((x - 1150 - 0.3 * y) / 240) ** 2)
    return hill + ridge + 20 * math.sin(x / 210) * math.cos(y / 170)


def point(i, j):
    return i * STEP, j * STEP, height(i * STEP, j * STEP)


def main():
    facets = []
    for i in range(COLUMNS):
        for j in range(ROWS):
            a, b, c, d = point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)
            facets += [(a, b, c), (a, c, d)] if (i + j) % 2 else [(a, b, d), (b, c, d)]
    with open('terrain.stl', 'wb') as out:
        out.write(b'terrain of qmorph'.ljust(80))
        out.write(struct.pack('<I', len(facets)))
        for facet in facets:
            out.write(struct.pack('<3f', 0, 0, 0))
            for corner in facet:
                out.write(struct.pack('<3f', *corner))
            out.write(struct.pack('<H', 0))


main()
