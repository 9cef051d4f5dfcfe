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
#include <array>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/io/nesting/nesting_files.hpp"
#include "lekalo/layout/workspace.hpp"
#include "lekalo/phi/outline_relation.hpp"
#include "lekalo/phi/scene.hpp"
#include "support/reference_overlap.hpp"

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
    auto bytes = disk::read_file(path);
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
  phi::ShapeIndex shape_count = 0;
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
  Layout made{phi::Scene(strip, 4 * document.placements.size() + 64), strip, {}, {}, {}, {}, 0};
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
  made.shape_count = 1 + static_cast<phi::ShapeIndex>(known.size());
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

/// A part moved from its own place by up to 2 % of its diameter each way, itself left out; a gap as a share
/// of it.
std::vector<phi::Probe> near_probes(const Layout& on, Random& random, std::size_t count, double gap = 0) {
  std::vector<phi::Probe> probes(count);
  for (phi::Probe& probe : probes) {
    const std::size_t i = random.below(on.bodies.size());
    const phi::Body& body = on.scene.body(on.bodies[i]);
    const double most = 0.02 * on.diameters[i];
    probe.shape = body.shape;
    probe.except = on.bodies[i];
    probe.gap = static_cast<std::int64_t>(gap * on.diameters[i]);
    probe.at = body.at + GridPoint{static_cast<std::int64_t>(random.uniform(-most, most)),
                                   static_cast<std::int64_t>(random.uniform(-most, most))};
  }
  return probes;
}

/// Ways to ask the bodies one after the other: the exact outlines, and what others do.
constexpr std::size_t kWays = 4;
constexpr std::array<const char*, kWays> kWayNames = {"exact", "fragment", "ray", "segments"};
struct References {
  explicit References(const Layout& on) {
    std::vector<const geom::GridRegion*> parts;
    for (const phi::ShapeIndex shape : on.shapes) parts.push_back(&on.scene.outline(shape));
    const std::int64_t side = phi::smallest_box_side(parts);
    for (phi::ShapeIndex shape = 0; shape < on.shape_count; ++shape)
      images.push_back(phi::fragment_image(on.scene.outline(shape), side));
  }
  std::vector<phi::FragmentImage> images;  ///< by shape
};

bool body_forbids(const Layout& on, const References& references, std::size_t way, phi::BodyIndex index,
                  const phi::Probe& probe) {
  if (index == probe.except) return false;
  const phi::Body& body = on.scene.body(index);
  const geom::GridRegion &theirs = on.scene.outline(body.shape), &ours = on.scene.outline(probe.shape);
  const GridPoint shift = probe.at - body.at;
  if (body.container)
    return !phi::lies_within(theirs, ours, shift) || phi::edges_nearer_than(theirs, ours, probe.gap, shift);
  const phi::FragmentImage &a = references.images[body.shape], &b = references.images[probe.shape];
  switch (way) {
    case 0:
      return phi::interiors_meet(theirs, ours, shift) ||
             phi::edges_nearer_than(theirs, ours, probe.gap, shift);
    case 1:
      return phi::fragment_overlap(a, b, shift);
    case 2:
      return phi::ray_overlap(a.original, b.original, shift);
    default:
      return phi::segments_overlap(a.original, b.original, shift);
  }
}

struct Rate {
  double first = 0, best = 0;  // questions a second
  std::array<double, kWays> one_by_one = {};
};

constexpr std::size_t kRounds = 13, kQuestions = 40'000, kCompared = 1'000;

