#!/usr/bin/env python3
"""The spectrum that in.membrane wrote to spectrum.dat, beside theory, and fitted for bending modulus and tension: a
table, spectrum.txt, and where there is matplotlib a picture, spectrum.png."""

import math

kT, kc, s = 0.05, 1.0, 0.0

# blocks of rows: index, l, m, u_lm^2

blocks, missing = [], 0
for words in (line.split() for line in open("spectrum.dat") if not line.startswith("#")):
    if missing:
        blocks[-1].append([float(word) for word in words[1:]])
        missing -= 1
    else:
        blocks.append([])
        missing = int(words[1])

# all m of one l together; the error is from the scatter of the blocks

degrees = range(2, int(blocks[0][-1][0]) + 1)
powers = [{l: sum(row[2] for row in block if row[0] == l) / (2 * l + 1) for l in degrees} for block in blocks]


def mean_of(chosen):
    return {l: sum(power[l] for power in chosen) / len(chosen) for l in degrees}


def theory(l, kc, s):
    return kT / (kc * (l - 1) * (l + 2) * (l * (l + 1) + s))


mean = mean_of(powers)
error = {l: math.sqrt(sum((p[l] - mean[l]) ** 2 for p in powers) / (len(powers) - 1) / len(powers)) for l in degrees}


def fit(power):
    """kc and tension, by least squares: kT/[(l-1)(l+2) <u^2>] = kc l(l+1) + sigma R^2."""
    x = [l * (l + 1) for l in degrees]
    y = [kT / ((l - 1) * (l + 2) * power[l]) for l in degrees]
    w = [(mean[l] / error[l] / value) ** 2 for l, value in zip(degrees, y)]
    total = sum(w)
    mx, my = sum(a * b for a, b in zip(w, x)) / total, sum(a * b for a, b in zip(w, y)) / total
    slope = sum(c * (a - mx) * (b - my) for a, b, c in zip(x, y, w)) / sum(c * (a - mx) ** 2 for a, c in zip(x, w))
    return slope, my - slope * mx


# errors of the fit: leave out one block after the other

fitted = fit(mean)
others = [fit(mean_of(powers[:i] + powers[i + 1:])) for i in range(len(powers))]
fit_error = [math.sqrt((len(others) - 1) * sum((o[k] - fitted[k]) ** 2 for o in others) / len(others)) for k in (0, 1)]
table = [(l, mean[l], error[l], theory(l, kc, s)) for l in degrees]

with open("spectrum.txt", "w") as file:
    file.write(" l   <u_lm^2>      error     theory  ratio\n")
    for l, power, off, expected in table:
        file.write(f"{l:2d} {power:10.3e} {off:10.1e} {expected:10.3e} {power / expected:6.3f} +- {off / expected:.3f}\n")
    for name, value, off in zip(("kc", "tension"), fitted, fit_error):
        file.write(f"fitted {name}: {value:.3f} +- {off:.3f}\n")
print(open("spectrum.txt").read(), end="")

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.ticker import NullFormatter, ScalarFormatter
except ImportError:
    print("no matplotlib: no picture")
    raise SystemExit
degree, mean, error, theory = zip(*table)
figure, (above, below) = plt.subplots(2, 1, sharex=True, figsize=(6, 6), height_ratios=(3, 1))
above.loglog(degree, theory, color="0.5", label=r"theory, $k_BT/[k_c (l-1)(l+2)(l(l+1)+s)]$")
above.errorbar(degree, mean, error, fmt="o", markersize=4, color="C0", label="measured")
above.set_ylabel(r"$\langle u_{lm}^2 \rangle$")
above.legend(frameon=False)
below.axhline(1.0, color="0.5")
below.errorbar(degree, [m / t for m, t in zip(mean, theory)], [e / t for e, t in zip(error, theory)], fmt="o",
               markersize=4, color="C0")
below.set_xticks(degree)
below.xaxis.set_major_formatter(ScalarFormatter())
below.xaxis.set_minor_formatter(NullFormatter())
below.set_xlabel("l")
below.set_ylabel("ratio")
below.set_ylim(0.9, 1.1)
figure.tight_layout()
figure.savefig("spectrum.png", dpi=120)
print("spectrum.png")
