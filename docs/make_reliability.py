"""Make docs/images/reliability.png: how many named effects are there, by how sure of them verdicts were.

Counts are of benchmarks/blind/README.md: sealed seeds 48 to 51 of the second generation, cases of any kind.
"""

from io import BytesIO
from pathlib import Path

import matplotlib.pyplot as plt
from PIL import Image
from scipy.stats import binomtest

IMAGE = Path(__file__).parent / "images" / "reliability.png"
SEEDS = 48, 49, 50, 51
COUNTS = {  # told: from, to, (there, named) by seed
    "76 to 90 %": (0.76, 0.90, [(15, 18), (8, 11), (19, 24), (13, 14)]),
    "95 %": (0.95, 0.95, [(135, 142), (52, 54), (138, 147), (85, 87)]),
}

figure, axes = plt.subplots(figsize=(5.2, 4.2), dpi=110)
axes.plot([0.65, 1.0], [0.65, 1.0], color="0.6", linewidth=1, label="as told")
for label, (least, most, counts) in COUNTS.items():
    told, reach = (least + most) / 2, (most - least) / 2
    there, named = (sum(column) for column in zip(*counts, strict=True))
    low, high = binomtest(there, named).proportion_ci(method="wilson")
    away = [[there / named - low], [high - there / named]]
    axes.errorbar(told, there / named, away, reach, fmt="o", color="tab:blue", capsize=4, markersize=7)
    axes.annotate(
        f"told {label}:\n{there} of {named} there",
        (told, low),
        (-8, -28),
        textcoords="offset points",
        ha="right",
    )
    axes.plot([told] * len(SEEDS), [k / n for k, n in counts], "_", color="0.35", markersize=12)
    print(label, there, named, f"{there / named:.3f} ({low:.3f} to {high:.3f})")
axes.plot([], [], "o", color="tab:blue", label="all, with 95 % interval")
axes.plot([], [], "_", color="0.35", label="each of four sealed seeds")
axes.set(
    xlim=(0.65, 1.0),
    ylim=(0.5, 1.02),
    xlabel="confidence told",
    ylabel="share of named effects that are there",
)
axes.legend(loc="lower right")
figure.tight_layout()
drawn = BytesIO()
figure.savefig(drawn)
picture = Image.open(drawn).convert("RGB").quantize(64)
picture.save(IMAGE, optimize=True)
