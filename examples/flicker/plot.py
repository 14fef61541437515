#!/usr/bin/env python3
"""The spectrum that in.membrane wrote to spectrum.dat, beside theory: a table, spectrum.txt, and where
there is matplotlib a picture, spectrum.png."""

import math

kT, kc, s = 0.002, 1.0, 0.05

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

table = []
for l in range(2, int(blocks[0][-1][0]) + 1):
    means = [sum(row[2] for row in block if row[0] == l) / (2 * l + 1) for block in blocks]
    mean = sum(means) / len(means)
    error = math.sqrt(sum((m - mean) ** 2 for m in means) / (len(means) - 1) / len(means))
    table.append((l, mean, error, kT / (kc * (l - 1) * (l + 2) * (l * (l + 1) + s))))

with open("spectrum.txt", "w") as file:
    file.write(" l   <u_lm^2>      error     theory  ratio\n")
    for l, mean, error, theory in table:
        file.write(f"{l:2d} {mean:10.3e} {error:10.1e} {theory:10.3e} {mean / theory:6.3f} +- {error / theory:.3f}\n")
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