using Probes = std::vector<phi::Probe>;
/// `ask` and `one_by_one` return how many bodies or probes they found.
Rate measure(const std::function<Probes(std::size_t)>& make,
             const std::function<std::size_t(const Probes&)>& ask,
             const std::function<std::size_t(const Probes&, std::size_t way)>& one_by_one) {
  Rate rate;
  for (std::size_t round = 0; round < kRounds; ++round) {
    const Probes probes = make(kQuestions);
    const double start = seconds();
    ask(probes);
    const double speed = static_cast<double>(kQuestions) / (seconds() - start);
    if (round == 0) rate.first = speed;
    rate.best = std::max(rate.best, speed);
    if (round % 4 != 0 || !one_by_one) continue;
    const Probes few = make(kCompared);
    for (std::size_t way = 0; way < (few[0].gap > 0 ? 1 : kWays); ++way) {  // the others know no gaps
      const double begin = seconds();
      const std::size_t found = one_by_one(few, way);
      rate.one_by_one[way] =
          std::max(rate.one_by_one[way], static_cast<double>(kCompared) / (seconds() - begin));
      // The other methods are wrong now and then (docs/design/layout-check.md).
      if (way == 0 && ask(few) != found) {
        fmt::print("DIFFERENT ANSWERS\n");
        std::exit(1);
      }
    }
  }
  return rate;
}

void print(const std::string& layout, const char* kind, const Rate& rate, double jagua, double share) {
  fmt::print("{:<9}{:<21}{:>8.0f}{:>8.0f}{:>8.0f}", layout, kind, rate.best * 1e-3, rate.first * 1e-3, jagua);
  fmt::print("{:>7}", jagua > 0 ? fmt::format("{:.2f}", rate.best * 1e-3 / jagua) : "");
  for (const double way : rate.one_by_one)
    fmt::print("{:>10}", way > 0 ? fmt::format("{:.1f}", rate.best / way) : "");
  fmt::print("{:>9}\n", share >= 0 ? fmt::format("{:.1f}", share) : "");
}

