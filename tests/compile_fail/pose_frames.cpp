// expect: no match for 'operator\*'|invalid operands to binary expression
#include "lekalo/geom/pose.hpp"

using lekalo::geom::BlankFrame;
using lekalo::geom::MachineFrame;
using lekalo::geom::PartFrame;
using lekalo::geom::Pose;

Pose<MachineFrame, PartFrame> chain(const Pose<MachineFrame, BlankFrame>& machine_from_blank,
                                    const Pose<BlankFrame, PartFrame>& blank_from_part) {
#ifdef LEKALO_WRONG
  return blank_from_part * machine_from_blank;
#else
  return machine_from_blank * blank_from_part;
#endif
}
