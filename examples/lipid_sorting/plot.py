#!/usr/bin/env python3
"""Where the lipids of in.sorting are, beside theory: a table by curvature, sorting.txt. Where there is matplotlib also pictures,
sorting.png and, after in.domains, domains.png.

A lipid of spontaneous curvature c and area a has the energy -kc/2 a c (2H - C/2) on a face of curvature 2H whose other lipids make
it like C: the outer leaflet's part, seen from its heads; in the inner one 2H and C change sign. So the numbers of CONE and PLUG on faces
of one curvature have the ratio exp(kc a c (2H - C/2)), and a constant factor; a bin of faces has the ratio of their means."""

import math
import os

KC, AREA, CURVATURE = 20.0, 0.65, 0.3
BINS, BLOCKS = 8, 10


def frames(path, marker):
    """Rows of numbers of each frame of a dump."""
    for text in open(path).read().split("ITEM: TIMESTEP\n")[1:]:
        lines = text.split("\n")
        start = next(i for i, line in enumerate(lines) if line.startswith(marker)) + 1
        yield sorted([float(word) for word in line.split()] for line in lines[start:] if line)    # LAMMPS sorts atoms as it likes


def points_of(path):
    return {int(row[0]): row[1:] for row in list(frames(path, "ITEM: ATOMS"))[-1]}


points = points_of("points.dump")
runs = list(frames("lipids.dump", "ITEM: ENTRIES"))
bend = [row[9] for row in runs[0]]    # 2H of a face
order = sorted(range(len(bend)), key=lambda f: bend[f])
place = {f: BINS * n // len(order) for n, f in enumerate(order)}
middle = [sum(bend[f] for f in order if place[f] == b) / sum(place[f] == b for f in order) for b in range(BINS)]


def counts(part):
    """[bin][kind], kinds CONE, FLAT, PLUG of the outer leaflet and of the inner one."""
    sums = [[0.0] * 6 for _ in range(BINS)]
    for rows in part:
        for f, row in enumerate(rows):
            for k in range(6):
                sums[place[f]][k] += row[3 + k]
    return sums


def ratios(part):
    """log(CONE/PLUG) of a leaflet by bin, less its mean; and what theory has for it."""
    sums, out = counts(part), []
    for first, sign in ((0, 1.0), (3, -1.0)):
        liking = [[CURVATURE * (s[k] - s[k + 2]) / sum(s[k:k + 3]) for k in (0, 3)] for s in sums]
        measured = [math.log(s[first] / s[first + 2]) for s in sums]
        theory = []
        for b, c in enumerate(liking):
            bends = [bend[f] for f in order if place[f] == b]
            lipids = sum(sums[b][first:first + 3]) / len(bends) / len(part)    # of a face; each feels the others
            seen = (1 - 1 / lipids) * c[first > 0] - c[first == 0]
            weights = [math.exp(KC / 2 * AREA * CURVATURE * (sign * H - seen / 2)) for H in bends]
            theory.append(math.log(sum(weights) / sum(1 / w for w in weights)))
        for row in (measured, theory):
            mean = sum(row) / BINS
            out.append([value - mean for value in row])
    return out


whole = ratios(runs)
blocks = [ratios(runs[len(runs) * b // BLOCKS:len(runs) * (b + 1) // BLOCKS]) for b in range(BLOCKS)]
error = [[math.sqrt(sum((block[q][b] - whole[q][b])**2 for block in blocks) / BLOCKS / (BLOCKS - 1)) for b in range(BINS)]
         for q in range(4)]
with open("sorting.txt", "w") as table:
    table.write("2H  outer leaflet: log(CONE/PLUG)  +-  theory   inner leaflet: log(CONE/PLUG)  +-  theory\n")
    for b in range(BINS):
        table.write(f"{middle[b]:.4f}  {whole[0][b]:7.3f} {error[0][b]:6.3f} {whole[1][b]:7.3f}   "
                    f"{whole[2][b]:7.3f} {error[2][b]:6.3f} {whole[3][b]:7.3f}\n")
print(open("sorting.txt").read(), end="")

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.collections import PolyCollection
except ImportError:
    raise SystemExit(0)


def draw(axis, shape, rows, values, x, y, limits):
    """The faces that look this way, seen along the axis that is neither x nor y, colored by value."""
    shapes, shown = [], []
    for row, value in zip(rows, values):
        corners = [shape[int(i)] for i in row[:3]]
        (ax, ay), (bx, by), (cx, cy) = ((c[x], c[y]) for c in corners)
        if (bx - ax) * (cy - ay) - (by - ay) * (cx - ax) > 0 and value is not None:
            shapes.append([(c[x], c[y]) for c in corners])
            shown.append(value)
    drawn = PolyCollection(shapes, array=shown, cmap="coolwarm", edgecolors="face", linewidths=0.3)
    drawn.set_clim(*limits)
    axis.add_collection(drawn)
    axis.autoscale_view()
    axis.set_aspect("equal")
    axis.set_axis_off()
    return drawn


figure, axes = plt.subplots(1, 3, figsize=(9, 4.2), layout="constrained", width_ratios=(2.2, 1, 1))
for q, name, color in ((0, "outer leaflet", "C0"), (2, "inner leaflet", "C3")):
    axes[0].errorbar(middle, whole[q], error[q], fmt="o", color=color, label=name)
    axes[0].plot(middle, whole[q + 1], color=color, label=r"$\pm\kappa a c\,(2H - C/2)/k_BT$")
axes[0].set(xlabel="2H (1/nm)", ylabel="log(CONE/PLUG) less its mean")
axes[0].legend(frameon=False)
for axis, title, first in ((axes[1], "outer", 3), (axes[2], "inner", 6)):
    sums = [[sum(rows[f][first + k] for rows in runs) for k in (0, 2)] for f in range(len(bend))]
    parts = [cone / (cone + plug) if cone + plug else None for cone, plug in sums]
    drawn = draw(axis, points, runs[0], parts, 0, 2, (0.1, 0.9))
    axis.set_title(title)
figure.colorbar(drawn, ax=list(axes[1:]), label="CONE of CONE and PLUG, mean over the run")
figure.savefig("sorting.png", dpi=110)

if os.path.exists("domains.dump"):
    shape = points_of("vesicle.dump")
    figure, axes = plt.subplots(1, 4, figsize=(10, 2.8), layout="constrained")
    history = list(frames("domains.dump", "ITEM: ENTRIES"))
    for axis, step in zip(axes, (0, 1, 4, 16)):
        parts = [row[3] / (row[3] + row[4]) for row in history[step]]
        drawn = draw(axis, shape, history[step], parts, 0, 1, (0, 1))
        axis.set_title(f"after {500 * step} steps")
    figure.colorbar(drawn, ax=list(axes), label="part of A in the outer leaflet")
    figure.savefig("domains.png", dpi=110)
