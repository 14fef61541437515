#!/usr/bin/env python3
"""What in.vesicle and in.buckle built, cut open: with matplotlib a picture, molecules.png. Prints how high the head groups
stand over the middle of the bilayer in the patch."""

CUTS = {"vesicle": (1, (-1e9, 0.0)), "buckle": (1, (30.0, 60.0))}    # axis that is cut, and what is shown of it, from the middle
COLORS = {("A", True): "#e08214", ("A", False): "#f3d9b1", ("B", True): "#2f7fb8", ("B", False): "#bcd7ea"}


def read_pdb(path):
    """Chains, names of beads, and places."""
    rows = [line for line in open(path) if line.startswith("ATOM")]
    return [(line[21], line[12:16].strip(), [float(line[30 + 8 * k:38 + 8 * k]) for k in range(3)]) for line in rows]


patch = [x[2] for _, name, x in read_pdb("patch.pdb") if name == "PO4"]
middle = sum(patch) / len(patch)
print(f"patch: phosphates {sum(abs(z - middle) for z in patch) / len(patch):.2f} Angstrom over the middle of the bilayer")

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
except ImportError:
    raise SystemExit("no picture: matplotlib is not installed")

figure, axes = plt.subplots(1, 2, figsize=(11, 5), gridspec_kw={"width_ratios": (1, 1.2)})
for axis, (name, (cut, (low, high))) in zip(axes, CUTS.items()):
    beads = read_pdb(name + ".pdb")
    center = [0.5 * (min(x[k] for _, _, x in beads) + max(x[k] for _, _, x in beads)) for k in range(3)]
    shown = [(x[cut] - center[cut], x[0], x[2], chain, bead) for chain, bead, x in beads if low < center[cut] - x[cut] < high]
    shown.sort(reverse=True)    # what is near comes last
    across = axis.get_window_extent().width / (max(row[1] for row in shown) - min(row[1] for row in shown) + 10)
    farthest = shown[0][0] - shown[-1][0]
    depth = [(shown[0][0] - row[0]) / farthest for row in shown]
    colors = [matplotlib.colors.to_rgb(COLORS[row[3], row[4] in ("NC3", "PO4")]) for row in shown]
    colors = [tuple(c * (0.35 + 0.65 * d) for c in color) for color, d in zip(colors, depth)]
    axis.scatter([row[1] for row in shown], [row[2] for row in shown], s=(4.2 * across * 72 / figure.dpi) ** 2, c=colors,
                 edgecolors="black", linewidths=0.15)
    axis.set_aspect("equal")
    axis.axis("off")
figure.tight_layout()
figure.savefig("molecules.png", dpi=100)
