#!/usr/bin/env python3
"""Where the lipid CONE is: a table by height, sorting.txt, and where there is matplotlib a picture, sorting.png."""


def last_rows(path, marker):
    lines = open(path).read().split("ITEM: TIMESTEP\n")[-1].split("\n")
    start = next(i for i, line in enumerate(lines) if line.startswith(marker)) + 1
    return [[float(word) for word in line.split()] for line in lines[start:] if line]


points = {int(row[0]): row[1:4] for row in last_rows("points.dump", "ITEM: ATOMS")}
faces = last_rows("lipids.dump", "ITEM: ENTRIES")    # corners, CONE outer and inner, PLUG outer and inner
top = max(point[2] for point in points.values())

with open("sorting.txt", "w") as table:
    table.write("height/top  part of CONE in the outer leaflet, in the inner one\n")
    for band in range(5):
        sums = [0.0] * 4
        for row in faces:
            height = abs(sum(points[int(i)][2] for i in row[:3])) / 3 / top
            if min(4, int(5 * height)) == band:
                sums = [a + b for a, b in zip(sums, row[3:])]
        table.write(f"{0.2 * band + 0.1:.1f}  {sums[0] / (sums[0] + sums[2]):.3f}  {sums[1] / (sums[1] + sums[3]):.3f}\n")

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.collections import PolyCollection
except ImportError:
    raise SystemExit(0)

figure, axes = plt.subplots(1, 2, figsize=(7, 4.5))
for axis, title, cone, plug in ((axes[0], "outer leaflet", 3, 5), (axes[1], "inner leaflet", 4, 6)):
    shapes, parts = [], []
    for row in faces:
        corners = [points[int(i)] for i in row[:3]]
        if sum(corner[1] for corner in corners) < 0 and row[cone] + row[plug] > 0:
            shapes.append([(corner[0], corner[2]) for corner in corners])
            parts.append(row[cone] / (row[cone] + row[plug]))
    drawn = PolyCollection(shapes, array=parts, cmap="coolwarm")
    drawn.set_clim(0, 1)
    axis.add_collection(drawn)
    axis.autoscale_view()
    axis.set_aspect("equal")
    axis.set_axis_off()
    axis.set_title(title)
figure.colorbar(drawn, ax=list(axes), label="part of CONE")
figure.savefig("sorting.png", dpi=100)
