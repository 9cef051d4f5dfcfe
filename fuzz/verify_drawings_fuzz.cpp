// Any bytes into the checker's readers of drawings, scans, exports and profile programs, chosen by the first
// byte. Each gives numbers that are in order, or one sentence, and the same ones again.

#include <cstdint>
#include <string>
#include <string_view>

#include "require.hpp"
#include "verify/drawn/drawn_file.hpp"
#include "verify/origin/drawing.hpp"
#include "verify/origin/scan_points.hpp"
#include "verify/origin/tree.hpp"
#include "verify/profile/profile_moves.hpp"
#include "verify/read/json.hpp"

namespace {

using namespace lekalo;
using namespace lekalo::verify;

void check_sentence(const Error& error) {
  require(error.code == ErrorCode::bad_input && !error.message.empty() && error.message.size() < 2000);
  require(error.message.find('\n') == std::string::npos);
}

/// \param read  reads the bytes; its answer has a size
template <class Read, class Size>
void check_twice(const Read& read, const Size& size) {
  const auto found = read(), again = read();
  require(found.has_value() == again.has_value());
  if (!found) {
    check_sentence(found.error());
    require(found.error().message == again.error().message);
    return;
  }
  require(size(*found) == size(*again));
}

constexpr auto kCurves = [](const ReadDrawing& drawing) { return drawing.curves.size(); };
constexpr auto kLines = [](const DrawnFile& file) { return file.lines.size() + file.texts.size(); };

void try_tree(std::string_view bytes) {
  const auto value = parse_json(bytes, "tree.json");
  if (!value) return check_sentence(value.error());
  if (!value->is_object()) return;
  Json shape;
  for (JsonItems items(*value); const auto item = items.next();)
    if (items.key() == "shape") shape = *item;
  std::string complaint;
  const Tree tree = read_tree(shape, LengthUnit::millimetre, complaint);
  if (!complaint.empty()) return require(complaint.size() < 2000);
  require(!tree.nodes.empty());
  for (std::size_t i = 0; i < tree.nodes.size(); ++i)
    for (const std::size_t child : tree.nodes[i].children) require(child < i);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0] % 9) {
    case 0:
      check_twice([&] { return read_dxf_drawing({"d.dxf", bytes}, LengthUnit::inch, 0.01); }, kCurves);
      break;
    case 1:
      check_twice([&] { return read_svg_drawing({"d.svg", bytes}, Fraction{1}, 0.01); }, kCurves);
      break;
    case 2:
    case 3: {
      const std::string name = data[0] % 9 == 2 ? "s.xyz" : "s.ply";
      const std::optional<Slice> slice =
          data[0] % 2 == 0 ? std::nullopt : std::optional(Slice{Decimal{1, 0}, Decimal{5, -1}});
      check_twice(
          [&] {
            return read_scan_points({name, bytes}, LengthUnit::millimetre, slice);
          },
          [](const MeasuredPoints& points) { return points.at.size(); });
      break;
    }
    case 4:
      check_twice([&] { return read_dxf({"e.dxf", bytes}); }, kLines);
      break;
    case 5:
      check_twice([&] { return read_svg({"e.svg", bytes}); }, kLines);
      break;
    case 6:
      check_twice([&] { return read_hpgl({"e.plt", bytes}); }, kLines);
      break;
    case 7:
      check_twice(
          [&] {
            return read_profile({"p.ngc", bytes}, words::Control::linuxcnc);
          },
          [](const ProfileProgram& read) { return read.chains.size(); });
      break;
    default:
      try_tree(bytes);
  }
  return 0;
}
