// The collision engine (phi/scene.hpp) on dense layouts: thousand questions a second of one core, beside the
// figures that jagua-rs 0.7 reached on such a machine, and in the same run beside asking all bodies one after
// the other. Every kind of question and every layout: new places in every round, the best round counts;
// `first` is the first round, when the engine knows nothing yet. Answers are compared.
//
//   bench_scene [--data FOLDER] [layout...]       default: swim shirts jakobs1
//   bench_scene --scale [--data FOLDER]           10 to 100,000 parts on one stock
//
// FOLDER holds nesting/layouts; default LEKALO_SHARED_DATA.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <map>
#include <string>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/io/files.hpp"
#include "lekalo/io/nesting_files.hpp"
#include "lekalo/layout/workspace.hpp"
#include "lekalo/phi/outline_relation.hpp"
#include "lekalo/phi/scene.hpp"

namespace {

using namespace lekalo;
using geom::GridPoint;

double seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Jagua {
  double random, near, list, update;  // thousand a second
};
const std::map<std::string, Jagua> kJagua = {{"swim", {6413, 2013, 767, 271}},
                                             {"shirts", {5811, 7320, 1796, 392}},
                                             {"jakobs1", {10214, 8175, 2325, 395}}};

layout::Document load(const std::string& data, const std::string& name) {
  const auto fail = [](const Error& error) {
    fmt::print(stderr, "{}\n", error.message);
    std::exit(3);
  };
  const auto read = [&](const std::string& path) {
    auto bytes = io::read_file(path);
    if (!bytes) fail(bytes.error());
    return *bytes;
  };
  const std::string path = data + "/nesting/layouts/" + name + ".json", bytes = read(path);
  const auto instance = io::instance_of_placements(bytes, path);
  if (!instance) fail(instance.error());
  const std::string order_path = data + "/nesting/" + *instance;
  auto order = io::read_nesting(read(order_path), order_path);
  if (!order) fail(order.error());
  auto placed = io::read_placements(bytes, path, std::move(order->document));
  if (!placed) fail(placed.error());
  return std::move(placed->document);
}

/// One layout in a scene: body 0 is the border of the length used, then the parts.
struct Layout {
  phi::Scene scene;
  geom::GridBox strip;
  std::vector<phi::ShapeIndex> shapes;     ///< every part in every rotation allowed
  std::vector<phi::BodyIndex> bodies;      ///< without the border
  std::vector<double> diameters;           ///< of the bodies, steps
  std::vector<phi::BodyIndex> everything;  ///< with it
};

double diameter(const geom::GridRegion& region) {
  double most = 0;
  for (const GridPoint a : region.points)
    for (const GridPoint b : region.points) most = std::max(most, static_cast<double>(dot(a - b, a - b)));
  return std::sqrt(most);
}

Layout make_layout(const layout::Document& document) {
  std::map<std::tuple<std::uint32_t, std::int64_t, std::int64_t>, phi::ShapeIndex> known;
  const auto turned_part = [&](std::uint32_t part, geom::GridRotation rotation) {
    return geom::turned(document.parts[part].outline.polygon, rotation, false);
  };
  geom::GridBox strip = bounds(document.stocks[0].outline.polygon);
  strip.high.x = 0;
  for (const layout::Placement& p : document.placements)
    strip.high.x = std::max(strip.high.x, bounds(turned_part(p.part, p.rotation)).high.x + p.at.x);
  Layout made{phi::Scene(strip, 4 * document.placements.size() + 64), strip, {}, {}, {}, {}};
  const auto shape = [&](std::uint32_t part, geom::GridRotation rotation) {
    const auto [at, is_new] = known.try_emplace({part, rotation.c, rotation.s}, 0);
    if (is_new) at->second = made.scene.add_shape(turned_part(part, rotation));
    return at->second;
  };
  const phi::ShapeIndex border = made.scene.add_shape(
      geom::make_grid_region(
          {{strip.low, {strip.high.x, strip.low.y}, strip.high, {strip.low.x, strip.high.y}}})
          .value());
  made.everything.push_back(made.scene.put({.shape = border, .container = true}));
  for (const layout::Placement& p : document.placements) {
    made.bodies.push_back(made.scene.put({.shape = shape(p.part, p.rotation), .at = p.at}));
    made.diameters.push_back(diameter(document.parts[p.part].outline.polygon));
    made.everything.push_back(made.bodies.back());
  }
  for (std::uint32_t part = 0; part < document.parts.size(); ++part)
    for (const auto& range : document.parts[part].rotations)
      made.shapes.push_back(shape(part, geom::rotation_from_degrees(range.from)));
  return made;
}

/// The middle of the part's box anywhere on the strip.
std::vector<phi::Probe> random_probes(const Layout& on, Random& random, std::size_t count) {
  std::vector<phi::Probe> probes(count);
  for (phi::Probe& probe : probes) {
    probe.shape = on.shapes[random.below(on.shapes.size())];
    const geom::GridBox& box = on.scene.box(probe.shape);
    const auto place = [&](std::int64_t low, std::int64_t high, std::int64_t from, std::int64_t to) {
      return static_cast<std::int64_t>(random.uniform(static_cast<double>(low), static_cast<double>(high))) -
             (from + to) / 2;
    };
    probe.at = {place(on.strip.low.x, on.strip.high.x, box.low.x, box.high.x),
                place(on.strip.low.y, on.strip.high.y, box.low.y, box.high.y)};
  }
  return probes;
}

/// Likewise, with all of the box on the strip: the border answers none.
std::vector<phi::Probe> inner_probes(const Layout& on, Random& random, std::size_t count) {
  std::vector<phi::Probe> probes;
  while (probes.size() < count) {
    const phi::Probe probe = random_probes(on, random, 1)[0];
    const geom::GridBox& box = on.scene.box(probe.shape);
    const GridPoint low = box.low + probe.at, high = box.high + probe.at;
    if (low.x >= on.strip.low.x && low.y >= on.strip.low.y && high.x <= on.strip.high.x &&
        high.y <= on.strip.high.y)
      probes.push_back(probe);
  }
  return probes;
}

/// A part moved from its own place by up to 2 % of its diameter each way, itself left out.
std::vector<phi::Probe> near_probes(const Layout& on, Random& random, std::size_t count) {
  std::vector<phi::Probe> probes(count);
  for (phi::Probe& probe : probes) {
    const std::size_t i = random.below(on.bodies.size());
    const phi::Body& body = on.scene.body(on.bodies[i]);
    const double most = 0.02 * on.diameters[i];
    probe.shape = body.shape;
    probe.except = on.bodies[i];
    probe.at = body.at + GridPoint{static_cast<std::int64_t>(random.uniform(-most, most)),
                                   static_cast<std::int64_t>(random.uniform(-most, most))};
  }
  return probes;
}

bool body_forbids(const Layout& on, phi::BodyIndex index, const phi::Probe& probe) {
  if (index == probe.except) return false;
  const phi::Body& body = on.scene.body(index);
  const geom::GridRegion &theirs = on.scene.outline(body.shape), &ours = on.scene.outline(probe.shape);
  return body.container ? !phi::lies_within(theirs, ours, probe.at - body.at)
                        : phi::interiors_meet(theirs, ours, probe.at - body.at);
}

struct Rate {
  double first = 0, best = 0, brute = 0;  // questions a second
};

constexpr std::size_t kRounds = 12, kQuestions = 40'000, kCompared = 2'000;

/// `ask` and `brute` return how many answers they found.
template <class Make, class Ask, class Brute>
Rate measure(Make&& make, Ask&& ask, Brute&& brute) {
  Rate rate;
  for (std::size_t round = 0; round < kRounds; ++round) {
    const auto probes = make(kQuestions);
    const double start = seconds();
    ask(probes);
    const double speed = static_cast<double>(kQuestions) / (seconds() - start);
    if (round == 0) rate.first = speed;
    rate.best = std::max(rate.best, speed);
    if (round % 4 != 0) continue;
    const auto few = make(kCompared);
    const double start_brute = seconds();
    const std::size_t expected = brute(few);
    rate.brute = std::max(rate.brute, static_cast<double>(kCompared) / (seconds() - start_brute));
    if (ask(few) != expected) {
      fmt::print("DIFFERENT ANSWERS\n");
      std::exit(1);
    }
  }
  return rate;
}

void print(const std::string& layout, const char* kind, const Rate& rate, double jagua, double share) {
  fmt::print("{:<9}{:<24}{:>9.0f}{:>9.0f}{:>9.0f}", layout, kind, rate.best * 1e-3, rate.first * 1e-3, jagua);
  if (jagua > 0)
    fmt::print("{:>7.2f}", rate.best * 1e-3 / jagua);
  else
    fmt::print("{:>7}", "");
  if (rate.brute > 0)
    fmt::print("{:>10.1f}{:>8.0f}", rate.brute * 1e-3, rate.best / rate.brute);
  else
    fmt::print("{:>18}", "");
  if (share >= 0) fmt::print("{:>9.1f}", share);
  fmt::print("\n");
}

void run(const std::string& data, const std::string& name) {
  Layout on = make_layout(load(data, name));
  const auto published = kJagua.find(name);
  const Jagua jagua = published == kJagua.end() ? Jagua{} : published->second;
  Random random(1);
  std::size_t asked = 0, hits = 0;
  const auto forbidden = [&](const std::vector<phi::Probe>& probes) {
    std::size_t found = 0;
    for (const phi::Probe& probe : probes) found += on.scene.forbidden(probe) ? 1 : 0;
    asked += probes.size(), hits += found;
    return found;
  };
  const auto any = [&](const std::vector<phi::Probe>& probes) {
    std::size_t found = 0;
    for (const phi::Probe& probe : probes)
      found += std::any_of(on.everything.begin(), on.everything.end(),
                           [&](phi::BodyIndex index) { return body_forbids(on, index, probe); })
                   ? 1
                   : 0;
    return found;
  };
  std::vector<phi::BodyIndex> list;
  const auto forbidding = [&](const std::vector<phi::Probe>& probes) {
    std::size_t found = 0;
    for (const phi::Probe& probe : probes) {
      on.scene.forbidding(probe, list);
      found += list.size();
    }
    asked += probes.size(), hits += found;
    return found;
  };
  const auto all = [&](const std::vector<phi::Probe>& probes) {
    std::size_t found = 0;
    for (const phi::Probe& probe : probes)
      for (const phi::BodyIndex index : on.everything) found += body_forbids(on, index, probe) ? 1 : 0;
    return found;
  };
  const auto line = [&](const char* kind, const Rate& rate, double figure) {
    print(name, kind, rate, figure,
          asked > 0 ? 100.0 * static_cast<double>(hits) / static_cast<double>(asked) : -1);
    asked = hits = 0;
  };
  line("random", measure([&](std::size_t n) { return random_probes(on, random, n); }, forbidden, any),
       jagua.random);
  line("random, on the strip",
       measure([&](std::size_t n) { return inner_probes(on, random, n); }, forbidden, any), 0);
  line("near", measure([&](std::size_t n) { return near_probes(on, random, n); }, forbidden, any),
       jagua.near);
  line("list", measure([&](std::size_t n) { return near_probes(on, random, n); }, forbidding, all),
       jagua.list);
  const auto take_and_put = [&](const std::vector<phi::Probe>& probes) {
    for (const phi::Probe& probe : probes) {
      const phi::Body body = on.scene.body(probe.except);
      on.scene.take(probe.except);
      if (on.scene.put(body) != probe.except) std::exit(1);
    }
    return std::size_t{0};
  };
  line("take out and put in",
       measure([&](std::size_t n) { return near_probes(on, random, n); }, take_and_put,
               [](const auto&) { return std::size_t{0}; }),
       jagua.update);
  fmt::print("{:<9}memory {:.1f} MB\n", name, static_cast<double>(on.scene.bytes()) * 1e-6);
}

}  // namespace

int main(int argc, char** argv) {
  std::string data;
  if (const char* folder = std::getenv("LEKALO_SHARED_DATA")) data = folder;
  std::vector<std::string> names;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--data" && i + 1 < argc)
      data = argv[++i];
    else
      names.push_back(argument);
  }
  if (names.empty()) names = {"swim", "shirts", "jakobs1"};
  fmt::print("thousand questions a second, CPU time of one core\n");
  fmt::print("{:<9}{:<24}{:>9}{:>9}{:>9}{:>7}{:>10}{:>8}{:>9}\n", "layout", "question", "best", "first",
             "jagua", "ratio", "one by one", "ratio", "% hits");
  for (const std::string& name : names) run(data, name);
}
