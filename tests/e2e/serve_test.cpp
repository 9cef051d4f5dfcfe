// `lekalo serve` as a process of its own, with real sockets: nothing acknowledged is lost when it is killed,
// clients agree, strangers are refused.

#include <sys/mount.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <optional>

#include "lekalo/base/random.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "serve_client.hpp"
#include "support/cases.hpp"

namespace lekalo::test::serve_test {
namespace {

/// Three corners about a place, so that any order of them is an outline.
std::string random_outline(Random& random) {
  const auto x = static_cast<int>(random.below(180)), y = static_cast<int>(random.below(180));
  const int size = 2 + static_cast<int>(random.below(20));
  return " outline " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(x + size) + " " +
         std::to_string(y) + " " + std::to_string(x) + " " + std::to_string(y + size);
}

/// On one of eight defects, which may be there or not.
std::string random_feature_command(Random& random) {
  const std::string name = " sheet d" + std::to_string(random.below(8));
  switch (random.below(5)) {
    case 0:
      return "move-defect" + name + " by " + std::to_string(random.below(9)) + " 1";
    case 1:
      return "reshape-defect" + name + random_outline(random);
    case 2:
      return "remove-defect" + name;
    default:
      return "add-defect" + name + " 1" + random_outline(random);
  }
}

std::string random_command(Random& random) {
  const auto step = [&] { return std::to_string(static_cast<int>(random.below(31)) - 15); };
  const std::string id = std::to_string(1 + random.below(12));
  switch (random.below(4)) {
    case 0:
      return "slide " + id + " towards " + std::to_string(1 + random.below(9)) + " " + step();
    case 1:
      return "nearest " + id + " by " + step() + " " + step();
    default:
      return "move " + id + " by " + step() + " " + step();
  }
}

TEST(Serve, TwoClientsOnOneLayoutStayInStep) {
  const TemporaryFolder folder;
  ServerProcess server(folder.path());
  ASSERT_EQ(server.line(), "listening http://" + server.host() + "/");
  const int layout = create(server);
  Client a(server, layout, "anna"), b(server, layout);
  EXPECT_EQ(a.hear("layout")["revision"], 0);
  b.hear("layout");
  EXPECT_EQ(a.command("move 1 by 3 0")["type"], "done");
  const Json change = b.hear("change");
  EXPECT_EQ(change["placements"][0]["after"]["x"], 23);
  EXPECT_EQ(b.command("move 1 by 0 3")["revision"], 2);
  const Json refused = a.ask({{"type", "undo"}});
  EXPECT_EQ(refused["type"], "refused");
  EXPECT_NE(refused["message"].get<std::string>().find("move 1 by 0 3"), std::string::npos) << refused;
  EXPECT_EQ(a.command("move 1 by 38 0")["violations"].size(), 1u);
  EXPECT_EQ(ask(server, http::verb::post, "/api/layouts/1/restore?revision=0").status, 200u);
  EXPECT_EQ(b.hear("change").value("kind", ""), "command");
  EXPECT_EQ(b.hear("change")["kind"], "restore");
  EXPECT_EQ(server.end(SIGTERM), 0);
  EXPECT_EQ(b.hear("bye")["type"], "bye");
}

TEST(Serve, ExportsForMachinesAsTheCommandLineDoes) {
  const TemporaryFolder folder;
  const ServerProcess server(folder.path());
  write_bytes(folder / "shoes.commands",
              read_bytes(cases::source_dir() + "/examples/layouts/shoes.commands"));
  ASSERT_EQ(run(folder.path(), {"edit", cases::source_dir() + "/examples/layouts/shoes.json", "--commands",
                                "shoes.commands", "-o", "shoes.json"})
                .status,
            0);
  const Answer created =
      ask(server, http::verb::post, "/api/layouts?name=shoes", read_bytes(folder / "shoes.json"));
  ASSERT_EQ(created.status, 201u) << created.body;
  const std::vector<std::pair<std::string, Words>> forms{
      {"form=dxf&unit=inch", {"--format", "dxf", "--unit", "inch"}},
      {"form=svg&only=CUT,MARK", {"--format", "svg", "--only", "CUT,MARK"}},
      {"form=hpgl", {"--format", "hpgl"}},
      {"form=gcode&kerf=0.3&feed=2000&lead-in=2&sheet=hide",
       {"--format", "gcode", "--kerf", "0.3", "--feed", "2000", "--lead-in", "2", "--sheet", "hide"}}};
  for (const auto& [query, words] : forms) {
    const Answer exported = ask(server, http::verb::get, "/api/layouts/1/export?" + query);
    ASSERT_EQ(exported.status, 200u) << query << ": " << exported.body;
    // The title of a program is the layout's name, there the document's, here the store's.
    const auto from_second_line = [](const std::string& text) { return text.substr(text.find('\n')); };
    EXPECT_EQ(from_second_line(exported.body),
              from_second_line(run(folder.path(), Words{"export", "shoes.json"} + words).out))
        << query;
    const bool has_notes =
        query.find("hpgl") != std::string::npos || query.find("gcode") != std::string::npos;
    ASSERT_EQ(!exported.notes.empty(), has_notes) << query;
    if (!has_notes) continue;
    EXPECT_NE(run(folder.path(), Words{"export", "shoes.json", "-o", "out"} + words)
                  .err.find(Json::parse(exported.notes)[0].get<std::string>()),
              std::string::npos)
        << exported.notes;
  }
  for (const char* wrong :
       {"form=gcode", "form=dxf&kerf=1", "form=svg&sheet=x", "form=hpgl&tolerance=nan", "form=gif"})
    EXPECT_EQ(ask(server, http::verb::get, std::string("/api/layouts/1/export?") + wrong).status, 400u)
        << wrong;
}

/// A form as browsers send it.
std::string form_of(std::initializer_list<std::array<std::string, 3>> fields) {
  std::string body;
  for (const auto& [name, file, value] : fields)
    body += "------x\r\nContent-Disposition: form-data; name=\"" + name + "\"" +
            (file.empty() ? "" : "; filename=\"" + file + "\"\r\nContent-Type: image/svg+xml") + "\r\n\r\n" +
            value + "\r\n";
  return body + "------x--\r\n";
}

constexpr const char* kTray =
    R"(<svg xmlns="http://www.w3.org/2000/svg" width="50mm" height="40mm" viewBox="0 0 50 40">
<rect x="5" y="5" width="20" height="10"/></svg>)";

TEST(Serve, MakesOneLayoutOfAnOrderOfManyDrawingsAsTheCommandDoes) {
  const TemporaryFolder folder;
  const ServerProcess server(folder.path());
  const auto post = [&](const std::string& body) {
    return ask(server, http::verb::post, "/api/layouts?name=job&order=1", body);
  };
  const Answer made = post(
      form_of({{"table", "", "file,quantity,rotations,mirror\ntray.svg,4,\"0,90\",no\nlid.svg,2,any,yes\n"},
               {"sheet", "", "300.5x200=3"},
               {"gap", "", "4"},
               {"kerf", "", "1/8in"},
               {"file", "tray.svg", kTray},
               {"file", "lid.svg", kTray}}));
  ASSERT_EQ(made.status, 201u) << made.body;
  const std::string written = ask(server, http::verb::get, "/api/layouts/1/export?form=layout").body;
  const Json document = Json::parse(written);
  EXPECT_EQ(document["stocks"][0]["count"], 3);
  EXPECT_EQ(document["stocks"][0]["outline"]["polygon"]["outer"],
            Json::parse("[[0, 0], [300.5, 0], [300.5, 200], [0, 200]]"));
  EXPECT_EQ(document["parts"][0]["demand"], 4);
  EXPECT_EQ(document["parts"][1]["id"], "lid");
  Client client(server, 1);
  client.hear("layout");
  EXPECT_EQ(client.command("fit tray 300.5x200 2")["type"], "done");

  write_bytes(folder / "tray.svg", kTray);
  write_bytes(folder / "lid.svg", kTray);
  write_bytes(folder / "o.csv",
              "file,quantity,rotations,mirror\ntray.svg,4,\"0,90\",no\nlid.svg,2,any,yes\n");
  const auto command = run(folder.path(), {"new", "--order", "o.csv", "--sheet", "300.5x200=3", "--gap", "4",
                                           "--kerf", "1/8in", "-o", "o.json"});
  ASSERT_EQ(command.status, 0) << command.err;
  EXPECT_EQ(read_bytes(folder / "o.json"), written);
}

TEST(Serve, ABillIsMultipliedOutAndWhatIsAddedIsOfTheLayoutsMaterial) {
  const TemporaryFolder folder;
  const ServerProcess server(folder.path());
  const auto post = [&](const std::string& table, const std::string& build) {
    return ask(server, http::verb::post, "/api/layouts?name=job&order=1",
               form_of({{"table", "", table},
                        {"build", "", build},
                        {"sheet", "", "300x200=3@steel:2"},
                        {"file", "tray.svg", kTray}}));
  };
  const std::string bill = "assembly,file,quantity,due\ndesk,drawer,3,\ndrawer,tray.svg,2,2026-12-01\n";
  const Answer made = post(bill, "desk=2");
  ASSERT_EQ(made.status, 201u) << made.body;
  Json part = Json::parse(ask(server, http::verb::get, "/api/layouts/1/export?form=layout").body)["parts"][0];
  EXPECT_EQ(part["demand"], 12);
  EXPECT_EQ(part["material"], "steel");
  EXPECT_EQ(part["due"], "2026-12-01");
  ASSERT_EQ(ask(server, http::verb::post, "/api/layouts/1/order",
                form_of({{"sheet", "", "50x50"}, {"file", "lid.svg", kTray}}))
                .status,
            200u);
  const Json document = Json::parse(ask(server, http::verb::get, "/api/layouts/1/export?form=layout").body);
  EXPECT_EQ(document["parts"][1]["material"], "steel");
  EXPECT_EQ(document["stocks"][1]["thickness"], 2);

  EXPECT_NE(post(bill, "chair").body.find("build: 'chair' is no assembly of the table"), std::string::npos);
  const Answer several = ask(server, http::verb::post, "/api/layouts?name=job&order=1",
                             form_of({{"table", "", "file,material\ntray.svg,steel\ntray.svg,birch\n"},
                                      {"sheet", "", "300x200@steel"},
                                      {"sheet", "", "300x200@birch"},
                                      {"file", "tray.svg", kTray}}));
  EXPECT_EQ(several.status, 400u);
  EXPECT_NE(several.body.find("the order is of 2 materials"), std::string::npos) << several.body;
}

TEST(Serve, PartsAndSheetsOfAnOpenLayoutChangeForEveryone) {
  const TemporaryFolder folder;
  auto server = std::make_unique<ServerProcess>(folder.path());
  const int id = create(*server);
  const std::string path = "/api/layouts/" + std::to_string(id);
  {
    Client anna(*server, id, "anna"), other(*server, id);
    anna.hear("layout");
    other.hear("layout");
    EXPECT_EQ(anna.command("quantity square 14")["type"], "done");
    EXPECT_EQ(anna.hear("layout")["document"]["parts"][0]["demand"], 14);
    EXPECT_EQ(other.hear("layout")["document"]["parts"][0]["demand"], 14);
    const Answer added = ask(*server, http::verb::post, path + "/order?author=anna",
                             form_of({{"table", "", "file,quantity,rotations\ntray.svg,4,\"0,90\"\n"},
                                      {"sheet", "", "1ftx200mm"},
                                      {"file", "tray.svg", kTray}}));
    ASSERT_EQ(added.status, 200u) << added.body;
    EXPECT_EQ(Json::parse(added.body)["added"], Json::parse(R"(["tray", "304.8x200"])"));
    const Json document = other.hear("layout")["document"];
    EXPECT_EQ(document["parts"][1]["demand"], 4);
    EXPECT_EQ(document["parts"][1]["rotations"], Json::parse("[0, 90]"));
    EXPECT_EQ(document["stocks"][1]["count"], 18) << "one for every piece";
    anna.hear("layout");
    EXPECT_EQ(other.command("fit tray 304.8x200 0")["type"], "done");
    EXPECT_EQ(anna.ask({{"type", "undo"}})["type"], "refused");
    EXPECT_EQ(other.command("remove-stock sheet")["taken_off"], 12);
    EXPECT_EQ(other.hear("layout")["document"]["placements"].size(), 1u);
    // The numbers of placements that went are not given again, and undo goes on across a restart.
    anna.hear("layout");
    EXPECT_EQ(anna.revision(), 4);
    EXPECT_EQ(other.ask({{"type", "undo"}})["type"], "done");
    EXPECT_EQ(other.hear("layout")["document"]["placements"].size(), 13u);
  }
  const std::string before = ask(*server, http::verb::get, path + "/export?form=layout").body;
  server->end(SIGKILL);
  server = std::make_unique<ServerProcess>(folder.path());
  EXPECT_EQ(ask(*server, http::verb::get, path + "/export?form=layout").body, before);
  Client anna(*server, id, "anna");
  anna.hear("layout");
  EXPECT_EQ(anna.command("remove 13")["type"], "done");
  EXPECT_EQ(anna.ask({{"type", "undo"}})["type"], "done");
  EXPECT_EQ(anna.ask({{"type", "undo"}})["type"], "refused") << "a tray lies on what was added";
  const Json history = Json::parse(ask(*server, http::verb::get, path + "/history").body)["entries"];
  EXPECT_EQ(history[1]["text"], "add \"tray\" \"304.8x200\"");
  EXPECT_EQ(history[1]["author"], "anna");
  EXPECT_EQ(history[3]["parts"][0]["removed"], 12);
}

TEST(Serve, TellsWhatIsWrongWithAnAdditionAndAddsNothing) {
  const TemporaryFolder folder;
  const ServerProcess server(folder.path());
  const std::string path = "/api/layouts/" + std::to_string(create(server)) + "/order";
  const auto refusal = [&](const std::string& body) {
    const Answer answer = ask(server, http::verb::post, path, body);
    EXPECT_EQ(answer.status, 400u) << answer.body;
    return Json::parse(answer.body)["error"].get<std::string>();
  };
  const auto says = [](const std::string& said, const char* what) {
    return said.find(what) != std::string::npos && said.find('\n') == std::string::npos;
  };
  EXPECT_TRUE(
      says(refusal(form_of({{"gap", "", "4"}, {"sheet", "", "10x10"}})), "the gap is one of the layout"));
  EXPECT_TRUE(says(refusal(form_of({{"sheet", "", "300x"}})),
                   "sheet: '300x' is neither a size such as 3000x1500 nor a file that came along"));
  EXPECT_TRUE(says(refusal(form_of({{"file", "tray.svg", "<svg><rect"}})), "tray.svg"));
  EXPECT_TRUE(says(refusal(form_of({{"grain", "", "x"}})), "no part is ordered"));
  EXPECT_EQ(ask(server, http::verb::post, path, "").status, 400u);
  EXPECT_EQ(ask(server, http::verb::get, path).status, 405u);
  EXPECT_EQ(ask(server, http::verb::post, "/api/layouts/99/order", form_of({{"sheet", "", "9x9"}})).status,
            404u);
  EXPECT_EQ(
      ask(server, http::verb::post, path + "?author=" + std::string(65, 'a'), form_of({{"sheet", "", "9x9"}}))
          .status,
      400u);
  EXPECT_EQ(Json::parse(ask(server, http::verb::get, "/api/layouts").body)["layouts"][0]["revision"], 0);
}

TEST(Serve, ReadsADrawingForAPictureAndKeepsNothing) {
  const TemporaryFolder folder;
  const ServerProcess server(folder.path());
  const Answer read = ask(server, http::verb::post, "/api/drawings?name=tray.svg", kTray);
  ASSERT_EQ(read.status, 200u) << read.body;
  const Json parts = Json::parse(read.body)["document"]["parts"];
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0]["outline"]["polygon"]["outer"].size(), 4u);
  const Answer broken = ask(server, http::verb::post, "/api/drawings?name=tray.svg", "<svg><rect");
  EXPECT_EQ(broken.status, 400u);
  EXPECT_NE(Json::parse(broken.body)["error"].get<std::string>().find("tray.svg"), std::string::npos);
  EXPECT_EQ(ask(server, http::verb::post, "/api/drawings?name=a", "").status, 400u);
  EXPECT_EQ(ask(server, http::verb::post, "/api/drawings", kTray).status, 400u);
  EXPECT_EQ(ask(server, http::verb::get, "/api/drawings?name=a").status, 405u);
  EXPECT_EQ(Json::parse(ask(server, http::verb::get, "/api/layouts").body)["layouts"].size(), 0u);
}

