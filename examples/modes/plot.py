#!/usr/bin/env python3
"""Powers of in.vesicle and correlations of in.solvent against theory: vesicle.txt, solvent.txt and, with matplotlib,
their pictures."""

import math
import os

KC, KT, ETA, DT = 20.0, 0.1, 10.0, 0.2
AREA = 16 * 13.856406460551018


def numbers(path):
    return [[float(word) for word in line.split()] for line in open(path) if line.strip() and line[0] not in "#"]


def vesicle():
    kinds = {name: numbers(name + ".txt") for name in ("full", "modes")}
    with open("vesicle.txt", "w") as out:
        out.write("l  power/theory, error: all control points;  modes 2 to 6\n")
        for full, modes in zip(kinds["full"], kinds["modes"]):
            out.write(f"{full[0]:.0f}  {full[4]:.4f} {full[5]:.4f}  {modes[4]:.4f} {modes[5]:.4f}\n")
    return kinds


def solvent():
    last = numbers("solvent.dat")
    rows = [row for row in last if len(row) > 3]
    curves = {}
    for k in range(3):
        q = 2 * math.pi * (k + 1) / 16
        power = KT / (AREA * KC * q ** 4)
        rate = KC * q ** 3 / (4 * ETA)
        curves[k + 1] = [(row[1] * DT, (row[3 + 2 * k] + row[4 + 2 * k]) / power, math.exp(-rate * row[1] * DT))
                         for row in rows]
    with open("solvent.txt", "w") as out:
        out.write("n  t  <h(t)h(0)>/theory(0)  theory\n")
        for n, curve in curves.items():
            for t, value, theory in curve:
                out.write(f"{n}  {t:.1f}  {value:.4f}  {theory:.4f}\n")
    return curves


kinds = vesicle() if os.path.exists("full.txt") else None
curves = solvent() if os.path.exists("solvent.dat") else None
try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
except ImportError:
    raise SystemExit(0)
if kinds:
    figure, axes = plt.subplots(figsize=(5, 3.6))
    for (name, rows), mark, shift in zip(kinds.items(), "os", (-0.05, 0.05)):
        axes.errorbar([row[0] + shift for row in rows], [row[4] for row in rows], [row[5] for row in rows], fmt=mark,
                      capsize=3, label={"full": "all control points", "modes": "modes 0 and 2 to 6"}[name])
    axes.axhline(1.0, color="gray", lw=1)
    axes.set(xlabel="l", ylabel="power / theory", ylim=(0.8, 1.2))
    axes.legend()
    figure.tight_layout()
    figure.savefig("vesicle.png", dpi=150)
if curves:
    figure, axes = plt.subplots(figsize=(5, 3.6))
    for n, curve in curves.items():
        points = axes.plot([t for t, _, _ in curve], [value for _, value, _ in curve], "o", ms=3, label=f"wave ({n}, 0)")
        axes.plot([t for t, _, _ in curve], [theory for _, _, theory in curve], color=points[0].get_color(), lw=1)
    axes.set(xlabel="t", ylabel="$\\langle h(t)\\,h(0)\\rangle$ / theory at 0", yscale="log", ylim=(0.02, 1.5))
    axes.legend()
    figure.tight_layout()
    figure.savefig("solvent.png", dpi=150)
