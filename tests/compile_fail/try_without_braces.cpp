// expect: lekalo_tried_|was not declared|undeclared identifier
#include "lekalo/base/error.hpp"

lekalo::Result<int> one() { return 1; }

lekalo::Result<int> sum(bool more) {
  int value = 0;
#ifdef LEKALO_WRONG
  if (more) LEKALO_TRY(value, one());
#else
  if (more) {
    LEKALO_TRY(value, one());
  }
#endif
  return value;
}
