#!/usr/bin/env python3
"""How directions of the proteins of in.bound decay in time, from proteins.dump: a table, decay.txt, with the coefficients of
diffusion that fit it, and where there is matplotlib a picture, decay.png."""

import math

D, damp, every = 0.1, 0.4, 1.0    # of free diffusion; damping time of momenta; time between two frames
KINDS = {"tracers": "3", "proteins": "2"}
P = {1: lambda c: c, 2: lambda c: 1.5 * c * c - 0.5}
LAGS = {1: range(4, 61, 8), 2: range(2, 25, 3)}
BLOCKS = 8

# directions from the middle of the control points, and the mean of 1/r^2, frame by frame

frames, inverse = {kind: [] for kind in KINDS}, []
lines = iter(open("proteins.dump"))
for line in lines:
    if line.startswith("ITEM: NUMBER OF ATOMS"):
        number = int(next(lines))
    if not line.startswith("ITEM: ATOMS"):
        continue
    rows = [next(lines).split()[1:] for _ in range(number)]
    atoms = {kind: [[float(x) for x in row[1:]] for row in rows if row[0] == kind] for kind in "123"}
    middle = [sum(x) / len(x) for x in zip(*atoms["1"])]
    for kind, type_ in KINDS.items():
        ways = [[x - m for x, m in zip(row, middle)] for row in atoms[type_]]
        lengths = [math.sqrt(sum(x * x for x in way)) for way in ways]
        frames[kind].append([[x / r for x in way] for way, r in zip(ways, lengths)])
        inverse += [1 / r**2 for r in lengths]
inverse = sum(inverse) / len(inverse)


def diffused(t):
    """The time that mean squares of displacements are in proportion to: at first particles keep their thermal velocity."""
    return t - damp * (1 - math.exp(-t / damp))


def free(l, t):
    return math.exp(-l * (l + 1) * D * diffused(t) * inverse)


def decay(units, l, lag):
    """<P_l> between frames that are lag apart, over all atoms and times."""
    values = [P[l](sum(x * y for x, y in zip(a, b)))
              for first, second in zip(units, units[lag:]) for a, b in zip(first, second)]
    return sum(values) / len(values)


def fitted(means):
    """D by least squares of the logarithms, each with the weight of its square: early times have the smallest errors."""
    points = [(diffused(t), m) for t, m in means if m > 0]
    return sum(m * m * t * -math.log(m) for t, m in points) / sum(m * m * t * t for t, m in points) / inverse


# errors are from the scatter of groups of atoms

results, table = {}, []
for kind in KINDS:
    for l in P:
        means = [(lag * every, decay(frames[kind], l, lag)) for lag in LAGS[l] if lag < len(frames[kind]) // 2]
        groups = []
        for block in range(BLOCKS):
            part = [frame[block::BLOCKS] for frame in frames[kind]]
            groups.append(fitted([(lag * every, decay(part, l, lag)) for lag in LAGS[l] if lag < len(part) // 2]) / (l * (l + 1)))
        value = fitted(means) / (l * (l + 1))
        error = math.sqrt(sum((g - sum(groups) / BLOCKS)**2 for g in groups) / BLOCKS / (BLOCKS - 1))
        results[kind, l] = value, error, means
        table += [(kind, l, t, m, free(l, t)) for t, m in means]

with open("decay.txt", "w") as file:
    file.write("atoms     l      t    <P_l>   free\n")
    for kind, l, t, mean, expected in table:
        file.write(f"{kind:8s} {l:2d} {t:6.1f} {mean:8.4f} {expected:6.4f}\n")
    for (kind, l), (value, error, _) in results.items():
        file.write(f"fitted {kind:8s} l = {l}: D = {value:.4f} +- {error:.4f}, {value / D:.3f} of free diffusion\n")
print(open("decay.txt").read(), end="")

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
except ImportError:
    print("no matplotlib: no picture")
    raise SystemExit
figure, axes = plt.subplots(figsize=(6, 4.5))
for (kind, l), (value, _, means) in results.items():
    times = [t for t, _ in means]
    color, marker = f"C{2 if kind == 'tracers' else 1}", "o" if l == 1 else "s"
    axes.semilogy(times, [m for _, m in means], marker, color=color, markersize=5,
                  label=f"{kind}, $l = {l}$: $D$ = {value:.3f}")
for l, lags in LAGS.items():
    times = [0.5 * k for k in range(2 * max(lags) + 1)]
    axes.semilogy(times, [free(l, t) for t in times], color="0.5", zorder=0,
                  label=f"free, $D$ = {D}" if l == 1 else None)
axes.set_xlabel("t")
axes.set_ylabel(r"$\langle P_l(\cos\theta) \rangle$")
axes.set_ylim(0.15, 1.05)
axes.legend(frameon=False, loc="lower left")
figure.tight_layout()
figure.savefig("decay.png", dpi=120)
print("decay.png")
