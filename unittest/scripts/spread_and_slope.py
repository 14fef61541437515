"""How far a series strays, and how it goes with another: the order of an energy's error, a drift."""

import math


def spread(values):
    """Standard deviation."""
    mean = sum(values) / len(values)
    return math.sqrt(sum((v - mean)**2 for v in values) / len(values))


def slope(xs, ys):
    """Of the straight line through points, least squares."""
    mx, my = sum(xs) / len(xs), sum(ys) / len(ys)
    return sum((x - mx) * (y - my) for x, y in zip(xs, ys)) / sum((x - mx)**2 for x in xs)


def order(steps, errors):
    """The power of the step that errors go as."""
    return slope([math.log(step) for step in steps], [math.log(error) for error in errors])
