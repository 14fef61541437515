#!/usr/bin/env python3
"""What in.membrane wrote, against theory: a table, tension.txt, and where there is matplotlib a picture, tension.png."""

import math

kT, kc, KA, NX, NY = 0.05, 1.0, 5.0, 24, 28
LX, LY = float(NX), NY * math.sqrt(0.75)
A0, TENSIONS = LX * LY, ("0.0", "0.05")


def moments(series, count=16):
    """Mean and variance, each with the error that the scatter of blocks has."""
    def mean_and_error(values):
        length = len(values) // count
        blocks = [sum(values[i * length:(i + 1) * length]) / length for i in range(count)]
        mean = sum(blocks) / count
        return mean, math.sqrt(sum((b - mean) ** 2 for b in blocks) / (count * (count - 1)))
    mean, error = mean_and_error(series)
    return mean, error, *mean_and_error([(x - mean) ** 2 for x in series])


def waves():
    """q^2 of the waves of the mesh, each the shortest of those that are the same at its points."""
    b = ((2 * math.pi, -2 * math.pi / math.sqrt(3)), (0.0, 4 * math.pi / math.sqrt(3)))
    for n in range(1, NX * NY):
        q = (2 * math.pi * (n % NX) / LX, 2 * math.pi * (n // NX) / LY)
        yield min((q[0] + i * b[0][0] + j * b[1][0]) ** 2 + (q[1] + i * b[0][1] + j * b[1][1]) ** 2
                  for i in range(-2, 3) for j in range(-2, 3))


lines, areas, spectra = ["tension of the frame        area      theory      variance  theory    excess        theory\n"], {}, {}
for tension in TENSIONS:
    s = float(tension)
    rows = [list(map(float, line.split())) for line in open(f"area.{tension}.dat") if not line.startswith("#")]
    membrane, frame = [row[1] for row in rows], [row[2] for row in rows]
    areas[tension] = frame
    mean, error, variance, scatter = moments(membrane)
    over, off, _, _ = moments([m - f for m, f in zip(membrane, frame)])
    excess = sum(0.5 * kT / (kc * square + s) for square in waves())
    lines.append(f"{s / kT:4.1f} kT/edge^2  {mean:10.3f} +- {error:.3f} {A0 * (1 + s / KA):9.3f} {variance:6.2f} +- {scatter:.2f} "
                 f"{kT * A0 / KA:6.2f} {over:8.3f} +- {off:.3f} {excess:7.3f}\n")
    spectra[tension] = [list(map(float, line.split())) for line in open(f"spectrum.{tension}.dat") if not line.startswith("#")]
    near = [row for row in spectra[tension] if row[0] < 1.0]
    weight = sum(row[5] ** -2 for row in near)
    lines.append(f"    powers of waves up to q = 1, over theory: {sum(row[4] / row[5] ** 2 for row in near) / weight:.3f} +- "
                 f"{weight ** -0.5:.3f}\n")
with open("tension.txt", "w") as file:
    file.writelines(lines)
print(open("tension.txt").read(), end="")

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
except ImportError:
    print("no matplotlib: no picture")
    raise SystemExit
figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.5))
for color, tension in zip(("C0", "C3"), TENSIONS):
    s, name = float(tension), rf"$\tau = {float(tension) / kT:.0f}\;k_BT/h^2$"
    left.hist(areas[tension], bins=30, density=True, color=color, alpha=0.5, label=name)
    excess = sum(0.5 * kT / (kc * square + s) for square in waves())
    middle, width = A0 * (1 + s / KA) - excess, math.sqrt(kT * A0 / KA)
    x = [middle + width * (i - 100) / 25 for i in range(201)]
    left.plot(x, [math.exp(-0.5 * ((a - middle) / width) ** 2) / width / math.sqrt(2 * math.pi) for a in x], color=color)
    rows = spectra[tension]
    right.errorbar([row[0] for row in rows], [row[2] for row in rows], [row[3] for row in rows], fmt="o", markersize=4,
                   color=color, label=name)
    q = [0.2 * 1.02 ** i for i in range(100)]
    right.loglog(q, [kT / (A0 * (kc * k ** 4 + s * k * k)) for k in q], color=color)
left.axvline(A0, color="0.5", linestyle=":")
left.set_xlabel("area of the frame (dotted: of the membrane at rest)")
left.set_ylabel("probability density")
left.legend(frameon=False)
right.set_xlabel("q h")
right.set_ylabel(r"$\langle |h_q|^2 \rangle$")
right.set_xlim(0.22, 1.3)
right.legend(frameon=False)
figure.suptitle(r"A sheet of 672 control points in a frame that gives way, $k_c = 20\,k_BT$; lines: theory", fontsize=10)
figure.tight_layout()
figure.savefig("tension.png", dpi=110)
print("tension.png")
