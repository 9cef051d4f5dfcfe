"""Runs programs in a LinuxCNC that stands ready (linuxcnc.sh), and prints the seconds of each.

They are counted in periods of the servo thread, by an integrator of 1, so that a busy machine counts the same.
"""

import sys
import time

import hal
import linuxcnc

command, status = linuxcnc.command(), linuxcnc.stat()
component = hal.component("watch")


def wait_until(holds, seconds):
    end = time.time() + seconds
    while time.time() < end:
        status.poll()
        if holds():
            return
        time.sleep(0.002)
    raise SystemExit(f"nothing happens in {seconds} s")


def is_idle():
    return status.interp_state == linuxcnc.INTERP_IDLE


def mode(wanted):
    command.mode(wanted)
    command.wait_complete()


command.state(linuxcnc.STATE_ESTOP_RESET)
command.wait_complete()
command.state(linuxcnc.STATE_ON)
wait_until(lambda: status.task_state == linuxcnc.STATE_ON, 10)
for program in sys.argv[1:]:
    mode(linuxcnc.MODE_MDI)
    for words in ("G21 G90 G0 Z0", "G0 X0 Y0"):
        command.mdi(words)
        command.wait_complete()
        wait_until(lambda: is_idle() and status.inpos, 60)
    mode(linuxcnc.MODE_AUTO)
    command.program_open(program)
    command.wait_complete()
    begin = hal.get_value("integ.0.out")
    command.auto(linuxcnc.AUTO_RUN, 0)
    wait_until(lambda: not is_idle(), 10)
    wait_until(is_idle, 3600)
    print(f"{hal.get_value('integ.0.out') - begin:.3f}", flush=True)
