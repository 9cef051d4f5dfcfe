// Any bytes as a program. Where simulate and the rewriter both take it, its motions in the plane are, line by
// line, those of a third reader, which shares no code with either: what is simulated, what is rewritten and
// what is meant are one path.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>

#include "lekalo/nc/rewrite.hpp"
#include "require.hpp"
#include "support/rs274_reader.hpp"
#include "verify/pocket/nc_moves.hpp"

namespace {

using rs274::Real;

bool near(Real a, Real b) { return std::abs(a - b) <= 1e-6L * (1 + std::abs(a)); }

bool moves(const rs274::Step& step) { return step.arc || rs274::distance(step.from, step.to) > 1e-9L; }
bool moves(const lekalo::verify::Move& move) {
  return move.arc || std::hypot(move.from.x - move.to.x, move.from.y - move.to.y) > 1e-9;
}

void compare(const lekalo::verify::Move& move, const rs274::Step& step) {
  require(move.rapid == (step.code == 0) && move.arc == step.arc);
  require(near(move.from.x, step.from.x) && near(move.from.y, step.from.y));
  require(near(move.to.x, step.to.x) && near(move.to.y, step.to.y) && near(move.to_z, step.z));
  if (!move.arc) return;
  require(move.ccw == (step.code == 3));
  // A centre by radius loses half of its digits near the half circle.
  require(std::abs(move.centre.x - step.centre.x) <= 1e-4L * (1 + step.start_radius));
  require(std::abs(move.centre.y - step.centre.y) <= 1e-4L * (1 + step.start_radius));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string program(reinterpret_cast<const char*>(data), size);
  const auto read = lekalo::verify::read_moves({"f", program}, 0);
  if (!read) {
    require(read.error().code == lekalo::ErrorCode::bad_input && !read.error().message.empty());
    return 0;
  }
  if (!lekalo::nc::rewrite_program(program, "f", 1, 2, 0, {})) return 0;
  std::map<std::size_t, rs274::Step> meant;
  for (const rs274::Step& step : rs274::Reader().read(program))
    if (step.from_known && moves(step)) require(meant.emplace(step.line, step).second);
  std::size_t first = 0, last = 0, followed = 0;
  for (const auto& move : *read) {
    if (first == 0) first = move.line;
    last = move.line;
    if (!moves(move)) continue;
    const auto step = meant.find(move.line);
    require(step != meant.end());
    compare(move, step->second);
    ++followed;
  }
  for (const auto& [line, step] : meant) followed -= line >= first && line <= last ? 1 : 0;
  require(followed == 0);
  return 0;
}
