"""Vectors in space, as lists of three numbers."""

import math


def minus(a, b):
    return [p - q for p, q in zip(a, b)]


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dihedral(a, b, c, d):
    axis = minus(c, b)
    m, n = cross(axis, minus(a, b)), cross(axis, minus(d, c))
    return math.atan2(dot(axis, cross(m, n)), math.sqrt(dot(axis, axis)) * dot(m, n))
