"""What one writes without clearloci: the pose errors of the planar 5R by NumPy, on a grid and over cycle times.

`map`: 1000 x 1000 poses under the vertical load of examples/five_bar.yaml. `sweep`: the cycle of examples/pick_and_place
at 2000 instants and 126 periods, accelerations by finite differences. Both by numpy.linalg.solve, pose for pose.
Usage: numpy_errors.py map|sweep    prints the seconds of the computation alone
"""

import sys
import time

import numpy as np
from numpy_contour import L, LOAD, newton_euler

FORCES = [(0, 1), (2, 3), (4, 5), (6, 7), (8, 9)]
COUPLES = [10, 11]


def pose_errors(w, influence, radial, angular):
    """dx, dy, dalpha by the take-up that the reactions w (..., 12) choose; influence: (..., 12, 3)."""
    take_up = np.zeros_like(w)
    for x, y in FORCES:
        size = np.hypot(w[..., x], w[..., y])
        take_up[..., x] = -radial * w[..., x] / size
        take_up[..., y] = -radial * w[..., y] / size
    for m in COUPLES:
        take_up[..., m] = -angular * np.sign(w[..., m])
    return np.einsum("...k,...kr->...r", take_up, influence)


def solve(matrix, loads):
    """Reactions and the influence of unit loads on the end effector (third link)."""
    right = np.zeros(matrix.shape[:-1] + (4,))
    right[..., 0] = -loads
    for row in range(3):
        right[..., 6 + row, 1 + row] = -1
    solution = np.linalg.solve(matrix, right)
    return solution[..., 0], solution[..., 1:]


def error_map(nodes=1000):
    x = -0.5 + 1.5 * (np.arange(nodes) + 0.5) / nodes
    y = -1.0 + 2.0 * (np.arange(nodes) + 0.5) / nodes
    result = np.full((nodes, nodes, 3), np.nan)
    for row in range(nodes):  # all at once would need 1.2 GB for the matrices alone
        matrix, _, reachable = newton_euler(np.stack([x, np.full(nodes, y[row])], axis=-1))
        loads = np.zeros((np.count_nonzero(reachable), 12))
        loads[:, 6:8] = LOAD
        w, influence = solve(matrix[reachable], loads)
        result[row, reachable] = pose_errors(w, influence, 10e-6, 0.5e-3)
    return result


def cycle(count):
    """P over a cycle: up, across and down along an arc, a line and an arc, and back; cycloidal in each half."""
    r, straight = 0.025, 0.45
    length = straight + np.pi * r
    tau = (np.arange(count) + 0.5) / count
    half = (2 * tau) % 1
    s = length * (half - np.sin(2 * np.pi * half) / (2 * np.pi))
    s = np.where(tau < 0.5, s, length - s)
    arc = np.pi / 2 * r
    first, last = np.clip(s, 0, arc) / r, np.clip(s - arc - straight, 0, arc) / r
    x = r * (1 - np.cos(first)) + np.clip(s - arc, 0, straight) + r * np.sin(last)
    y = -0.82 + r * np.sin(first) - r * (1 - np.cos(last))
    return tau, np.stack([x, y], axis=-1)


def sweep(count=2000, periods=126):
    tau, p = cycle(count)
    matrix, (b1, b2), _ = newton_euler(p)
    a1, a2 = np.zeros(2), np.array([0.5, 0.0])
    second = lambda values: np.gradient(np.gradient(values, tau, axis=0), tau, axis=0)  # noqa: E731
    carried = np.where(tau < 0.5, 10.0, 0.0)
    at_rest, inertial = np.zeros((count, 12)), np.zeros((count, 12))
    for link, (u, v) in enumerate([(a1, b1), (b1, p), (p, b2), (b2, a2)]):
        u, v = np.broadcast_to(u, p.shape), np.broadcast_to(v, p.shape)
        angle = np.unwrap(np.arctan2(v[:, 1] - u[:, 1], v[:, 0] - u[:, 0]))
        masses = [(np.full(count, 1.0), (u + v) / 2)] + ([(carried, p)] if link == 2 else [])
        inertial[:, 3 * link + 2] -= L * L / 12 * second(angle)
        for mass, at in masses:
            arm, acceleration = at - p, second(at)
            for target, force in ((at_rest, mass[:, None] * [0, -9.81]), (inertial, -mass[:, None] * acceleration)):
                target[:, 3 * link : 3 * link + 2] += force
                target[:, 3 * link + 2] += arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0]
    w_s, influence = solve(matrix, at_rest)
    w_i, _ = solve(matrix, inertial)
    times = 0.5 + 0.02 * np.arange(periods)
    return np.stack([pose_errors(w_s + w_i / (t * t), influence, 10e-3, 0.005) for t in times])


def main():
    started = time.perf_counter()
    with np.errstate(invalid="ignore", divide="ignore"):
        result = {"map": error_map, "sweep": sweep}[sys.argv[1]]()
    print(time.perf_counter() - started)
    print("median |dx|, |dy|, |dalpha|:", *np.nanmedian(np.abs(result.reshape(-1, 3)), axis=0), file=sys.stderr)


if __name__ == "__main__":
    main()
