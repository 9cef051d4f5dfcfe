#include "fit_command.hpp"

#include <fmt/core.h>

#include <cmath>

#include "interrupt.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/jobs/fit.hpp"
#include "outputs.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

/// In um with its sign; what rounds to nothing has a plus.
std::string grown(const fit::Growth& growth) {
  return fmt::format("{:+.2f}", std::round(1e5 * growth.diameter) / 100 + 0.0);
}

std::string case_row(const jobs::FitCase& one) {
  const fit::Pressed& p = one.pressed;
  const fit::RingGrowth& shaft = p.rings.front();
  const std::vector<fit::Growth>& outside = p.rings.back().outer;
  const std::string at_ends =
      outside.front().z < 0
          ? fmt::format("{} and {} at its left and right end", grown(outside.front()), grown(outside.back()))
          : grown(outside.back()) + " at its end";
  const std::string bore = shaft.inner.empty() ? ""
                                               : fmt::format(", bore closes by {:.2f}",
                                                             -1000 * fit::in_middle(shaft.inner).diameter);
  const std::string din =
      one.din ? fmt::format("{:.1f} MPa, {:.2f} um", one.din->pressure_mpa, 1000 * one.din->hub_outer_growth)
              : std::string("does not hold here");
  return fmt::format(
      "{:g} um: {}, pressure {:.1f} MPa ({:.1f} in the middle)\n"
      "  diameters, um        {} outside {} in the middle and {}, shaft {}{}\n"
      "  after taking apart   hub's bore {}, outside {}\n"
      "  DIN 7190             {}\n",
      1000 * one.interference, fit::name_of(p.state), p.seats.front().pressure_mpa,
      p.seats.front().middle_mpa, p.rings.size() > 2 ? "the outermost ring's" : "hub's",
      grown(fit::in_middle(outside)), at_ends, grown(fit::in_middle(shaft.outer)), bore,
      grown(fit::in_middle(one.released.rings[1].inner)),
      grown(fit::in_middle(one.released.rings.back().outer)), din);
}

std::string words_of(const jobs::FitJob& job, const jobs::Fitted& made) {
  std::string text;
  for (const jobs::FitCase& one : made.cases) {
    text += case_row(one);
    const double force = one.pressed.seats.front().force_n;
    if (job.friction)
      text += fmt::format("  force of pressing    {:.1f} to {:.1f} kN\n", (*job.friction)[0] * force / 1000,
                          (*job.friction)[1] * force / 1000);
    const auto shrink = job.clearance_um ? fit::shrink_difference(made.assembly.rings[1], one.interference,
                                                                  *job.clearance_um / 1000)
                                         : std::nullopt;
    if (shrink) text += fmt::format("  hub warmer by        {:.0f} K\n", *shrink);
  }
  if (made.corrected) {
    text += fmt::format("Turned for the mean interference, the {} varies by\n",
                        fit::name_of(made.corrected->surface));
    for (std::size_t i = 0; i < made.cases.size(); ++i)
      text += fmt::format("  {:.2f} um instead of {:.2f} at {:g} um\n",
                          1000 * made.corrected->variations[i].after,
                          1000 * made.corrected->variations[i].before, 1000 * made.cases[i].interference);
  }
  return text + "Friction while the parts give way, spin and torque are not modelled: docs/design/fit.md\n";
}

}  // namespace

Result<int> run_fit(const FitOptions& o) {
  const jobs::FitJob& job = o.job;
  LEKALO_CHECK(check_outputs({{"-o", o.output},
                              {"--picture", o.picture},
                              {"--profile", job.table_as},
                              {"--drawing", job.drawing_as},
                              {"--program", job.program_as}},
                             {}));
  LEKALO_TRY(const jobs::Fitted made, jobs::fit(o.job, progress_lines()));
  disk::AtomicFiles files;
  for (const auto& [path, bytes] : {std::pair{&o.output, &made.json},
                                    {&o.picture, &made.picture},
                                    {&job.table_as, &made.table},
                                    {&job.drawing_as, &made.drawing},
                                    {&job.program_as, &made.program}})
    if (!path->empty()) LEKALO_CHECK(files.add(*path, *bytes));
  LEKALO_CHECK(files.commit());
  if (o.json) LEKALO_CHECK(print(made.json));
  tell(words_of(o.job, made));
  return 0;
}

}  // namespace lekalo::cli
