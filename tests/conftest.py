"""What all tests share: they run alike however, and wherever, they were started."""

import os
import signal

os.environ.setdefault("CFLAGS", "-O0")  # small programs compile sooner than they are optimised
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # of two processes on two cores, threads only queue
os.environ["MPLBACKEND"] = "Agg"
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:  # as in the background, for all processes begun there
    signal.signal(signal.SIGINT, signal.default_int_handler)
