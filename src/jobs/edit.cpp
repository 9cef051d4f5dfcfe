#include "lekalo/jobs/edit.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/layout/session.hpp"

namespace lekalo::jobs {
namespace {

std::vector<std::string> kit_notices(const std::vector<layout::Kit>& before,
                                     const std::vector<layout::Kit>& after) {
  std::vector<std::string> notices;
  for (const layout::Kit& kit : before) {
    const auto now =
        std::find_if(after.begin(), after.end(), [&](const layout::Kit& one) { return one.id == kit.id; });
    if (now == after.end())
      notices.push_back(fmt::format("kit '{}' is gone with the last of its parts", kit.id));
    else if (now->pieces.size() != kit.pieces.size())
      notices.push_back(fmt::format("kit '{}' is made without the parts that were removed", kit.id));
  }
  return notices;
}

}  // namespace

Result<Edited> edit(layout::Document document, const File& commands) {
  const std::vector<layout::Kit> kits = document.kits;
  const Result<layout::Session> session = layout::replay(std::move(document), commands.bytes);
  if (!session)
    return failure(session.error().code, fmt::format("{}, {}", commands.name, session.error().message));
  const layout::Document& done = session->document();
  return Edited{done, io::write_layout(done), layout::check(done), kit_notices(kits, done.kits)};
}

}  // namespace lekalo::jobs
