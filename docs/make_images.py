"""Make docs/images: the pictures of `inertance demo`, in few colours and so in few bytes."""

import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from PIL import Image

IMAGES = Path(__file__).parent / "images"

with TemporaryDirectory() as folder:
    subprocess.run([sys.executable, "-m", "inertance", "demo", "--out", folder], check=True)
    for picture in Path(folder).glob("*.png"):
        Image.open(picture).convert("RGB").quantize(64).save(IMAGES / picture.name, optimize=True)
