#!/usr/bin/env python3
"""A sphere as others simulate vesicles, with valences at random:

  bench/random_valences.py LEVEL FILE [--six 0.57] [--seed 1]

An icosphere of 10*4^LEVEL + 2 points of which random edges are flipped, until a share SIX of its points is left with
valence 6 (from 0.2 on), and none has fewer than 4 or more than 11; then points move to the middle of their neighbours
and on to the sphere, a few times, and each coordinate by a random number of a twentieth of an edge. Writes an OFF file."""

import argparse
import math
import os
import random
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "unittest", "scripts"))
from membrane_scenes import write_off    # noqa: E402

LEAST, MOST = 4, 11    # valences
ROUNDS, NOISE = 10, 0.05
TRIES = 100    # an edge


def unit(p):
    length = math.sqrt(sum(x * x for x in p))
    return [x / length for x in p]


def icosphere(level):
    golden = 0.5 * (1.0 + math.sqrt(5.0))
    points = [unit(p) for a in (-1.0, 1.0) for b in (-golden, golden) for p in ((a, b, 0.0), (0.0, a, b), (b, 0.0, a))]

    def is_near(i, j):
        return sum((a - b) ** 2 for a, b in zip(points[i], points[j])) < 1.5

    faces = []
    for i in range(12):
        for j in range(i + 1, 12):
            for k in range(j + 1, 12):
                if is_near(i, j) and is_near(j, k) and is_near(k, i):
                    (a, b, c), p, q = points[i], points[j], points[k]
                    volume = (a * (p[1] * q[2] - p[2] * q[1]) + b * (p[2] * q[0] - p[0] * q[2]) + c * (p[0] * q[1] - p[1] * q[0]))
                    faces.append((i, j, k) if volume > 0.0 else (i, k, j))
    for _ in range(level):
        middles, finer = {}, []

        def middle(i, j):
            key = (min(i, j), max(i, j))
            if key not in middles:
                middles[key] = len(points)
                points.append(unit([a + b for a, b in zip(points[i], points[j])]))
            return middles[key]

        for a, b, c in faces:
            x, y, z = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, x, z), (b, y, x), (c, z, y), (x, y, z)]
        faces = finer
    return points, faces


def flip_edges(num_points, faces, six, random):
    """Faces of the same points after random flips."""
    beyond = {}    # the third corner of the face to the left of each directed edge
    for a, b, c in faces:
        beyond[a, b], beyond[b, c], beyond[c, a] = c, a, b
    valence = [0] * num_points
    for a, _ in beyond:
        valence[a] += 1
    sixes = valence.count(6)
    edges = [(a, b) for a, b in beyond if a < b]
    for _ in range(TRIES * len(edges)):
        if sixes <= six * num_points:
            break
        i = random.randrange(len(edges))
        a, b = edges[i]
        c, d = beyond[a, b], beyond[b, a]
        if (c, d) in beyond or min(valence[a], valence[b]) == LEAST or max(valence[c], valence[d]) == MOST:
            continue
        for edge in ((a, b), (b, a)):
            del beyond[edge]
        beyond[d, c], beyond[c, d] = a, b
        beyond[c, a], beyond[a, d] = d, c
        beyond[d, b], beyond[b, c] = c, d
        edges[i] = (c, d)
        for vertex, change in ((a, -1), (b, -1), (c, 1), (d, 1)):
            sixes -= valence[vertex] == 6
            valence[vertex] += change
            sixes += valence[vertex] == 6
    else:
        sys.exit(f"random flips do not leave as few as {six} of the points with valence 6")
    return [(a, b, c) for (a, b), c in beyond.items() if a < b and a < c]


def random_valences(level, six=0.57, seed=1):
    """Points and faces."""
    numbers = random.Random(seed)
    points, faces = icosphere(level)
    faces = flip_edges(len(points), faces, six, numbers)
    for _ in range(ROUNDS):
        sums = [[0.0, 0.0, 0.0] for _ in points]
        for face in faces:
            for i in range(3):
                for k in range(3):
                    sums[face[i]][k] += points[face[i - 1]][k]
        points = [unit(s) for s in sums]
    edge = math.sqrt(4.0 * math.pi / len(points))
    return [[x + numbers.gauss(0.0, NOISE * edge) for x in p] for p in points], faces


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("level", type=int)
    parser.add_argument("file")
    parser.add_argument("--six", type=float, default=0.57)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    write_off(options.file, *random_valences(options.level, options.six, options.seed))


if __name__ == "__main__":
    main()
