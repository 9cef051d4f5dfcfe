// Certificates for solids against tests/support/check_solid_certificate.py, which shares nothing with verify
// and works with fractions alone: both say the same, of true ones and of changed ones.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "support/cases.hpp"
#include "support/places.hpp"
#include "support/solid_proofs.hpp"

namespace lekalo::verify_solid_certificate_test {
namespace {

using cases::Json;
using cases::SolidResultFiles;
using cases::TermKind;

std::string written(const std::string& name, const std::string& text) {
  const std::string path = testing::TempDir() + "verify_solid_certificate_" + name;
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

/// What the stranger says of each.
std::vector<std::string> opinions(const std::vector<SolidResultFiles>& all) {
  std::string list;
  for (std::size_t k = 0; k < all.size(); ++k)
    list += fmt::format("{} {} {} -\n", written(fmt::format("part{}.stl", k), all[k].part),
                        written(fmt::format("blank{}.stl", k), all[k].blank),
                        written(fmt::format("result{}.json", k), all[k].result.dump()));
  FILE* pipe = popen(fmt::format("python3 {}/tests/support/check_solid_certificate.py {}",
                                 cases::source_dir(), written("list", list))
                         .c_str(),
                     "r");
  if (pipe == nullptr) return {};
  std::vector<std::string> lines(1);
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) {
    if (c == '\n')
      lines.emplace_back();
    else
      lines.back() += static_cast<char>(c);
  }
  pclose(pipe);
  lines.pop_back();
  return lines;
}

TEST(SolidCertificate, AStrangerSaysTheSame) {
  Random random(8);
  std::vector<SolidResultFiles> all;
  const char* const freedoms[]{"xyz", "c-xyz", "six"};
  for (const TermKind kind : {TermKind::plane, TermKind::ball, TermKind::face, TermKind::part_face,
                              TermKind::any, TermKind::edges}) {
    const char* const freedom = freedoms[random.below(3)];
    const std::size_t depth = random.below(2);
    const SolidResultFiles honest = kind == TermKind::edges
                                        ? cases::edges_proof(random, freedom, depth).files
                                        : cases::solid_proof(random, kind, freedom, depth).files;
    EXPECT_EQ(honest.told(), "confirmed") << static_cast<int>(kind);
    all.push_back(honest);
    for (std::uint64_t k = 0; k < cases::case_count(4); ++k) {
      SolidResultFiles other = honest;
      Json& certificate = other.result["certificate"];
      // What the window needs of the root is not the stranger's business.
      const char* const tables[]{"part_balls", "blank_balls", "planes"};
      const std::size_t which = random.below(5);
      if (which < 3 && !certificate[tables[which]].empty())
        certificate[tables[which]] = changed(certificate[tables[which]], random);
      else
        certificate["trees"][0]["nodes"] = changed(certificate["trees"][0]["nodes"], random);
      if (k % 3 == 0) {
        const double clearance = other.result["clearance"], bound = other.result["upper_bound"];
        other.result["upper_bound"] = clearance + (bound - clearance) * random.uniform(0, 0.2);
        other.result["gap"] = double(other.result["upper_bound"]) - clearance;
      }
      // A row, a node or a term that is none is refused; what the stranger would make of it does not matter.
      if (other.report()) all.push_back(other);
    }
  }
  const std::vector<std::string> said = opinions(all);
  ASSERT_EQ(said.size(), all.size()) << "check_solid_certificate.py ended early; is python3 there?";
  std::size_t proved = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const std::string told = all[k].told();
    EXPECT_EQ(told == "confirmed", said[k] == "proved")
        << k << ": " << told << "\n the stranger: " << said[k];
    proved += said[k] == "proved" ? 1 : 0;
  }
  EXPECT_GT(proved, all.size() / 5);
  EXPECT_LT(proved, all.size() * 4 / 5);
}

}  // namespace
}  // namespace lekalo::verify_solid_certificate_test
