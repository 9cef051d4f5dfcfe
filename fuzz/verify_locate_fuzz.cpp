// Two ways into verify_locate, chosen by the first byte:
//   odd: the rest is result, part, blank and certificate, cut at zero bytes; the next byte chooses the
//   contour formats.
//        Whatever they are, there is a report or one sentence.
//   even: edits of a true result, three bytes each (place, new byte). Whatever is still confirmed must be
//   true: the
//        clearance by a recomputation in long double, the bound by the known optimum.

#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "support/verify_cases.hpp"

namespace {

using namespace lekalo;
using namespace lekalo::verify_cases;

void demand(bool condition) {
  if (!condition) std::abort();
}

void check_report(const Result<verify::LocateReport>& report) {
  if (!report) {
    demand(report.error().code == ErrorCode::bad_input);
    demand(!report.error().message.empty() && report.error().message.size() < 1000);
    return;
  }
  demand((report->verdict == verify::Verdict::refuted) == !report->findings.empty());
  // A solid that is not in its blank, or is not read, has no clearance.
  demand(report->clearance_low.empty() == report->clearance_high.empty());
  demand(report->verdict != verify::Verdict::confirmed ||
         (!report->bound_high.empty() && report->intervals > 0));
}

void try_documents(std::string_view text) {
  constexpr std::string_view kEndings[]{".csv", ".json", ".dxf", ".xyz"};
  const unsigned choice = text.empty() ? 0U : static_cast<unsigned char>(text[0]);
  text.remove_prefix(text.empty() ? 0 : 1);
  std::string_view pieces[5];
  for (std::string_view& piece : pieces) {
    const std::size_t end = std::min(text.find('\0'), text.size());
    piece = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  verify::LocateInputs inputs{{"result.json", pieces[0]},
                              {"part" + std::string(kEndings[choice % 4]), pieces[1]},
                              {"blank" + std::string(kEndings[choice / 4 % 4]), pieces[2]},
                              {}};
  if (!pieces[3].empty()) inputs.certificate = {"certificate.json", pieces[3]};
  if (!pieces[4].empty()) inputs.features = {"features.json", pieces[4]};
  check_report(verify::verify_locate(inputs));
}

void try_edits(const std::uint8_t* data, std::size_t size) {
  static const Case c = examples()[0];
  static const Files files = write(c, solve(c, 0, 6.283185307179587, 1e-3L));
  static const std::string honest = files.result();
  std::string result = honest;
  for (std::size_t i = 0; i + 3 <= size && i < 30; i += 3) {
    result[(data[i] * 256U + data[i + 1]) % result.size()] = static_cast<char>(data[i + 2] % 128);
  }
  const auto report = verify::verify_locate(
      {{"result.json", result}, {"part.json", files.part}, {"blank.json", files.blank}, {}});
  check_report(report);
  if (!report || report->verdict == verify::Verdict::refuted) return;
  const nlohmann::json json = nlohmann::json::parse(result, nullptr, false);
  demand(!json.is_discarded());
  const auto number = [&json](const char* key) { return json.at(key).get<double>(); };
  const Real exact = clearance_at(c.blank, c.part, number("x"), number("y"), number("theta"));
  demand(number("clearance") <= exact + 1e-12L * (1 + std::abs(exact)));
  const double from = json.at("window_deg").at(0), to = json.at("window_deg").at(1);
  if (report->verdict == verify::Verdict::confirmed && to - from >= 360) {
    demand(number("upper_bound") >= c.optimum - 1e-9);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  if (data[0] % 2 == 1) {
    try_documents({reinterpret_cast<const char*>(data) + 1, size - 1});
  } else {
    try_edits(data + 1, size - 1);
  }
  return 0;
}
