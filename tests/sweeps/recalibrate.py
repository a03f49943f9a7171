#!/usr/bin/env python3
"""By what Laplace's band must be multiplied to hold whole outlines as often as it says, and whether that carries over to families that
were left out. Conformal: of n worlds, the band that the ceil(p (n + 1))th narrowest one needs (Vovk, Gammerman and Shafer 2005).

usage: recalibrate.py ROWS.csv...        the rows that experiment coverage keeps; needs Python 3 and nothing else
For the constant in src/certainty/edge_band.cpp, which the result multiplies:
  for kind in shape parts profile; do palpate experiment coverage --world $kind --trials 10 --first-seed 21000 \\
    --set certainty=laplace --out $kind; done; recalibrate.py {shape,parts,profile}/rows.csv
Worlds with a part that was not found are left out: no band around the others holds it, and what may hide is said elsewhere.
"""

import collections
import csv
import math
import sys

PROBABILITY = 0.95


def factor(needed):
    return sorted(needed)[min(math.ceil(PROBABILITY * (len(needed) + 1)), len(needed)) - 1]


def main():
    needed = collections.defaultdict(list)
    for path in sys.argv[1:]:
        with open(path, encoding="utf-8", newline="") as table:
            for row in csv.DictReader(table):
                if row["missed_parts"] == "0" and row["lost"] == "0":
                    needed[row["family"]].append(float(row["needed_width"]))
    if len(needed) < 2:
        sys.exit(__doc__)
    together = sum(needed.values(), [])
    print(f"{len(together)} worlds of {len(needed)} families: times {factor(together):.2f}; as it is {sum(one <= 1 for one in together)} are held")
    held_in_all = 0
    for family, its_own in needed.items():
        without = factor(sum((others for name, others in needed.items() if name != family), []))
        held = sum(one <= without for one in its_own)
        held_in_all += held
        print(f"  without {family}: times {without:.2f}, which holds {held} of its {len(its_own)}")
    print(f"families left out in turn: {held_in_all} of {len(together)} held")


if __name__ == "__main__":
    main()
