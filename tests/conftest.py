"""What all tests share: small programs compile sooner than they are optimised."""

import os

os.environ.setdefault("CFLAGS", "-O0")
