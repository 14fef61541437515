"""Mean powers of modes from blocks of a run, and claims that they are those of theory."""

import math
from statistics import NormalDist

from lammps_claims import claim

BLOCKS, EVERY = 32, 10    # of a run; steps from sample to sample


def block_length(steps, blocks=BLOCKS):
    """Steps of a block, a multiple of EVERY, for about so many steps in all."""
    return steps // (blocks * EVERY) * EVERY


def averages(path):
    """Blocks of a fix ave/time file, mode vector: each a list with a value for each row."""
    blocks, missing = [], 0
    with open(path) as file:
        for words in (line.split() for line in file if not line.startswith("#")):
            if missing:
                blocks[-1].append(float(words[1]))
                missing -= 1
            else:
                blocks.append([])
                missing = int(words[1])
    return blocks


def mean_and_error(values):
    mean = sum(values) / len(values)
    return mean, math.sqrt(sum((v - mean) ** 2 for v in values) / (len(values) - 1) / len(values))


def chi_squared_limit(n):
    """What 99 % of sums of n squared normal numbers are below (Wilson and Hilferty)."""
    z = NormalDist().inv_cdf(0.99)
    return n * (1 - 2 / (9 * n) + z * math.sqrt(2 / (9 * n))) ** 3


def compare(text, spectrum, precision=0.01):
    """Claims about {mode: (mean, error)} of the ratio of measured to expected powers; prints all. precision: what the
    standard error of all together must be below."""
    n = len(spectrum)
    deviation = {key: (mean - 1) / error for key, (mean, error) in spectrum.items()}
    for key, (mean, error) in spectrum.items():
        print(f"       {key}: {mean:.4f} +- {error:.4f}, {deviation[key]:+.2f} standard errors")
    worst = max(map(abs, deviation.values()))
    squares = sum(d * d for d in deviation.values())
    outside = sum(abs(d) > 2 for d in deviation.values())
    limit = NormalDist().inv_cdf(0.5 + 0.5 * 0.99 ** (1 / n))
    weight = sum(error ** -2 for _, error in spectrum.values())
    mean = sum(mean / error ** 2 for mean, error in spectrum.values()) / weight
    claim(f"{text}: {n} groups of modes have the powers of theory", worst < limit and squares < chi_squared_limit(n),
          f"largest deviation {worst:.2f} standard errors (limit {limit:.2f}), {outside} beyond 2, "
          f"chi^2 {squares:.1f} (limit {chi_squared_limit(n):.1f})")
    claim(f"{text}: all together", abs(mean - 1) < 2.6 * weight ** -0.5 and weight ** -0.5 < precision,
          f"{mean:.4f} +- {weight ** -0.5:.4f} of theory")


def agree(text, one, other):
    """Claims that two spectra are the same."""
    n, squares = len(one), 0.0
    for key in one:
        (a, da), (b, db) = one[key], other[key]
        squares += (a - b) ** 2 / (da * da + db * db)
    claim(f"{text} agree", squares < chi_squared_limit(n), f"chi^2 {squares:.1f} of {n} (limit {chi_squared_limit(n):.1f})")
