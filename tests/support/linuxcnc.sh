#!/usr/bin/env bash
# LinuxCNC itself, task and motion, as a test oracle of time: it runs programs on a simulated machine without a
# display. It comes from where rs274.sh unpacks it, and stands in the place of /usr in namespaces of its own, so that
# nothing is installed and nothing of it is left.
#
#   linuxcnc.sh FOLDER SPEED ACCELERATION PROGRAM...
#
# prints a line for each program: its seconds, counted in periods of the servo thread. SPEED, mm/s, and ACCELERATION,
# mm/s^2, hold for each axis; FOLDER is scratch space.
set -euo pipefail

here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)

fail() {
  printf 'linuxcnc.sh: %s\n' "$1" >&2
  exit 5
}

axis() { # NUMBER NAME SPEED ACCELERATION
  printf '[AXIS_%s]\nMIN_LIMIT = -10000\nMAX_LIMIT = 10000\nMAX_VELOCITY = %s\nMAX_ACCELERATION = %s\n' "$2" "$3" "$4"
  printf '[JOINT_%s]\nTYPE = LINEAR\nMIN_LIMIT = -10000\nMAX_LIMIT = 10000\nMAX_VELOCITY = %s\n' "$1" "$3"
  printf 'MAX_ACCELERATION = %s\nFERROR = 100\nMIN_FERROR = 100\nHOME_SEARCH_VEL = 0\nHOME_LATCH_VEL = 0\nHOME_SEQUENCE = 0\n' "$4"
}

configure() { # FOLDER SPEED ACCELERATION
  {
    printf '[EMC]\nMACHINE = lekalo\nDEBUG = 0\nVERSION = 1.1\n[DISPLAY]\nDISPLAY = none\n'
    printf '[TASK]\nTASK = milltask\nCYCLE_TIME = 0.001\n[RS274NGC]\nPARAMETER_FILE = machine.var\n'
    printf '[EMCMOT]\nEMCMOT = motmod\nCOMM_TIMEOUT = 4.0\nSERVO_PERIOD = 1000000\n'
    printf '[EMCIO]\nEMCIO = io\nCYCLE_TIME = 0.050\nTOOL_TABLE = tool.tbl\n'
    printf '[TRAJ]\nAXES = 3\nCOORDINATES = X Y Z\nLINEAR_UNITS = mm\nANGULAR_UNITS = degree\nNO_FORCE_HOMING = 1\n'
    # Each axis has its limit; along the way there is none.
    printf 'DEFAULT_LINEAR_VELOCITY = %s\nMAX_LINEAR_VELOCITY = 100000\n' "$2"
    printf 'DEFAULT_LINEAR_ACCELERATION = %s\nMAX_LINEAR_ACCELERATION = 1000000\n' "$3"
    printf '[KINS]\nKINEMATICS = trivkins\nJOINTS = 3\n'
    axis 0 X "$2" "$3"
    axis 1 Y "$2" "$3"
    axis 2 Z "$2" "$3"
  } >"$1/machine.ini"
  printf '%s\n' 'loadrt trivkins' 'loadrt tpmod' 'loadrt homemod' \
    'loadrt motmod servo_period_nsec=1000000 num_joints=3' 'loadrt integ' \
    'addf motion-command-handler servo-thread' 'addf motion-controller servo-thread' \
    'addf integ.0 servo-thread' 'setp integ.0.in 1' \
    'net x joint.0.motor-pos-cmd => joint.0.motor-pos-fb' 'net y joint.1.motor-pos-cmd => joint.1.motor-pos-fb' \
    'net z joint.2.motor-pos-cmd => joint.2.motor-pos-fb' \
    'net estop iocontrol.0.user-enable-out => iocontrol.0.emc-enable-in' >"$1/machine.hal"
  : >"$1/machine.var"
  printf 'T1 P1 D1 Z0\n' >"$1/tool.tbl"
}

# The second half of the script, in the namespaces.
inside() { # ROOT FOLDER PROGRAM...
  local root=$1 folder=$2
  shift 2
  mount --make-rprivate /
  mount -t overlay overlay -o "lowerdir=$root/usr:/usr" /usr || fail "the kernel lays no folder over /usr here"
  LD_LIBRARY_PATH=$(printf '%s:' /usr/lib /usr/lib/linuxcnc "$root"/lib/*-linux-gnu)
  export LD_LIBRARY_PATH HOME=$folder RTAPI_UID=65534 RTAPI_FIFO_PATH=$folder/fifo
  cd "$folder"
  linuxcncsvr -ini machine.ini >server.log 2>&1 &
  sleep 0.5
  {
    halcmd loadusr -Wn iocontrol io -ini machine.ini
    halcmd -i machine.ini -f machine.hal
    halcmd start
    halcmd loadusr -Wn inihal milltask -ini machine.ini
  } >start.log 2>&1 </dev/null || fail "LinuxCNC does not start; see $folder/start.log"
  /usr/bin/python3 -B "$here/linuxcnc_time.py" "$@" 2>run.log || fail "LinuxCNC does not run; see $folder/run.log"
}

if [ "${1-}" = inside ]; then
  shift
  inside "$@"
  exit
fi
[ $# -ge 4 ] || fail "it takes FOLDER, SPEED, ACCELERATION and programs"
folder=$1 speed=$2 acceleration=$3
shift 3
root=$("$here/rs274.sh" prepare)
configure "$folder" "$speed" "$acceleration"
user=(--map-current-user --keep-caps)
if [ "$(id -u)" = 0 ]; then
  user=()
  chmod a+rwx "$folder" # what runs in real time is another user's there
fi
exec unshare "${user[@]}" --mount --ipc --pid --net --fork --kill-child "$0" inside "$root" "$folder" "$@" </dev/null
