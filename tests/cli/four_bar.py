"""The shipped four-bar by hand: forces of two-force members, and the closure with every clearance taken up."""

import math

CRANK, COUPLER, ROCKER, BASE, LOAD = 0.3, 0.9, 0.6, 1.0, -100.0
RADIAL, ANGULAR = 10e-6, 0.5e-3


def apex(first, a, second, b):
    """At distance a from the first point and b from the second, to the left of the way from one to the other."""
    way = second - first
    along = (a * a - b * b + abs(way) ** 2) / (2 * abs(way))
    return first + way / abs(way) * complex(along, math.sqrt(a * a - along * along))


def cross(p, q):
    return (p.conjugate() * q).imag


def reactions(theta):
    """f_A, f_B, f_C, f_D as complex numbers, and M_A: what the first link of each joint exerts on the second."""
    b = CRANK * complex(math.cos(theta), math.sin(theta))
    c = apex(b, COUPLER, complex(BASE, 0), ROCKER)
    way, arm = (c - b) / COUPLER, c - BASE
    tension = -cross(arm, complex(0, LOAD)) / cross(arm, way)
    f = tension * way
    return f, f, f, -f - complex(0, LOAD), cross(b, f)


def pose_error(theta):
    """dx + i dy of C on the rocker."""
    def away(force):
        return -RADIAL * force / abs(force)

    f_a, f_b, f_c, f_d, couple = reactions(theta)
    turned = theta - math.copysign(ANGULAR, couple)
    b = CRANK * complex(math.cos(theta), math.sin(theta))
    nominal = apex(b, COUPLER, complex(BASE, 0), ROCKER)
    crank_end = away(f_a) + CRANK * complex(math.cos(turned), math.sin(turned))
    # The pin of C is displaced on the rocker: its centre on the coupler is where both links reach.
    rocker_base = BASE + away(f_d) - away(f_c)
    return apex(crank_end + away(f_b), COUPLER, rocker_base, ROCKER) + away(f_c) - nominal
