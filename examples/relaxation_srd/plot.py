#!/usr/bin/env python3
"""Relaxation in plane.dat and vesicle.dat, those of the two that are there, beside theory: a table, plane.txt and
vesicle.txt, and where there is matplotlib a picture, plane.png and vesicle.png."""

import math
import os

eta = 27.5258    # as fix srd/mesh prints it


def plane():
    q, L, kc = 2 * math.pi / 16, 16.0, 45.0
    images = (math.sinh(q * L) + q * L) / (math.cosh(q * L) - 1)
    return "h", [(kc * q ** 3 / (4 * eta) * images, r"$\tau = 4\eta/(k_c q^3)$, periodic images")]


def vesicle():
    R, kc = 5.0, 60.0
    rate = 24 * kc / (eta * R ** 3)
    return "u", [(rate * 4 / 35 * 1.039, r"$\Gamma_2 = 4/35$ (area free to flow), periodic images"),
                 (rate * 6 / 55 * 1.039, r"$\Gamma_2 = 6/55$ (area that is not), the same"),
                 (rate * 2 / 25 * 1.039, r"$\Gamma_2 = 2/25$ (no flow in the surface), the same")]


for name, (symbol, theories) in (("plane", plane()), ("vesicle", vesicle())):
    if not os.path.exists(name + ".dat"):
        continue
    runs = {}
    for line in open(name + ".dat"):
        words = line.split()
        if words and words[0] != "#":
            runs.setdefault(int(words[0]), []).append([float(word) for word in words[1:3]])
    # what is left of the start at time t is the mean of y(t) y(0), which thermal motion at the start does not
    # bias. Rate by least squares; all errors are from leaving out one run at a time

    runs = list(runs.values())
    n, times = len(runs), [t for t, y in runs[0]]

    def left(chosen):
        square = sum(run[0][1] ** 2 for run in chosen)
        return [sum(run[k][1] * run[0][1] for run in chosen) / square for k in range(len(times))]

    def rate_of(means):
        low, high = 0.0, 3 * theories[0][0]
        for _ in range(60):
            a, b = low + 0.382 * (high - low), low + 0.618 * (high - low)
            badness = [sum((y - math.exp(-x * t)) ** 2 for t, y in zip(times, means)) for x in (a, b)]
            low, high = (low, b) if badness[0] < badness[1] else (a, high)
        return (low + high) / 2

    def jackknife(values, x):
        return math.sqrt((n - 1) / n * sum((value - x) ** 2 for value in values))

    means, others = left(runs), [left(runs[:i] + runs[i + 1:]) for i in range(n)]
    x = rate_of(means)
    error = jackknife(map(rate_of, others), x)
    table = [(t, means[k], jackknife([other[k] for other in others], means[k]),
              *(math.exp(-rate * t) for rate, _ in theories)) for k, t in enumerate(times)]
    text = (f"rate {x:.4f} +- {error:.4f}, theory {theories[0][0]:.4f}, ratio {x / theories[0][0]:.3f} +- "
            f"{error / theories[0][0]:.3f}")
    with open(name + ".txt", "w") as file:
        file.write(f"# {text}\n#      t  {symbol}/{symbol}(0)    error   theory\n")
        for row in table:
            file.write(f"{row[0]:8.2f} {row[1]:8.4f} {row[2]:8.4f} {row[3]:8.4f}\n")
    print(name + ":", text)

    try:
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
    except ImportError:
        print("no matplotlib: no picture")
        continue
    columns = list(zip(*table))
    figure, axes = plt.subplots(figsize=(6, 4.2))
    for i, run in enumerate(runs):
        axes.plot(times, [y / run[0][1] for t, y in run], color="0.85", linewidth=0.8,
                  label=None if i else "single runs")
    for (rate, label), style, y in zip(theories, ("-", "--", ":"), columns[3:]):
        axes.plot(columns[0], y, style, color="0.3", label=label)
    axes.errorbar(columns[0], columns[1], columns[2], fmt="o", markersize=4, color="C0", label=f"mean of {n} runs")
    axes.axhline(0, color="0.7", linewidth=0.5)
    axes.set_xlabel("time")
    axes.set_ylabel(f"${symbol}(t)/{symbol}(0)$")
    axes.set_ylim(-0.15 if len(theories) == 1 else -0.4, 1.1)
    axes.legend(frameon=False, fontsize=9)
    figure.tight_layout()
    figure.savefig(name + ".png", dpi=120)
    print(name + ".png")