TEST(Serve, TellsEverythingThatIsWrongWithAnOrderAndMakesNothing) {
  const TemporaryFolder folder;
  const ServerProcess server(folder.path());
  const auto refusal = [&](const std::string& body) {
    const Answer answer = ask(server, http::verb::post, "/api/layouts?name=job&order=1", body);
    EXPECT_EQ(answer.status, 400u) << answer.body;
    return Json::parse(answer.body)["error"].get<std::string>();
  };
  const std::string said = refusal(form_of(
      {{"sheet", "", "300x"}, {"gap", "", "wide"}, {"colour", "", "red"}, {"file", "tray.svg", kTray}}));
  for (const char* part : {"colour", "gap: \"wide\""}) EXPECT_NE(said.find(part), std::string::npos) << said;
  EXPECT_NE(refusal(form_of({{"sheet", "", "300x200"}})).find("no part is ordered"), std::string::npos);
  EXPECT_NE(refusal(form_of({{"file", "tray.svg", kTray}})).find("no sheet"), std::string::npos);
  EXPECT_NE(
      refusal(
          form_of({{"table", "", "file\nlid.svg\n"}, {"sheet", "", "300x200"}, {"file", "tray.svg", kTray}}))
          .find("lid.svg"),
      std::string::npos);
  EXPECT_NE(refusal(form_of({{"sheet", "", "hide.svg"}, {"file", "tray.svg", kTray}})).find("hide.svg"),
            std::string::npos);
  const std::string whole = form_of({{"sheet", "", "300x200"}, {"file", "tray.svg", kTray}});
  for (std::size_t end = 0; end < whole.size() - 4; end += 7) {  // cut short on the way
    const Answer answer =
        ask(server, http::verb::post, "/api/layouts?name=job&order=1", whole.substr(0, end));
    EXPECT_EQ(answer.status, 400u) << end;
  }
  EXPECT_EQ(Json::parse(ask(server, http::verb::get, "/api/layouts").body)["layouts"].size(), 0u);
}

