#!/usr/bin/env python3
"""The spectrum that in.membrane wrote to spectrum.dat, fitted for bending modulus and tension: a table, spectrum.txt, and where
there is matplotlib a picture, spectrum.png."""

import math

kT, kc = 0.05, 1.0
rows = [list(map(float, line.split())) for line in open("spectrum.dat") if not line.startswith("#")]
degree, power, error = [int(row[0]) for row in rows], [row[2] for row in rows], [row[3] for row in rows]

# kT/[(l-1)(l+2) <u^2>] = kc l(l+1) + sigma R^2, a line: least squares, with the errors that go with those of the powers

x = [l * (l + 1) for l in degree]
y = [kT / ((l - 1) * (l + 2) * p) for l, p in zip(degree, power)]
weight = [(p / e / value) ** 2 for p, e, value in zip(power, error, y)]
total = sum(weight)
mx, my = sum(w * a for w, a in zip(weight, x)) / total, sum(w * b for w, b in zip(weight, y)) / total
spread = sum(w * (a - mx) ** 2 for w, a in zip(weight, x))
slope = sum(w * (a - mx) * (b - my) for w, a, b in zip(weight, x, y)) / spread
fitted = (("kc", slope, spread ** -0.5), ("tension", my - slope * mx, math.sqrt(1 / total + mx * mx / spread)))

with open("spectrum.txt", "w") as file:
    file.write(" l   <u_lm^2>      error  ratio to theory\n")
    for l, (_, _, p, e, ratio, off, _) in zip(degree, rows):
        file.write(f"{l:2d} {p:10.3e} {e:10.1e} {ratio:6.3f} +- {off:.3f}\n")
    for name, value, off in fitted:
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
figure, (above, below) = plt.subplots(2, 1, sharex=True, figsize=(6, 6), height_ratios=(3, 1))
theory = [kT / (kc * (l - 1) * (l + 2) * l * (l + 1)) for l in degree]
above.loglog(degree, theory, color="0.5", label=r"theory, $k_BT/[k_c (l-1)(l+2)\,l(l+1)]$")
above.errorbar(degree, power, error, fmt="o", markersize=4, color="C0", label="measured")
above.set_ylabel(r"$\langle u_{lm}^2 \rangle$")
above.set_title(r"642 control points, $k_c = 20\,k_BT$: "
                rf"fitted $k_c = {fitted[0][1] / kT:.2f} \pm {fitted[0][2] / kT:.2f}\;k_BT$", fontsize=10)
above.legend(frameon=False)
below.axhline(1.0, color="0.5")
below.errorbar(degree, [row[4] for row in rows], [row[5] for row in rows], fmt="o", markersize=4, color="C0")
below.set_xticks(degree)
below.xaxis.set_major_formatter(ScalarFormatter())
below.xaxis.set_minor_formatter(NullFormatter())
below.set_xlabel("l")
below.set_ylabel("over theory")
below.set_ylim(0.9, 1.1)
figure.tight_layout()
figure.savefig("spectrum.png", dpi=120)
print("spectrum.png")
