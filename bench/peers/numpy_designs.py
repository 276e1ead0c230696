"""What one writes without clearloci: designs of the planar 5R judged one by one, by NumPy's statics on a grid of poses.

For every design of DESIGNS (lines "L d") the Newton-Euler systems of Altuzarra et al. (2011), equation (13), are solved
at NODES x NODES poses of a box; the design passes where all are within reach, the determinant and the actuators' couples
keep one sign, and no joint's force falls to a thousandth of the load. It proves nothing between the nodes.
Usage: numpy_designs.py DESIGNS NODES X0 X1 Y0 Y1     prints the processor seconds, and a line of 0 and 1 for the designs
"""

import sys
import time

import numpy as np
import numpy_contour

FORCES = [(0, 1), (2, 3), (4, 5), (6, 7), (8, 9)]


def passes(length, base, poses):
    numpy_contour.L, numpy_contour.D = length, base
    matrix, _, reachable = numpy_contour.newton_euler(poses)
    if not reachable.all():
        return False
    determinant = np.linalg.det(matrix)
    if determinant.min() <= 0 <= determinant.max():
        return False
    right = np.zeros(poses.shape[:-1] + (12, 1))
    right[..., 6:8, 0] = -numpy_contour.LOAD
    w = np.linalg.solve(matrix, right)[..., 0]
    if any(w[..., m].min() <= 0 <= w[..., m].max() for m in (10, 11)):
        return False
    least = 1e-3 * np.hypot(*numpy_contour.LOAD)
    return all(np.hypot(w[..., x], w[..., y]).min() > least for x, y in FORCES)


def main():
    designs = np.loadtxt(sys.argv[1], ndmin=2)
    nodes = int(sys.argv[2])
    x0, x1, y0, y1 = map(float, sys.argv[3:7])
    poses = np.stack(np.meshgrid(np.linspace(x0, x1, nodes), np.linspace(y0, y1, nodes)), axis=-1)
    start = time.process_time()
    verdicts = [passes(length, base, poses) for length, base in designs]
    print(time.process_time() - start)
    print("".join("1" if own else "0" for own in verdicts))


if __name__ == "__main__":
    main()
