#!/usr/bin/env python3
"""covered.py MESH OURS.png THEIRS.png: the share of the other program's ink within 2 px of ours, as a line of JSON."""
import json
import sys

import numpy as np
from PIL import Image
from scipy.ndimage import distance_transform_edt


def ink(path):
    picture = Image.open(path).convert("RGBA")
    paper = Image.new("RGBA", picture.size, "white")
    paper.alpha_composite(picture)
    return np.asarray(paper.convert("L")) < 128


def main():
    mesh, ours, theirs = sys.argv[1], ink(sys.argv[2]), ink(sys.argv[3])
    far = distance_transform_edt(~ours)[theirs] > 2 if ours.any() else np.ones(theirs.sum(), bool)
    print(json.dumps(dict(mesh=mesh, ink_px=int(theirs.sum()), uncovered_px=int(far.sum()))))


if __name__ == "__main__":
    main()
