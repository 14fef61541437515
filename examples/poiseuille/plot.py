#!/usr/bin/env python3
"""The flow that in.poiseuille wrote, beside the parabola without a vesicle: a table, flow.txt, and where there is
matplotlib a picture, flow.png, with sections through the vesicle."""

import glob
import math

H, M, g, dt, eta = map(float, open("flow.dat").read().split())
FIRST = 1    # blocks of the profile until there is a flow

# blocks of rows: bin, its middle, atoms, velocity

blocks, missing = [], 0
for words in (line.split() for line in open("profile.dat") if not line.startswith("#")):
    if missing:
        blocks[-1].append((float(words[1]), float(words[3])))
        missing -= 1
    else:
        blocks.append([])
        missing = int(words[1])
blocks = blocks[FIRST:]
carried = [float(line.split()[1]) for line in open("vesicle.dat") if not line.startswith("#")][FIRST:]


def mean_and_error(values):
    mean = sum(values) / len(values)
    return mean, math.sqrt(sum((v - mean) ** 2 for v in values) / max(1, len(values) - 1) / len(values))


def parabola(z):
    return M * g / (2 * eta) * (H * H - z * z)


table = [(z, *mean_and_error([block[i][1] for block in blocks])) for i, (z, _) in enumerate(blocks[0])]
speed, error = mean_and_error(carried)
flow, without = (sum(values) / len(table) for values in ([v for _, v, _ in table], [parabola(z) for z, _, _ in table]))
with open("flow.txt", "w") as file:
    file.write("     z        v   error  without vesicle\n")
    for z, v, e in table:
        file.write(f"{z:6.2f} {v:8.4f} {e:7.4f} {parabola(z):8.4f}\n")
    file.write(f"vesicle {speed:.4f} +- {error:.4f}, mean of solvent {flow:.4f}, without vesicle {without:.4f}\n")
print(open("flow.txt").read(), end="")

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.collections import LineCollection
except ImportError:
    print("no matplotlib: no picture")
    raise SystemExit


def section(path):
    """Segments in which the plane y = centroid cuts the surface, x from the centroid on."""
    words = open(path).read().split()
    n, m = int(words[1]), int(words[2])
    points = [tuple(map(float, words[4 + 3 * i:7 + 3 * i])) for i in range(n)]
    faces = [tuple(map(int, words[5 + 3 * n + 4 * f:8 + 3 * n + 4 * f])) for f in range(m)]
    x0, y0 = (sum(p[k] for p in points) / n for k in (0, 1))
    segments = []
    for face in faces:
        ends = []
        for a, b in zip(face, face[1:] + face[:1]):
            a, b = points[a], points[b]
            if (a[1] < y0) != (b[1] < y0):
                s = (y0 - a[1]) / (b[1] - a[1])
                ends.append((a[0] + s * (b[0] - a[0]) - x0, a[2] + s * (b[2] - a[2])))
        if len(ends) == 2:
            segments.append(ends)
    return segments


shapes = sorted((int(path.split(".")[1]), path) for path in glob.glob("shape.*.off"))
figure, (left, right) = plt.subplots(1, 2, sharey=True, figsize=(12, 3.1), width_ratios=(1, 3.2))
height = [H * (i / 50 - 1) for i in range(101)]
left.plot([parabola(z) for z in height], height, color="0.5", label="without vesicle")
left.errorbar([v for _, v, _ in table], [z for z, _, _ in table], xerr=[e for _, _, e in table], fmt="o", markersize=3,
              color="C0", label="solvent")
left.axvline(speed, color="C3", linestyle="--", linewidth=1, label="vesicle")
left.set_xlabel("velocity")
left.set_ylabel("z")
left.set_xlim(0, 1.15 * parabola(0))
left.legend(frameon=False, loc="center left", fontsize=8)
step = 7.0    # from one vesicle to the next
for i, (when, path) in enumerate(shapes):
    right.add_collection(LineCollection([[(x + i * step, z) for x, z in ends] for ends in section(path)], color="C3",
                                        linewidth=1.3))
    right.text(i * step, -H + 0.3, f"{when * dt:g}", ha="center", fontsize=9)
right.text(-0.8 * step, -H + 0.3, "time", ha="center", fontsize=9)
right.annotate("", (-0.55 * step, 0), (-1.05 * step, 0), arrowprops=dict(arrowstyle="->", color="C0"))
right.text(-0.8 * step, 0.3, "flow", ha="center", color="C0", fontsize=9)
for axes in (left, right):
    for wall in (-H, H):
        axes.axhspan(wall, wall * 1.08, color="0.75", linewidth=0)
right.set_xlim(-1.2 * step, (len(shapes) - 0.4) * step)
right.tick_params(left=False)
right.set_ylim(-1.08 * H, 1.08 * H)
right.set_aspect("equal")
right.set_xticks([])
figure.tight_layout()
figure.savefig("flow.png", dpi=120)
print("flow.png")
