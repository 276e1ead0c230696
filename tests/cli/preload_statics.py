"""Statics of planar mechanisms of pins, motors and cables, and linear programs of one or two efforts: written apart from
the program, for the law of tests/cli/test_preloads.py. Metres, newtons."""

import itertools
import math

import numpy


class Mechanism:
    """Massless links without shape. Pins: (name, from, to, point); what `from` exerts on `to` is counted. Motors: couples
    at pins. Cables: (name, anchor, link, point) pull. Link 0 is the ground. A link of one point bears no moment."""

    def __init__(self, links, pins, motors, cables, points_alone=()):
        self.links, self.pins, self.motors, self.cables = links, pins, motors, cables
        self.points_alone = set(points_alone)

    def columns(self, points, forces):
        """Names of unknowns, the matrix of their balances and the loads' side."""
        rows = [(link, part) for link in range(1, self.links) for part in range(2 if link in self.points_alone else 3)]
        place = {row: i for i, row in enumerate(rows)}
        names, columns = [], []

        def column(name, entries):
            own = numpy.zeros(len(rows))
            for link, at, force, couple in entries:
                if link == 0:
                    continue
                own[place[link, 0]] += force[0]
                own[place[link, 1]] += force[1]
                if (link, 2) in place:
                    own[place[link, 2]] += at[0] * force[1] - at[1] * force[0] + couple
            names.append(name)
            columns.append(own)

        for name, start, end, at in self.pins:
            for part, force in (("x", (1, 0)), ("y", (0, 1))):
                opposite = (-force[0], -force[1])
                column("f_" + name + part, [(end, points[at], force, 0), (start, points[at], opposite, 0)])
            if name in self.motors:
                column("M_" + name, [(end, (0, 0), (0, 0), 1), (start, (0, 0), (0, 0), -1)])
        for name, anchor, link, at in self.cables:
            way = numpy.subtract(points[anchor], points[at])
            column("F_" + name, [(link, points[at], way / numpy.linalg.norm(way), 0)])
        side = numpy.zeros(len(rows))
        for link, at, force in forces:
            side[place[link, 0]] -= force[0]
            side[place[link, 1]] -= force[1]
            if (link, 2) in place:
                side[place[link, 2]] -= points[at][0] * force[1] - points[at][1] * force[0]
        return names, numpy.column_stack(columns), side

    def affine(self, points, forces, free):
        """Every unknown as offset + slope . efforts of the free ones."""
        names, matrix, side = self.columns(points, forces)
        chosen = [names.index(name) for name in free]
        others = [i for i in range(len(names)) if i not in chosen]
        square = matrix[:, others]
        offset = numpy.linalg.solve(square, side)
        slope = numpy.linalg.solve(square, -matrix[:, chosen]) if chosen else numpy.zeros((len(others), 0))
        result = {names[i]: (offset[k], slope[k]) for k, i in enumerate(others)}
        for k, i in enumerate(chosen):
            result[names[i]] = (0.0, numpy.eye(len(chosen))[k])
        return result


def dyad(a, b, first, second, side):
    """The third corner of a triangle, left (1) or right (-1) of the way from a to b; none out of reach."""
    way = numpy.subtract(b, a)
    length = float(numpy.linalg.norm(way))
    along = (length**2 + first**2 - second**2) / (2 * length)
    square = first**2 - along**2
    if square <= 0:
        return None
    unit = way / length
    across = numpy.array([-unit[1], unit[0]])
    return tuple(numpy.array(a) + along * unit + side * math.sqrt(square) * across)


def feasible_depth(rows, limits):
    """Largest d for which some efforts within the limits have offset + slope . efforts >= d |row| in every row, by the
    vertices of the program in efforts and d (one or two efforts)."""
    efforts = len(limits)
    lines = []
    for offset, slope in rows:
        size = abs(offset) + sum(abs(part) * limit for part, limit in zip(slope, limits)) or 1.0
        lines.append((offset, [*slope, -size]))
    for k, limit in enumerate(limits):
        for sign in (1, -1):
            lines.append((limit, [sign if i == k else 0 for i in range(efforts)] + [0.0]))
    offsets = numpy.array([line[0] for line in lines])
    slopes = numpy.array([line[1] for line in lines])
    chosen = numpy.array(list(itertools.combinations(range(len(lines)), efforts + 1)))
    best = -math.inf
    for part in numpy.array_split(chosen, 1 + len(chosen) // 20000):
        regular = part[numpy.abs(numpy.linalg.det(slopes[part])) >= 1e-14]
        vertices = numpy.linalg.solve(slopes[regular], -offsets[regular][..., None])[..., 0]
        left = offsets + vertices @ slopes.T
        met = numpy.all(left >= -1e-9 * (1 + numpy.abs(offsets)), axis=1)
        best = max(best, vertices[met, -1].max(initial=-math.inf))
    return best
