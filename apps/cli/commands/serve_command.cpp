#include "serve_command.hpp"

#include <fmt/core.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>

#include "layout_input.hpp"
#include "lekalo/disk/files.hpp"
#include "outputs.hpp"
#include "server/access.hpp"
#include "server/server.hpp"
#include "server/store/store.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

namespace fs = std::filesystem;

/// Returns the file of the layouts when the user names none: it lies among the user's data.
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

/// Returns the layout of the store that stands for a file: the one that was made from the same bytes before,
/// with all that was done to it since, or else a new one.
Result<server::LayoutId> layout_of_file(server::Store& store, const LayoutSource& source) {
  LEKALO_TRY(const jobs::Layout input, read_layout_input(source, {}));
  tell(notes(input.notices));
  LEKALO_TRY(const std::optional<server::LayoutId> known, store.find_origin(input.inputs.front().sha256));
  if (known) {
    tell(fmt::format("{} was opened before; here is what became of it (its first state is in the history)\n",
                     source.path));
    return *known;
  }
  const std::string& name = input.document.name;
  return store.create(name.empty() ? fs::path(source.path).stem().string() : name, input.document,
                      input.inputs.front().sha256);
}

/// Returns the token that whoever opens the page has to know, from its file or from the environment; empty
/// where there is none. A command line would be seen by everybody on the machine.
Result<std::string> given_token(const std::string& file) {
  if (file.empty()) {
    const char* const variable = std::getenv("LEKALO_TOKEN");
    const std::string token = variable != nullptr ? variable : "";
    if (token.empty()) return token;
    return server::check_token(token).map([&] { return token; }).map_error([](const Error& error) {
      return Error{error.code, "LEKALO_TOKEN: " + error.message};
    });
  }
  LEKALO_TRY(std::string token, disk::read_file(file));
  while (!token.empty() && (token.back() == '\n' || token.back() == '\r')) token.pop_back();
  if (const Result<void> fine = server::check_token(token); !fine)
    return failure(ErrorCode::bad_input, file + ": " + fine.error().message);
  std::error_code unknown;
  const fs::perms rights = fs::status(file, unknown).permissions();
  if (!unknown && (rights & (fs::perms::group_read | fs::perms::others_read)) != fs::perms::none)
    tell(fmt::format("{}: others on this machine can read the token; chmod 600 {}\n", file, file));
  return token;
}

}  // namespace

Result<int> run_serve(const ServeOptions& o) {
  server::ServerOptions options;
  options.address = o.listen;
  options.port = o.port;
  LEKALO_TRY(options.token, given_token(o.token_file));
  LEKALO_TRY(const bool loopback, server::is_loopback(o.listen));
  // Everybody who can reach another address than loopback could edit, so such a server needs a token.
  if (!loopback && options.token.empty()) {
    LEKALO_TRY(options.token, server::random_token());
    options.tells_token = true;
  }
  LEKALO_TRY(const std::string path, o.store.empty() ? usual_store() : o.store);
  LEKALO_TRY(server::Store store, server::Store::open(path));
  for (const std::string& notice : store.notices()) tell(fmt::format("{}: {}\n", path, notice));
  std::optional<server::LayoutId> opened;
  if (!o.source.path.empty()) {
    LEKALO_TRY(opened, layout_of_file(store, o.source));
  }
  const auto listening = [&](const std::string& url) {
    std::string said = "listening " + url + "\n";
    if (opened) said += fmt::format("layout {}{}layout={}\n", url, options.tells_token ? "&" : "?", *opened);
    return print(said).and_then([]() -> Result<void> {
      // The program that started us may wait for the line.
      if (std::fflush(stdout) != 0) return failure(ErrorCode::environment, "stdout cannot be written");
      return {};
    });
  };
  LEKALO_CHECK(server::serve(options, std::move(store), listening));
  return 0;
}

}  // namespace lekalo::cli
