#include "lekalo/jobs/edit.hpp"

#include <fmt/core.h>

#include <utility>

#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/layout/session.hpp"

namespace lekalo::jobs {

Result<Edited> edit(layout::Document document, const File& commands) {
  const Result<layout::Session> session = layout::replay(std::move(document), commands.bytes);
  if (!session)
    return failure(session.error().code, fmt::format("{}, {}", commands.name, session.error().message));
  const layout::Document& done = session->document();
  return Edited{done, io::write_layout(done), layout::check(done)};
}

}  // namespace lekalo::jobs
