"""What the process that workers are forked from imports: all that they need is loaded and has run there once, so each
of them is ready when it starts.
"""

import gc
import signal
from contextlib import suppress

signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the service, which ends this process
gc.disable()  # to look through what is loaded takes a tenth of the time
from service.worker.jobs import warm_logic, warm_planning  # noqa: E402

with suppress(Exception):  # each worker tries it again, and says what is wrong
    warm_logic()
    warm_planning()
gc.freeze()  # what is shared with the workers stays so: they need not look through it
gc.enable()
