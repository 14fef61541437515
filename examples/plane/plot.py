#!/usr/bin/env python3
"""The thermal spectrum that in.membrane wrote to spectrum.dat, beside theory: a table, spectrum.txt, and
where there is matplotlib a picture, spectrum.png."""

import math

kT, kc, area = 1e-3, 1.0, 16 * 8 * math.sqrt(3)
SURFACE = ((1, 0), (0.5, math.sqrt(0.75)), (-0.5, math.sqrt(0.75)))    # edges

# blocks of rows: index, nx, ny, q, |h_q|^2

blocks, missing = [], 0
for words in (line.split() for line in open("spectrum.dat") if not line.startswith("#")):
    if missing:
        blocks[-1].append([float(word) for word in words[1:]])
        missing -= 1
    else:
        blocks.append([])
        missing = int(words[1])

# waves of one |q| together; the error is from the scatter of the blocks

shells = {}
for i, (nx, ny, q, _) in enumerate(blocks[0]):
    shells.setdefault(round(q, 6), []).append(i)
table = []
for q, rows in sorted(shells.items()):
    means = [sum(block[i][3] for i in rows) / len(rows) for block in blocks]
    mean = sum(means) / len(means)
    error = math.sqrt(sum((m - mean) ** 2 for m in means) / (len(means) - 1) / len(means))
    table.append((q, len(rows), mean, error, kT / (area * kc * q ** 4)))

with open("spectrum.txt", "w") as file:
    file.write("   q h  waves  <|h_q|^2>      error     theory  ratio\n")
    for q, waves, mean, error, theory in table:
        file.write(f"{q:6.3f} {waves:6d} {mean:10.3e} {error:10.1e} {theory:10.3e} {mean / theory:6.3f} +- {error / theory:.3f}\n")
print(open("spectrum.txt").read(), end="")

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.ticker import NullFormatter, ScalarFormatter
except ImportError:
    print("no matplotlib: no picture")
    raise SystemExit
q, _, mean, error, theory = zip(*table)
figure, (above, below) = plt.subplots(2, 1, sharex=True, figsize=(6, 6), height_ratios=(3, 1))
above.loglog(q, theory, color="0.5", label=r"theory, $k_BT/(A k_c q^4)$")
above.errorbar(q, mean, error, fmt="o", markersize=4, color="C0", label="measured")
above.set_ylabel(r"$\langle |h_q|^2 \rangle$")
above.legend(frameon=False)
below.axhline(1.0, color="0.5")
below.errorbar(q, [m / t for m, t in zip(mean, theory)], [e / t for e, t in zip(error, theory)], fmt="o",
               markersize=4, color="C0")
below.set_xticks((0.4, 0.6, 0.8, 1.0, 1.5, 2.0, 2.5))
below.xaxis.set_major_formatter(ScalarFormatter())
below.xaxis.set_minor_formatter(NullFormatter())
below.set_xlabel("q h")
below.set_ylabel("ratio")
below.set_ylim(0.9, 1.1)
figure.tight_layout()
figure.savefig("spectrum.png", dpi=120)
print("spectrum.png")
