"""Waves exp(i q.r) of control points on the infinite regular lattice of edge 1, kc = 1 and one mass per
area: what the limit surface makes of them, their bending energy and their mass. Exact sums, for tests to
compare simulations with.

The second derivative of the box spline along an edge is the second difference of the piecewise bilinear
function on the two other edges, and the Laplacian is 2/3 of the sum of those along the three edges.
"""

import math

EDGES = ((1.0, 0.0), (0.5, math.sqrt(0.75)), (-0.5, math.sqrt(0.75)))
A1, A2 = 0.445948490915965, 0.091576213509771
W1, W2 = 0.223381589678011, 0.109951743655322
POINTS = {1: ((1 / 3, 1 / 3, 1.0),),
          3: ((1 / 6, 1 / 6, 1 / 3), (1 / 6, 2 / 3, 1 / 3), (2 / 3, 1 / 6, 1 / 3)),
          6: tuple((u, v, w) for a, w in ((A1, W1), (A2, W2))
                   for u, v in ((a, a), (a, 1 - 2 * a), (1 - 2 * a, a)))}


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1]


def bilinear(q, j, k, s, t):
    """At s e_j + t e_k of what is exp(i q.r) on the lattice."""
    i, m = math.floor(s), math.floor(t)
    total = 0.0
    for di, wi in ((0, 1 - s + i), (1, s - i)):
        for dm, wm in ((0, 1 - t + m), (1, t - m)):
            phase = (i + di) * dot(q, EDGES[j]) + (m + dm) * dot(q, EDGES[k])
            total += wi * wm * complex(math.cos(phase), math.sin(phase))
    return total


def stiffness(q, rule):
    """Mean square Laplacian over the points of an upright and a reversed face: K(q)."""
    factor = [-8 / 3 * math.sin(0.5 * dot(q, e)) ** 2 for e in EDGES]
    total = 0.0
    for u, v, weight in POINTS[rule]:
        for s, t in ((u, v), (1 - u, 1 - v)):    # of s e_1 + t e_2, with e_2 = e_1 + e_3
            laplacian = (factor[0] * bilinear(q, 1, 2, s + t, -s) +
                         factor[1] * bilinear(q, 0, 2, s + t, t) +
                         factor[2] * bilinear(q, 0, 1, s, t))
            total += 0.5 * weight * abs(laplacian) ** 2
    return total


def surface(q, edges=EDGES):
    """S(q): the wave of wave vector q in the limit surface. The Fourier transform of the box spline is the
    product of those of its six directions, each edge twice; waves q + a reciprocal lattice vector come with it."""
    product = 1.0
    for e in edges:
        x = 0.5 * dot(q, e)
        product *= (math.sin(x) / x) ** 2 if abs(x) > 1e-12 else 1.0
    return product


def thermal_factor(q, rule=6):
    """<|h_q|^2> of the limit surface over kT/(A kc q^4): a wave c exp(i q.r) of control points has the
    energy A kc K |c|^2 together with its conjugate, so <|c|^2> = kT/(A kc K), and h_q = S c."""
    return dot(q, q) ** 2 * surface(q) ** 2 / stiffness(q, rule)


def inertia(q, mass):
    if mass == "lumped":
        return 1.0
    if mass == "vertex":
        return (0.5 + sum(math.cos(dot(q, e)) for e in EDGES) / 6) ** 2
    row = {0: 1979 / 7560, 1: 18871 / 181440, 3: 85 / 6048, 4: 31 / 6480, 7: 17 / 181440, 9: 1 / 181440}
    total = 0.0
    for i in range(-3, 4):
        for k in range(-3, 4):
            shell = i * i + i * k + k * k    # squared length of i e_1 + k e_2
            total += row.get(shell, 0.0) * math.cos(i * dot(q, EDGES[0]) + k * dot(q, EDGES[1]))
    return total