void run(const std::string& data, const std::string& name) {
  Layout on = make_layout(load(data, name));
  const auto published = kJagua.find(name);
  const Jagua jagua = published == kJagua.end() ? Jagua{} : published->second;
  Random random(1);
  std::size_t asked = 0, hits = 0;
  const auto forbidden = [&](const Probes& probes) {
    std::size_t found = 0;
    for (const phi::Probe& probe : probes) found += on.scene.forbidden(probe) ? 1 : 0;
    asked += probes.size(), hits += found;
    return found;
  };
  const References references(on);
  const auto any = [&](const Probes& probes, std::size_t way) {
    std::size_t found = 0;
    for (const phi::Probe& probe : probes)
      found +=
          std::any_of(on.everything.begin(), on.everything.end(),
                      [&](phi::BodyIndex index) { return body_forbids(on, references, way, index, probe); })
              ? 1
              : 0;
    return found;
  };
  std::vector<phi::BodyIndex> list;
  const auto forbidding = [&](const Probes& probes) {
    std::size_t found = 0;
    for (const phi::Probe& probe : probes) {
      on.scene.forbidding(probe, list);
      found += list.size();
    }
    asked += probes.size(), hits += found;
    return found;
  };
  const auto all = [&](const Probes& probes, std::size_t way) {
    std::size_t found = 0;
    for (const phi::Probe& probe : probes)
      for (const phi::BodyIndex index : on.everything)
        found += body_forbids(on, references, way, index, probe) ? 1 : 0;
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
  line("near, gap 1 %",
       measure([&](std::size_t n) { return near_probes(on, random, n, 0.01); }, forbidden, any), 0);
  line("list, gap 1 %",
       measure([&](std::size_t n) { return near_probes(on, random, n, 0.01); }, forbidding, all), 0);
  const auto take_and_put = [&](const Probes& probes) {
    for (const phi::Probe& probe : probes) {
      const phi::Body body = on.scene.body(probe.except);
      on.scene.take(probe.except);
      if (on.scene.put(body) != probe.except) std::exit(1);
    }
    return probes.size();
  };
  line("take out and put in",
       measure([&](std::size_t n) { return near_probes(on, random, n); }, take_and_put, nullptr),
       jagua.update);
  fmt::print("{:<9}memory {:.1f} MB\n", name, static_cast<double>(on.scene.bytes()) * 1e-6);
}

/// `count` parts in the shape of `name`'s layout, tiled; or, `turned`, every one a star in a rotation of its
/// own, placed on a lattice of squares.
struct Tiled {
  layout::Document document;
  double moved_mm = 0;  ///< 2 % of a part's diameter
};
Tiled tiled(const layout::Document& one, std::size_t count, bool turned) {
  Tiled made;
  Random random(7);
  const auto copies = static_cast<std::int64_t>(
      std::ceil(std::sqrt(static_cast<double>(count) / static_cast<double>(one.placements.size()))));
  made.document.parts = one.parts;
  geom::GridBox strip = bounds(one.stocks[0].outline.polygon);
  strip.high.x = 0;
  double diameters = 0;
  for (const layout::Placement& p : one.placements) {
    const auto outline = geom::turned(one.parts[p.part].outline.polygon, p.rotation, false);
    strip.high.x = std::max(strip.high.x, bounds(outline).high.x + p.at.x);
    diameters += diameter(outline);
  }
  made.moved_mm = 0.02 * diameters / static_cast<double>(one.placements.size()) * geom::kGridStep;
  auto& placements = made.document.placements;
  for (std::int64_t y = 0; y < copies; ++y)
    for (std::int64_t x = 0; x < copies; ++x)
      for (layout::Placement p : one.placements) {
        if (placements.size() == count) break;
        p.id = placements.size() + 1;
        p.at = p.at + GridPoint{x * strip.high.x, y * strip.high.y};
        placements.push_back(p);
      }
  if (turned)
    for (layout::Placement& p : placements)
      p.rotation = geom::rotation_from_degrees(random.uniform(-180, 180));
  if (turned)
    for (layout::Part& part : made.document.parts) part.rotations.clear();
  made.document.next_id = placements.size() + 1;
  layout::Stock stock;
  stock.id = "sheet";
  stock.outline.polygon = geom::make_grid_region({{{0, 0},
                                                   {copies * strip.high.x, 0},
                                                   {copies * strip.high.x, copies * strip.high.y},
                                                   {0, copies * strip.high.y}}})
                              .value();
  made.document.stocks.push_back(std::move(stock));
  return made;
}

/// Microseconds of each, the best of some rounds.
template <class Ask>
double microseconds(std::size_t questions, Ask&& ask) {
  double best = HUGE_VAL;
  for (int round = 0; round < 5; ++round) {
    const double start = seconds();
    for (std::size_t i = 0; i < questions; ++i) ask(i);
    best = std::min(best, (seconds() - start) / static_cast<double>(questions) * 1e6);
  }
  return best;
}

void scale(const std::string& data, bool turned) {
  const layout::Document one = load(data, "shirts");
  fmt::print("{}\n{:>8}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>11}{:>9}{:>9}\n",
             turned ? "every part in a rotation of its own, overlapping; microseconds each"
                    : "the layout shirts tiled; microseconds each",
             "parts", "drag", "random", "list", "nearest", "update", "pick", "step", "faults", "step turned",
             "bytes", "make s");
  for (std::size_t count = 10; count <= 100'000; count *= 10) {
    Tiled made = tiled(one, count, turned);
    const double start = seconds();
    layout::Workspace workspace(std::move(made.document));
    const layout::Sheet sheet{0, 0};
    const phi::Scene& scene = workspace.scene(sheet);
    const double make = seconds() - start;
    const auto& placements = workspace.document().placements;
    const geom::GridBox world = bounds(workspace.document().stocks[0].outline.polygon);
    Random random(3);
    const auto somewhere = [&] {
      return GridPoint{static_cast<std::int64_t>(random.uniform(0, static_cast<double>(world.high.x))),
                       static_cast<std::int64_t>(random.uniform(0, static_cast<double>(world.high.y)))};
    };
    constexpr std::size_t kMany = 4000;
    std::vector<layout::Placement> moved(kMany);
    std::vector<phi::Probe> near(kMany), anywhere(kMany);
    std::vector<GridPoint> points(kMany);
    // Body 0 is the stock; the others come in the order of placements.
    for (std::size_t i = 0; i < kMany; ++i) {
      const std::size_t at = random.below(count);
      layout::Placement& p = moved[i] = placements[at];
      const auto nudge = [&] { return geom::grid_from_mm(random.uniform(-made.moved_mm, made.moved_mm)); };
      p.at = p.at + GridPoint{nudge(), nudge()};
      near[i] = {.shape = workspace.shape(sheet, p),
                 .at = p.at,
                 .layers = layout::kPartLayer | layout::kBorderLayer,
                 .except = static_cast<phi::BodyIndex>(at + 1)};
      anywhere[i] = near[i];
      anywhere[i].at = points[i] = somewhere();
      anywhere[i].except = phi::kNoBody;
    }
    std::size_t sum = 0;
    std::vector<phi::BodyIndex> list;
    const double drag = microseconds(kMany, [&](std::size_t i) { sum += scene.forbidden(near[i]); });
    const double any = microseconds(kMany, [&](std::size_t i) { sum += scene.forbidden(anywhere[i]); });
    const double all = microseconds(kMany, [&](std::size_t i) {
      scene.forbidding(near[i], list);
      sum += list.size();
    });
    const double nearest = microseconds(kMany / 4, [&](std::size_t k) {
      sum += scene.nearest(near[k], geom::kGridLimit).body != phi::kNoBody ? 1 : 0;
    });
    const double pick =
        microseconds(kMany, [&](std::size_t i) { sum += workspace.at(sheet, points[i]).size(); });
    const double step =
        microseconds(kMany, [&](std::size_t i) { sum += workspace.is_clear(std::span(&moved[i], 1)); });
    const double faults = microseconds(
        kMany / 10, [&](std::size_t i) { sum += workspace.violations_of(std::span(&moved[i], 1)).size(); });
    const double update = microseconds(kMany, [&](std::size_t i) { workspace.set(moved[i]); });
    // A step that turns the part: a shape nobody has seen.
    const double new_shape = microseconds(kMany / 10, [&](std::size_t i) {
      layout::Placement p = moved[i];
      p.rotation = geom::rotation_from_degrees(random.uniform(-180, 180));
      sum += workspace.is_clear(std::span(&p, 1));
    });
    fmt::print(
        "{:>8}{:>9.3f}{:>9.3f}{:>9.3f}{:>9.3f}{:>9.3f}{:>9.3f}{:>9.3f}{:>9.2f}{:>11.2f}{:>9.0f}{:>9.3f}\n",
        count, drag, any, all, nearest, update, pick, step, faults, new_shape,
        static_cast<double>(scene.bytes()) / static_cast<double>(count), make);
    if (sum == 0) fmt::print("nothing found\n");
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::string data;
  if (const char* folder = std::getenv("LEKALO_SHARED_DATA")) data = folder;
  std::vector<std::string> names;
  bool scales = false;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--data" && i + 1 < argc)
      data = argv[++i];
    else if (argument == "--scale")
      scales = true;
    else
      names.push_back(argument);
  }
  if (scales) {
    scale(data, false);
    scale(data, true);
    return 0;
  }
  if (names.empty()) names = {"swim", "shirts", "jakobs1"};
  fmt::print("thousand questions a second, CPU time of one core; how many times faster than one by one\n");
  fmt::print("{:<9}{:<21}{:>8}{:>8}{:>8}{:>7}", "layout", "question", "best", "first", "jagua", "times");
  for (const char* way : kWayNames) fmt::print("{:>10}", way);
  fmt::print("{:>9}\n", "% found");
  for (const std::string& name : names) run(data, name);
}
