// expect: could not convert|no viable conversion
#include "lekalo/geom/pose.hpp"

using lekalo::geom::BlankFrame;
using lekalo::geom::PartFrame;
using lekalo::geom::Pose;

#ifdef LEKALO_WRONG
using Named = Pose<BlankFrame, PartFrame>;
#else
using Named = Pose<PartFrame, BlankFrame>;
#endif

Named part_from_blank(const Pose<BlankFrame, PartFrame>& blank_from_part) {
  return blank_from_part.inverse();
}
