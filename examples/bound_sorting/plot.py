#!/usr/bin/env python3
"""Where the proteins of in.sorting are along a wave of the support, from proteins.dump: a table, sorting.txt, and where there is
matplotlib a picture, sorting.png. Theory is the mean of exp(-E/kT) over the probes in the same place."""

import math

L, BINS, BLOCKS = 15.0, 12, 8            # the length of a wave
a, kc, c0p = 1.0, 20.0, 0.3             # footprint 2 of in.sorting: E = -a kc c0p 2H and a constant
KINDS = {2: "coats", 3: "crescents", 4: "probes"}

frames = []
with open("proteins.dump") as file:
    for line in file:
        if line.startswith("ITEM: NUMBER OF ATOMS"):
            number = int(next(file))
        if line.startswith("ITEM: ATOMS"):
            frames.append([[float(word) for word in next(file).split()[1:]] for _ in range(number)])


def place(x):
    return int(BINS * (x / L % 1.0)) % BINS


def densities(part):
    """By kind and place: density over the mean one of the kind; of theory; and cos^2 of the angle of crescents to x."""
    count = {kind: [0] * BINS for kind in KINDS}
    weight, along = [0.0] * BINS, [0.0] * BINS
    for frame in part:
        for kind, x, _, _, c, tx, _, _ in frame:
            k, kind = place(x), int(kind)
            count[kind][k] += 1
            weight[k] += math.exp(a * kc * c0p * c) if kind == 4 else 0.0
            along[k] += tx * tx if kind == 3 else 0.0
    out = {name: [n * BINS / sum(count[kind]) for n in count[kind]] for kind, name in KINDS.items()}
    out["theory"] = [w * BINS / sum(weight) for w in weight]
    out["across"] = [s / n if n else 0.5 for s, n in zip(along, count[3])]
    return out


whole = densities(frames)
blocks = [densities(frames[len(frames) * b // BLOCKS:len(frames) * (b + 1) // BLOCKS]) for b in range(BLOCKS)]
error = {key: [math.sqrt(sum((block[key][k] - whole[key][k])**2 for block in blocks) / BLOCKS / (BLOCKS - 1)) for k in range(BINS)]
         for key in whole}

with open("sorting.txt", "w") as file:
    file.write("     x   coats   +-     theory  +-    crescents  +-   cos^2 of their angle to the wave   probes\n")
    for k in range(BINS):
        file.write(f"{(k + 0.5) * L / BINS:6.3f}  {whole['coats'][k]:6.3f} {error['coats'][k]:6.3f}  {whole['theory'][k]:6.3f} "
                   f"{error['theory'][k]:6.3f}   {whole['crescents'][k]:6.3f} {error['crescents'][k]:6.3f}   {whole['across'][k]:6.3f}"
                   f"   {whole['probes'][k]:6.3f}\n")
    crest = range(BINS // 2)
    sides = [(sum(part[key][k] for k in crest) / sum(part[key][k] for k in range(BINS) if k not in crest))
             for key in ("coats", "theory") for part in [whole]]
    scatter = [math.sqrt(sum((math.log(sum(b[key][k] for k in crest) / max(sum(b[key][k] for k in range(BINS) if k not in crest), 0.02)) -
                              math.log(side))**2 for b in blocks) / BLOCKS / (BLOCKS - 1)) * side
               for key, side in zip(("coats", "theory"), sides)]
    file.write(f"crests over troughs: coats {sides[0]:.2f} +- {scatter[0]:.2f}, theory {sides[1]:.2f} +- {scatter[1]:.2f}\n")
print(open("sorting.txt").read(), end="")

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
except ImportError:
    print("no matplotlib: no picture")
    raise SystemExit
figure, axes = plt.subplots(figsize=(6, 4.5))
x = [(k + 0.5) * L / BINS for k in range(BINS)]
axes.fill_between([0.1 * k for k in range(151)], [1 + 0.6 * math.sin(2 * math.pi * 0.1 * k / L) for k in range(151)], color="0.92",
                  label="the support")
axes.errorbar(x, whole["coats"], error["coats"], fmt="o", color="C1", label="coats")
axes.plot(x, whole["theory"], color="C1", label=r"$\langle e^{-E/kT} \rangle$ of the probes")
axes.errorbar(x, whole["crescents"], error["crescents"], fmt="s", color="C2", label="crescents")
axes.plot(x, whole["probes"], ".", color="0.4", label="probes")
axes.set_xlabel("x")
axes.set_ylabel("density over its mean")
axes.set_xlim(0, L)
axes.set_ylim(0, None)
axes.legend(frameon=False)
figure.tight_layout()
figure.savefig("sorting.png", dpi=120)
print("sorting.png")
