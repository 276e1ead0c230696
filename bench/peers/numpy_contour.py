"""What one writes without clearloci: reactions of the planar 5R on a grid, contours of their zero level.

Same mechanism, load and files as `clearloci loci examples/five_bar.yaml`: the Newton-Euler system of Altuzarra et al.
(2011), equation (13), solved at every node by numpy.linalg.solve, contours and picture by matplotlib. It proves nothing:
ovals smaller than a cell are missed, the common zeros of fx and fy show as two curves on top of each other, and the poles
of the reactions at direct singularities are drawn as zeros.
Usage: numpy_contour.py FOLDER [NODES]
"""

import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

L = D = 0.5
LOAD = np.array([0.0, -100.0])
NAMES = ["fA1x", "fA1y", "fB1x", "fB1y", "fPx", "fPy", "fB2x", "fB2y", "fA2x", "fA2y", "MA1", "MA2"]


def dyad(a, p, side):
    """B with |AB| = |BP| = L, to the left (+1) or right (-1) of A to P; not a number where there is none."""
    v = p - a
    d = np.sum(v * v, axis=-1, keepdims=True)
    with np.errstate(invalid="ignore", divide="ignore"):
        root = np.sqrt(4 * L * L * d - d * d)
        normal = np.stack([-v[..., 1], v[..., 0]], axis=-1)
        return a + (d * v + side * root * normal) / (2 * d)


def newton_euler(p):
    """The matrices of the poses, 12 x 12 each, the elbows, and which poses are reachable."""
    a1, a2 = np.array([0.0, 0.0]), np.array([D, 0.0])
    b1, b2 = dyad(a1, p, -1), dyad(a2, p, +1)
    matrix = np.zeros(p.shape[:-1] + (12, 12))
    # Links A1B1, B1P, PB2, B2A2; joints [from, to, at].
    joints = [(None, 0, a1), (0, 1, b1), (1, 2, p), (3, 2, b2), (None, 3, a2)]
    for column, (source, target, at) in enumerate(joints):
        arm = at - p
        for link, sign in ((target, 1.0), (source, -1.0)):
            if link is None:
                continue
            matrix[..., 3 * link, 2 * column] = sign
            matrix[..., 3 * link + 1, 2 * column + 1] = sign
            matrix[..., 3 * link + 2, 2 * column] = -sign * arm[..., 1]
            matrix[..., 3 * link + 2, 2 * column + 1] = sign * arm[..., 0]
    matrix[..., 2, 10] = 1.0
    matrix[..., 11, 11] = 1.0
    reachable = np.isfinite(b1).all(axis=-1) & np.isfinite(b2).all(axis=-1)
    return matrix, (b1, b2), reachable


def reactions(p):
    matrix, _, reachable = newton_euler(p)
    right = np.zeros(p.shape[:-1] + (12, 1))
    right[..., 6:8, 0] = -LOAD
    result = np.full(p.shape[:-1] + (12,), np.nan)
    result[reachable] = np.linalg.solve(matrix[reachable], right[reachable])[..., 0]
    return result


def main():
    folder = pathlib.Path(sys.argv[1])
    nodes = int(sys.argv[2]) if len(sys.argv) > 2 else 400
    folder.mkdir(parents=True, exist_ok=True)
    # Off the lines of symmetry, where the matrix is singular.
    x = np.linspace(-0.5, 1.0, nodes) + 1e-7
    y = np.linspace(-1.0, 1.0, nodes) + 1e-7
    field = reactions(np.stack(np.meshgrid(x, y), axis=-1))

    figure, axes = plt.subplots(figsize=(6, 8))
    axes.set_aspect("equal")
    with open(folder / "loci.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["reaction", "arc", "x", "y"])
        for k, name in enumerate(NAMES):
            contour = axes.contour(x, y, field[..., k], levels=[0.0], colors=[f"C{k % 10}"])
            for arc, segment in enumerate(contour.allsegs[0]):
                writer.writerows([name, arc, px, py] for px, py in segment)
    figure.savefig(folder / "loci.svg")
    figure.savefig(folder / "loci.png", dpi=150)


if __name__ == "__main__":
    main()
