# SPDX-License-Identifier: GPL-2.0-or-later
"""What the tests of pages know of a mesh without asking the page: MSH 2.2 as text, and figures of its quads."""
import math


class Mesh22:
    def __init__(self, path):
        lines = iter(open(path, encoding="utf-8").read().split("\n"))
        self.nodes, self.quads, self.triangles = {}, {}, {}
        for line in lines:
            if line == "$Nodes":
                for _ in range(int(next(lines))):
                    tag, x, y, z = next(lines).split()
                    self.nodes[int(tag)] = (float(x), float(y), float(z))
            if line == "$Elements":
                for _ in range(int(next(lines))):
                    tag, kind, count, *rest = map(int, next(lines).split())
                    if kind == 3:
                        self.quads[tag] = rest[count:]
                    if kind == 2:
                        self.triangles[tag] = rest[count:]

    def points(self, tag):
        return [self.nodes[n][:2] for n in (self.quads.get(tag) or self.triangles[tag])]

    def middle(self, tag):
        points = self.points(tag)
        return [sum(p[i] for p in points) / len(points) for i in (0, 1)]

    def corners_in_space(self, tag):
        return [self.nodes[n] for n in (self.quads.get(tag) or self.triangles[tag])]

    def middle_in_space(self, tag):
        points = self.corners_in_space(tag)
        return [sum(p[i] for p in points) / len(points) for i in range(3)]

    def scaled_jacobian_in_space(self, tag):
        """Of a flat, convex quad anywhere."""
        p, least = self.corners_in_space(tag), 1
        for i in range(4):
            a, b = ([q[k] - p[i][k] for k in range(3)] for q in (p[(i + 1) % 4], p[i - 1]))
            cross = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
            least = min(least, math.hypot(*cross) / (math.hypot(*a) * math.hypot(*b)))
        return least

    def scaled_jacobian(self, tag):
        """Of a quad in the plane z = 0, counter-clockwise."""
        p, least = self.points(tag), 1
        for i in range(4):
            a = [p[(i + 1) % 4][k] - p[i][k] for k in (0, 1)]
            b = [p[i - 1][k] - p[i][k] for k in (0, 1)]
            least = min(least, (a[0] * b[1] - a[1] * b[0]) / (math.hypot(*a) * math.hypot(*b)))
        return least

    def size(self, tag):
        p = self.points(tag)
        return sum(math.dist(p[i], p[i - 1]) for i in range(len(p))) / len(p)

    def box(self):
        used = {n for nodes in (*self.quads.values(), *self.triangles.values()) for n in nodes}
        xs, ys = zip(*(self.nodes[n][:2] for n in used))
        return min(xs), min(ys), max(xs), max(ys)