TEST(Serve, MakesNoLayoutOfAFileThatNobodyWaitsFor) {
  const TemporaryFolder folder;
  const ServerProcess server(folder.path());
  // Long to read, so that the end of the connection is known before.
  Json many = Json::parse(squares());
  const Json one = many["placements"][0];
#ifdef LEKALO_SANITIZE_THREAD
  constexpr int kMany = 15'000;
#else
  constexpr int kMany = 150'000;
#endif
  for (int i = 0; i < kMany; ++i) many["placements"].push_back(one);
  const std::string body = many.dump();
  {
    asio::io_context io;
    tcp::socket socket = connected(io, server.port());
    asio::write(socket,
                asio::buffer("POST /api/layouts?name=a HTTP/1.1\r\nHost: " + server.host() +
                             "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body));
  }
  // Its turn is over when this one, as large and begun later, is there.
  ASSERT_EQ(ask(server, http::verb::post, "/api/layouts?name=b", body).status, 201u);
  const Json list = Json::parse(ask(server, http::verb::get, "/api/layouts").body)["layouts"];
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0]["name"], "b");
}

TEST(Serve, KilledAtAnyMomentItKeepsEveryAcknowledgedGesture) {
  const TemporaryFolder folder;
  Random random(cases::seed(), 1);
  auto server = std::make_unique<ServerProcess>(folder.path());
  const int layout = create(*server);
  long acknowledged = 0;
  std::size_t commands = 0;
  // 12 in the quick suite; LEKALO_CASES=200 for the full one.
  for (std::size_t round = 0; round < cases::case_count(12); ++round) {
    std::thread killer;
    std::pair<long, Json> told;  // a revision and its state, as the client followed it
    std::optional<Client> kept;
    try {
      Client& client = kept.emplace(*server, layout, "anna");
      client.hear("layout");
      ASSERT_GE(client.revision(), acknowledged) << "an acknowledged gesture is lost";
      ASSERT_LE(client.revision(), acknowledged + 1) << "more than the one gesture without an answer";
      const auto wait = std::chrono::microseconds(random.below(300'000));
      killer = std::thread([&server, wait] {
        std::this_thread::sleep_for(wait);
        server->kill_now();
      });
      acknowledged = client.revision();
      for (;;) {
        const Json said = random.below(5) == 0
                              ? client.ask({{"type", random.below(2) == 0 ? "undo" : "redo"}})
                              : client.command(random.below(4) == 0    ? random_feature_command(random)
                                               : random.below(12) == 0 ? "compact towards -1 0"
                                                                       : random_command(random));
        if (said["type"] == "done") acknowledged = said["revision"];
        ++commands;
      }
    } catch (const std::exception&) {  // the connection ended
    }
    if (kept) told = {kept->revision(), kept->document()};
    if (killer.joinable()) killer.join();
    server = std::make_unique<ServerProcess>(folder.path());
    const Answer exported = ask(*server, http::verb::get, "/api/layouts/1/export?form=layout");
    ASSERT_EQ(exported.status, 200u) << exported.body;
    write_bytes(folder / "now.json", exported.body);
    // A defect may lie under a part: that is a violation (1), not a broken document.
    ASSERT_LE(run(folder.path(), {"check", "now.json"}).status, 1);
    Client client(*server, layout);
    client.hear("layout");
    ASSERT_GE(client.revision(), acknowledged);
    ASSERT_LE(client.revision(), acknowledged + 1);
    ASSERT_TRUE(client.revision() != told.first || client.document() == told.second)
        << "the state is not the one that was told";
    acknowledged = client.revision();
  }
  EXPECT_GT(commands, 0u);
  std::printf("%zu gestures, %ld revisions\n", commands, acknowledged);
}

TEST(Serve, RefusesStrangersAndStaysUp) {
  const TemporaryFolder folder;
  const std::string token = "0123456789abcdef0123456789abcdef";
  write_bytes(folder / "token", token + "\n");
  fs::permissions(folder / "token", fs::perms::owner_read);
  ServerProcess server(folder.path(), {"--token-file", (folder / "token").string()});
  EXPECT_EQ(server.line(), "listening http://" + server.host() + "/");  // a log may keep it
  const std::map<std::string, std::string> known{{"Authorization", "Bearer " + token}};
  const auto status = [&](const std::string& target, std::map<std::string, std::string> headers) {
    return ask(server, http::verb::get, target, "", headers).status;
  };
  EXPECT_EQ(status("/api/layouts", {}), 403u);
  EXPECT_EQ(status("/api/layouts", {{"Authorization", "Bearer " + std::string(32, '0')}}), 403u);
  EXPECT_EQ(status("/api/layouts?token=" + token, {}), 200u);
  EXPECT_EQ(status("/api/layouts", known), 200u);
  auto other = known;
  other["Host"] = "evil.example:80";
  EXPECT_EQ(status("/", other), 403u);
  other = known;
  other["Origin"] = "http://evil.example";
  EXPECT_EQ(status("/", other), 403u);
  other = known;
  other["Sec-Fetch-Site"] = "same-site";
  EXPECT_EQ(status("/api/layouts", other), 403u);
  other["Sec-Fetch-Mode"] = "navigate";
  other["Sec-Fetch-Dest"] = "document";
  EXPECT_EQ(status("/", other), 200u);
  EXPECT_EQ(status("/api/layouts", other), 403u);
  for (const char* path :
       {"/../../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "//etc/passwd", "/index.html/..",
        "/api/layouts/../1", "/api/layouts/1e3/history", "/api/layouts/-1/history",
        "/api/layouts/99999999999999999999/history", "/api/layouts/7/history", "/api/layouts/1/photo/../x",
        "/api/layouts/7/photo?stock=../../etc/passwd", "/api/layouts/1/%2e%2e/photo"})
    EXPECT_EQ(status(path, known), 404u) << path;
  EXPECT_EQ(ask(server, http::verb::put, "/api/layouts", "", known).status, 405u);
  EXPECT_EQ(ask(server, http::verb::post, "/api/layouts?name=a", "no layout", known).status, 400u);
  EXPECT_EQ(ask(server, http::verb::post, "/api/layouts", squares(), known).status, 400u);
  EXPECT_EQ(ask(server, http::verb::patch, "/api/layouts/1?name=x", std::string(100, 'x'), known).status,
            413u);
  EXPECT_EQ(
      ask(server, http::verb::post, "/api/layouts?name=a", std::string((64u << 20) + 1, ' '), known).status,
      413u);
  EXPECT_THROW(Client(server, 1), std::exception);
  ASSERT_EQ(ask(server, http::verb::post, "/api/layouts?name=a", squares(), known).status, 201u);
  EXPECT_THROW(
      Client(server, 1, "", {{"Authorization", "Bearer " + token}, {"Origin", "http://evil.example"}}),
      std::exception);
  {
    Client client(server, 1, "", known);
    client.hear("layout");
    const std::string faults[] = {"",
                                  "{",
                                  "[]",
                                  "7",
                                  "{\"type\": \"command\"}",
                                  "{\"type\": \"delete\", \"seq\": 1}",
                                  "{\"type\": \"undo\", \"seq\": -1}",
                                  "{\"type\": \"undo\", \"seq\": 1, \"x\": 1}",
                                  "{\"type\": \"undo\", \"seq\": 1, \"seq\": 1}",
                                  std::string(100'000, '['),
                                  "{\"type\": \"select\", \"ids\": [[1]]}"};
    for (const std::string& fault : faults) {
      client.send(fault);
      EXPECT_FALSE(client.hear("error")["message"].get<std::string>().empty());
    }
    EXPECT_EQ(client.command("move 1 by 1 0")["type"], "done");
    EXPECT_THROW(
        for (int i = 0; i < 20; ++i) {
          client.send("x");
          client.hear("error");
        } client.hear(),
        std::exception);
    EXPECT_EQ(client.socket().reason().code, websocket::close_code::policy_error);
  }
  {
    Client client(server, 1, "", known);
    client.hear("layout");
    EXPECT_THROW(client.send(std::string((1u << 20) + 1, ' ')); for (;;) client.hear(), std::exception);
  }
  Random random(cases::seed(), 2);
  for (int i = 0; i < 16; ++i) {  // a million random bytes, some after a word that is understood
    asio::io_context io;
    tcp::socket socket = connected(io, server.port());
    std::string bytes = i % 2 == 0 ? "" : "GET /api/layouts HTTP/1.1\r\nHost: ";
    for (int k = 0; k < 65536; ++k) bytes += static_cast<char>(random.below(256));
    beast::error_code error;
    asio::write(socket, asio::buffer(bytes), error);
  }
  EXPECT_EQ(status("/api/layouts", known), 200u);
  for (int i = 0; i < 16; ++i) {  // another million into WebSockets: no frames, text, binary
    Client client(server, 1, "", known);
    client.hear("layout");
    beast::error_code error;
    std::string bytes;
    for (int k = 0; k < 65536; ++k) bytes += static_cast<char>(random.below(i % 4 == 3 ? 128 : 256));
    if (i % 2 == 0) {
      asio::write(client.socket().next_layer(), asio::buffer(bytes), error);
      client.socket().next_layer().shutdown(tcp::socket::shutdown_send, error);
      error = {};
    }
    client.socket().text(i % 4 == 3);  // of bytes below 128, which are text
    for (std::size_t k = 0; i % 2 == 1 && k < bytes.size() && !error; k += 2048)
      client.socket().write(asio::buffer(bytes.data() + k, 2048), error);
    EXPECT_THROW(for (;;) client.hear(), std::exception);  // it is closed, not left hanging
  }
  EXPECT_EQ(status("/api/layouts", known), 200u);
  Client client(server, 1, "", known);
  client.hear("layout");
  EXPECT_EQ(client.command("move 1 by -1 0")["type"], "done");
}

TEST(Serve, SaysWhenThePortOrTheStoreIsTaken) {
  const TemporaryFolder folder, other;
  ServerProcess server(folder.path());
  const Ran port = run(folder.path(), {"serve", "--store", (other / "s.sqlite").string(), "--port",
                                       std::to_string(server.port())});
  EXPECT_EQ(port.status, 5);
  EXPECT_NE(port.err.find("is in use"), std::string::npos) << port.err;
  const Ran store = run(folder.path(), {"serve", "--store", "store.sqlite", "--port", "0"});
  EXPECT_EQ(store.status, 5);
  EXPECT_NE(store.err.find("another program uses"), std::string::npos) << store.err;
}

TEST(Serve, FortyClientsAgreeInTheEnd) {
  const TemporaryFolder folder;
  ServerProcess server(folder.path());
  // 2 s in the quick suite; LEKALO_CASES=200 gives the 60 s of the full one.
  const auto time = std::chrono::milliseconds(std::min<std::size_t>(60'000, 700 * cases::case_count(3)));
  std::vector<int> layouts{create(server)};
  for (int i = 0; i < 20; ++i) layouts.push_back(create(server));
  std::mutex lock;
  std::vector<double> shared_ms, alone_ms;
  std::vector<Json> ends;
  std::atomic<int> editing{20};
  const auto until = Clock::now() + time;
  std::vector<std::thread> threads;
  for (int i = 0; i < 40; ++i)
    threads.emplace_back([&, i] {
      Random random(cases::seed(), static_cast<std::uint64_t>(100 + i));
      const bool shared = i < 20;
      Client client(server, layouts[shared ? 0 : static_cast<std::size_t>(i - 19)]);
      client.hear("layout");
      std::vector<double> mine;
      while (Clock::now() < until) {
        const auto begin = Clock::now();
        client.command(random.below(5) == 0 ? random_feature_command(random) : random_command(random));
        mine.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
      }
      if (shared) {
        // When nobody edits any more, whoever has an answer has heard of everything before it.
        for (--editing; editing > 0;) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        // A defect may lie on the piece by now; then it stays where it is by being refused.
        const Json answer = client.command("move 1 by 0 0");
        EXPECT_TRUE(answer.contains("nothing") || answer["type"] == "refused") << answer;
      }
      const std::lock_guard guard(lock);
      auto& all = shared ? shared_ms : alone_ms;
      all.insert(all.end(), mine.begin(), mine.end());
      if (shared) ends.push_back(client.document());
    });
  std::this_thread::sleep_for(time / 6);
  const long early = server.resident_kb();
  for (std::thread& thread : threads) thread.join();
  const long late = server.resident_kb();
  Client reader(server, layouts[0]);
  reader.hear("layout");
  const Json stored = reader.document();
  ASSERT_EQ(ends.size(), 20u);
  for (const auto& end : ends) EXPECT_EQ(end, stored);
  const auto table = [](const char* what, std::vector<double>& ms) {
    ASSERT_FALSE(ms.empty());
    std::sort(ms.begin(), ms.end());
    std::printf("%s: %zu gestures, median %.1f ms, 99 %% %.1f ms, most %.1f ms\n", what, ms.size(),
                ms[ms.size() / 2], ms[ms.size() * 99 / 100], ms.back());
  };
  table("20 on one layout", shared_ms);
  table("20 on their own ", alone_ms);
  std::printf("memory: %ld kB after a sixth, %ld kB at the end\n", early, late);
#ifndef LEKALO_SANITIZE_ADDRESS  // which keeps what is freed for a while
  EXPECT_LT(late, early + 64 * 1024);
#endif
}

/// 30 x 30 squares with room between them: what takes a while to settle.
std::string many_squares() {
  std::string text =
      R"({"format": "lekalo-layout/1", "units": "mm", "rules": {"gap": 1},
"stocks": [{"id": "sheet", "kind": "sheet", "outline": {"polygon": {"outer": [[0,0],[2000,0],[2000,2000],[0,2000]]}}}],
"parts": [{"id": "square", "outline": {"polygon": {"outer": [[0,0],[10,0],[13,4],[10,10],[4,7],[0,10]]}}}],
"placements": [)";
  for (int i = 0; i < 3600; ++i)
    text += std::string(i == 0 ? "" : ",") +
            R"({"part": "square", "stock": "sheet", "rotation_deg": 0, "x": )" +
            std::to_string(5 + 33 * (i % 60)) + R"(, "y": )" + std::to_string(5 + 33 * (i / 60)) + "}";
  return text + "]}";
}

TEST(Serve, ALongCommandSaysHowFarItIsStopsWhenAskedAndHoldsUpNobody) {
  const TemporaryFolder folder;
  ServerProcess server(folder.path());
  ASSERT_EQ(ask(server, http::verb::post, "/api/layouts?name=many", many_squares()).status, 201u);
  Client slow(server, 1), other(server, 1);
  slow.hear("layout");
  other.hear("layout");
  slow.send(R"({"type": "command", "seq": 1000, "mode": "strict", "text": "compact towards -3 -2"})");
  // Waits for the answer of the long one, and is not lost.
  slow.send(R"({"type": "command", "seq": 1001, "mode": "strict", "text": "lock 1"})");
  const Json progress = slow.hear("progress");
  EXPECT_EQ(progress["seq"], 1000);
  EXPECT_GT(progress["fraction"], 0);
  EXPECT_LT(progress["fraction"], 1);
  double most = 0;
  for (int i = 0; i < 10; ++i) {
    const auto begin = Clock::now();
    EXPECT_EQ(
        other.command("place square sheet 0 1 0 " + std::to_string(1700 + 20 * i) + " 1985 upright")["type"],
        "done");
    most = std::max(most, std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
  }
  slow.send(R"({"type": "stop", "seq": 1000})");
  const Json done = slow.hear("done");
  EXPECT_EQ(done["seq"], 1000);
  EXPECT_EQ(done["stopped"], true);
  EXPECT_EQ(slow.hear("done")["seq"], 1001);
  // That it was stopped says that all of them were done while it ran; how fast is told, not tested.
  std::printf("commands of another client meanwhile: %.1f ms at most\n", most);
  const Answer exported = ask(server, http::verb::get, "/api/layouts/1/export?form=layout");
  write_bytes(folder / "now.json", exported.body);
  EXPECT_EQ(run(folder.path(), {"check", "now.json"}).status, 0);
}

TEST(Serve, KeepsAPhotographOfAStock) {
  const TemporaryFolder folder;
  ServerProcess server(folder.path());
  ASSERT_EQ(ask(server, http::verb::post, "/api/layouts?name=a", squares()).status, 201u);
  const std::string png = std::string("\x89PNG\r\n\x1a\n") + std::string(5'000'000, '\0'),
                    at = "/api/layouts/1/photo?stock=sheet", scale = "&pixels=10,20,110,20&mm=0,0,200.5,0";
  Client client(server, 1);
  client.hear("layout");
  ASSERT_EQ(ask(server, http::verb::put, at + scale, png).status, 200u);
  EXPECT_EQ(client.hear("photos"), Json::parse(R"({"type": "photos", "stock": "sheet", "image": true})"));
  EXPECT_EQ(ask(server, http::verb::get, at).body, png);
  EXPECT_EQ(ask(server, http::verb::patch, at + "&pixels=1,2,3,4&mm=5,6,7,8").status, 200u);
  EXPECT_EQ(client.hear("photos"), Json::parse(R"({"type": "photos", "stock": "sheet", "image": false})"));
  ASSERT_EQ(ask(server, http::verb::post, "/api/layouts/1/copy?name=b").status, 201u);
  const Json list = Json::parse(ask(server, http::verb::get, "/api/layouts/2/photos").body);
  EXPECT_EQ(list["photos"][0]["stock"], "sheet");
  EXPECT_EQ(list["photos"][0]["type"], "image/png");
  EXPECT_EQ(list["photos"][0]["bytes"], png.size());
  EXPECT_EQ(list["photos"][0]["pixels"], Json::parse("[1, 2, 3, 4]"));
  EXPECT_EQ(list["photos"][0]["mm"], Json::parse("[5, 6, 7, 8]"));
  EXPECT_EQ(ask(server, http::verb::put, at + scale, "<svg onload='x'>").status, 415u);
  EXPECT_EQ(ask(server, http::verb::put, at + scale, png + std::string(12u << 20, '\0')).status, 413u);
  EXPECT_EQ(ask(server, http::verb::put, "/api/layouts/1/photo?stock=..%2F..%2Fetc" + scale, png).status,
            404u);
  EXPECT_EQ(ask(server, http::verb::put, at, png).status, 400u);
  for (const char* wrong :
       {"&pixels=1,2,1,2&mm=5,6,7,8", "&pixels=1,2,3&mm=5,6,7,8", "&pixels=1,2,3,nan&mm=5,6,7,8",
        "&pixels=1,2,3,4&mm=5,6,7,1e9", "&pixels=1,2,3,4,5&mm=5,6,7,8"})
    EXPECT_EQ(ask(server, http::verb::put, at + wrong, png).status, 400u) << wrong;
  EXPECT_EQ(ask(server, http::verb::delete_, at).status, 200u);
  EXPECT_EQ(ask(server, http::verb::get, at).status, 404u);
  EXPECT_EQ(ask(server, http::verb::get, "/api/layouts/2/photo?stock=sheet").body, png);
  EXPECT_EQ(ask(server, http::verb::get, "/api/layouts/9/photos").status, 404u);
}

TEST(Serve, OnAFullDiskRefusesWithTheReasonAndBreaksNothing) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "the limit on the size of files that stands for a full disk ends the sanitizer, too";
#endif
  const TemporaryFolder folder;
  Json before;
  {
    ServerProcess server(folder.path(), {}, 400'000);
    const int layout = create(server);
    Client client(server, layout);
    client.hear("layout");
    Json said{{"type", "done"}};
    for (int i = 0; i < 3000 && said["type"] == "done"; ++i)
      said = client.command(i % 2 == 0 ? "move 1 by 1 0" : "move 1 by -1 0");
    ASSERT_EQ(said["type"], "refused");
    EXPECT_NE(said["message"].get<std::string>().find("full"), std::string::npos) << said;
    EXPECT_EQ(client.command("move 2 by 1 0")["type"], "refused");  // and still answers
    EXPECT_EQ(ask(server, http::verb::get, "/api/layouts/1/export?form=layout").status, 200u);
    before = client.document();
  }
  ServerProcess server(folder.path());
  Client client(server, 1);
  client.hear("layout");
  EXPECT_EQ(client.document(), before);
  EXPECT_EQ(client.command("move 2 by 1 0")["type"], "done");
}

TEST(Serve, SaysThatAStoreCannotBeWritten) {
  const TemporaryFolder folder;
  const fs::path disk = folder / "disk";
  fs::create_directory(disk);
  // Root may write every file but on a disk that is read-only.
  const bool mounted = mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=4m") == 0;
  if (!mounted && geteuid() == 0) GTEST_SKIP() << "root may write every file, and cannot mount here";
  std::string before;
  {
    ServerProcess server(disk);
    create(server);
    server.end(SIGTERM);
    before = read_bytes(disk / "store.sqlite");
  }
  if (mounted)
    ASSERT_EQ(mount(nullptr, disk.c_str(), nullptr, MS_REMOUNT | MS_RDONLY, nullptr), 0);
  else
    fs::permissions(disk / "store.sqlite", fs::perms::owner_read);
  const Ran ran = run(folder.path(), {"serve", "--store", "disk/store.sqlite", "--port", "0"});
  EXPECT_EQ(ran.status, 5);
  EXPECT_NE(ran.err.find("disk/store.sqlite: the store cannot be opened for writing"), std::string::npos)
      << ran.err;
  EXPECT_EQ(read_bytes(disk / "store.sqlite"), before);
  if (mounted) {
    EXPECT_EQ(umount(disk.c_str()), 0);
  }
}

}  // namespace
}  // namespace lekalo::test::serve_test
