#include "serve_command.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>

#include "layout_input.hpp"
#include "outputs.hpp"
#include "server/server.hpp"
#include "server/store.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

namespace fs = std::filesystem;

/// Where the layouts are when nobody says: among the user's data.
Result<std::string> usual_store() {
  const char* const data = std::getenv("XDG_DATA_HOME");
  const char* const home = std::getenv("HOME");
  fs::path folder;
  if (data != nullptr && fs::path(data).is_absolute()) {
    folder = data;
  } else if (home != nullptr && fs::path(home).is_absolute()) {
    folder = fs::path(home) / ".local" / "share";
  } else {
    return failure(ErrorCode::usage, "there is no home folder for the layouts; name a file with --store");
  }
  folder /= "lekalo";
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    return failure(ErrorCode::environment,
                   fmt::format("{}: cannot be made for the layouts ({}); name a file with --store",
                               folder.string(), error.message()));
  return (folder / "layouts.sqlite").string();
}

/// The file as a layout of the store: the one that was made from the same bytes before, with all that was
/// done to it since, or a new one.
Result<server::LayoutId> layout_of_file(server::Store& store, const LayoutSource& source) {
  const Result<LayoutInput> input = read_layout_input(source, {});
  if (!input) return tl::unexpected(input.error());
  for (const std::string& notice : input->notices) tell("note: " + notice + "\n");
  const Result<std::optional<server::LayoutId>> known = store.find_origin(input->sha256);
  if (!known) return tl::unexpected(known.error());
  if (*known) {
    tell(fmt::format("{} was opened before; here is what became of it (its first state is in the history)\n",
                     source.path));
    return **known;
  }
  const std::string& name = input->document.name;
  return store.create(name.empty() ? fs::path(source.path).stem().string() : name, input->document,
                      input->sha256);
}

}  // namespace

Result<int> run_serve(const ServeOptions& o) {
  server::ServerOptions options;
  options.address = o.listen;
  options.port = o.port;
  options.token = o.token;
  const Result<bool> loopback = server::is_loopback(o.listen);
  if (!loopback) return tl::unexpected(loopback.error());
  if (!*loopback && options.token.empty()) {
    Result<std::string> token = server::random_token();
    if (!token) return tl::unexpected(token.error());
    options.token = std::move(*token);
  }
  const Result<std::string> path = o.store.empty() ? usual_store() : o.store;
  if (!path) return tl::unexpected(path.error());
  Result<server::Store> store = server::Store::open(*path);
  if (!store) return tl::unexpected(store.error());
  std::optional<server::LayoutId> opened;
  if (!o.source.path.empty()) {
    const Result<server::LayoutId> id = layout_of_file(*store, o.source);
    if (!id) return tl::unexpected(id.error());
    opened = *id;
  }
  const auto listening = [&](const std::string& url) {
    std::string said = "listening " + url + "\n";
    if (opened)
      said += fmt::format("layout {}{}layout={}\n", url, options.token.empty() ? "?" : "&", *opened);
    return print(said).and_then([]() -> Result<void> {
      // Whoever started us may wait for the line.
      if (std::fflush(stdout) != 0) return failure(ErrorCode::environment, "stdout cannot be written");
      return {};
    });
  };
  if (Result<void> done = server::serve(options, std::move(*store), listening); !done)
    return tl::unexpected(done.error());
  return 0;
}

}  // namespace lekalo::cli
