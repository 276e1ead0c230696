"""M_A1 = 0 of the 5R with weights by a NumPy grid and contourpy: the numerator by statics, leg by leg, without its poles.

Prints JSON: for each grid the time and the deviation of the chords from the curve, measured as bench/engines.cpp does.
Usage: numpy_moment.py CELLS...
"""

import json
import sys
import time

import contourpy
import numpy as np

L = D = 0.5
LOAD = -100.0
WEIGHT = -9.81


def dyad(ax, x, y, side):
    vx, vy = x - ax, y
    d = vx * vx + vy * vy
    root = side * np.sqrt(4 * L * L * d - d * d)
    return ax + (d * vx - root * vy) / (2 * d), (d * vy + root * vx) / (2 * d)


def numerator(x, y):
    """|A| M_A1 up to a constant; not a number outside the workspace."""
    with np.errstate(invalid="ignore", divide="ignore"):
        b1x, b1y = dyad(0.0, x, y, -1)
        b2x, b2y = dyad(D, x, y, +1)
        ux, uy, vx, vy = x - b1x, y - b1y, x - b2x, y - b2y
        # f: what B1P exerts on PB2 at P. Moments about B1 on B1P: u x f = r1; about B2 on PB2: v x f = r2.
        r1 = 0.5 * ux * WEIGHT
        r2 = -vx * LOAD - 0.5 * vx * WEIGHT
        determinant = uy * vx - ux * vy
        fx = ux * r2 - vx * r1  # times the determinant
        fy = uy * r2 - vy * r1
        # A1B1 carries -f, the weight of B1P at B1, and its own.
        return b1x * (WEIGHT * determinant - fy) + b1y * fx + 0.5 * b1x * WEIGHT * determinant


def segments(cells):
    x = np.linspace(-0.5, 1.0, cells + 1) + 1e-7
    y = np.linspace(-1.0, 1.0, cells + 1) + 1e-7
    field = numerator(x[np.newaxis, :], y[:, np.newaxis])
    lines = contourpy.contour_generator(x, y, np.ma.masked_invalid(field)).lines(0.0)
    return [np.stack([line[:-1], line[1:]], axis=1) for line in lines if len(line) > 1]


def deviation(parts):
    both = np.concatenate(parts)
    a, b = both[:, 0], both[:, 1]
    length = np.hypot(*(b - a).T)
    worst = np.zeros(len(a))
    h = 1e-7
    for t in (0.0, 0.25, 0.5, 0.75):
        x, y = (a + t * (b - a)).T
        slope = np.hypot(numerator(x + h, y) - numerator(x - h, y), numerator(x, y + h) - numerator(x, y - h)) / (2 * h)
        worst = np.maximum(worst, np.abs(numerator(x, y)) / slope)
    inside = np.isfinite(worst) & (length > 0)
    order = np.argsort(worst[inside])
    along = np.cumsum(length[inside][order])
    return float(worst[inside][order][np.searchsorted(along, 0.99 * along[-1])])


def main():
    result = []
    for cells in map(int, sys.argv[1:]):
        started = time.perf_counter()
        parts = segments(cells)
        milliseconds = 1e3 * (time.perf_counter() - started)
        result.append({"cells": cells, "milliseconds": milliseconds, "deviation": deviation(parts)})
    print(json.dumps(result))


if __name__ == "__main__":
    main()
