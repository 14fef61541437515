"""Draws the faces of the vesicle from the side by how much of the lipid CONE they have, in both leaflets."""

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt    # noqa: E402
from matplotlib.collections import PolyCollection    # noqa: E402


def last_rows(path, marker):
    lines = open(path).read().split("ITEM: TIMESTEP\n")[-1].split("\n")
    start = next(i for i, line in enumerate(lines) if line.startswith(marker)) + 1
    return [[float(word) for word in line.split()] for line in lines[start:] if line]


points = {int(row[0]): row[1:4] for row in last_rows("points.dump", "ITEM: ATOMS")}
figure, axes = plt.subplots(1, 2, figsize=(7, 4.5))
for axis, title, this, other in ((axes[0], "outer leaflet", 3, 5), (axes[1], "inner leaflet", 4, 6)):
    faces = []
    for row in last_rows("lipids.dump", "ITEM: ENTRIES"):
        corners = [points[int(i)] for i in row[:3]]
        if sum(corner[1] for corner in corners) < 0 and row[this] + row[other] > 0:
            faces.append(([(corner[0], corner[2]) for corner in corners], row[this] / (row[this] + row[other])))
    drawn = PolyCollection([face for face, _ in faces], array=[part for _, part in faces], cmap="coolwarm")
    drawn.set_clim(0, 1)
    axis.add_collection(drawn)
    axis.autoscale_view()
    axis.set_aspect("equal")
    axis.set_axis_off()
    axis.set_title(title)
figure.colorbar(drawn, ax=list(axes), label="part of CONE")
figure.savefig("sorting.png", dpi=100)
