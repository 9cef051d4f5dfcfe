#include <fmt/core.h>

#include <string>
#include <string_view>
#include <vector>

#include "draw/paper/base64.hpp"
#include "draw/paper/colour.hpp"
#include "draw/paper/script_text.hpp"
#include "heat_page_files.hpp"
#include "lekalo/draw/heat_scene.hpp"
#include "lekalo/io/text/words.hpp"
#include "region_rings.hpp"

namespace lekalo::draw {
namespace {

/// The data of the page as JSON.
class HeatPageData {
 public:
  explicit HeatPageData(const HeatScene& scene) : scene_(scene) {}

  std::string json() && {
    field("name", script_string(scene_.name));
    field("title", script_string(scene_.title[1]));
    field("low", fmt::format("{:.6g}", scene_.warmest.least));
    field("high", fmt::format("{:.6g}", scene_.warmest.greatest));
    field("most", script_string(scene_.warmest.most));
    field("seconds", fmt::format("{:.3f}", scene_.seconds));
    field("radius", fmt::format("{:.6g}", scene_.tool_diameter / 2));
    const geom::Box& box = scene_.stock;
    field("stock", fmt::format("[{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f}]", box.low.x, box.low.y,
                               scene_.low_z, box.high.x, box.high.y, scene_.high_z));
    field("count",
          fmt::format("[{},{},{}]", scene_.moment_count[0], scene_.moment_count[1], scene_.moment_count[2]));
    field("size", fmt::format("[{:.4f},{:.4f},{:.4f}]", scene_.moment_size[0], scene_.moment_size[1],
                              scene_.moment_size[2]));
    std::string palette;
    for (int k = 0; k < kColourSteps; ++k)
      palette += (k == 0 ? "" : ",") + script_colour(scale_colour(kColourSteps - 1 - k));
    field("palette", "[" + palette + "]");
    field("pockets", rings(scene_.pockets));
    field("outline", rings(scene_.outline));
    write_moments();
    write_path();
    return text_ + "}";
  }

 private:
  void field(const char* name, const std::string& value) {
    text_ += fmt::format("{}\"{}\":{}", text_.empty() ? "{" : ",\n", name, value);
  }

  static std::string rings(const std::vector<geom::Region>& regions) {
    std::string text;
    for (const geom::Ring& ring : region_rings(regions, 0.02, 5)) {
      std::string points;
      for (const geom::Point p : ring)
        points += fmt::format("{}[{:.3f},{:.3f}]", points.empty() ? "" : ",", p.x, p.y);
      text += fmt::format("{}[{}]", text.empty() ? "" : ",", points);
    }
    return "[" + text + "]";
  }

  void write_moments() {
    std::string times, warmest, above, front;
    for (const HeatMoment& moment : scene_.moments) {
      times += fmt::format("{}{:.3f}", times.empty() ? "" : ",", moment.seconds);
      warmest += fmt::format("{}{:.3f}", warmest.empty() ? "" : ",", moment.warmest);
      above.append(moment.from_above.begin(), moment.from_above.end());
      front.append(moment.from_front.begin(), moment.from_front.end());
    }
    field("times", "[" + times + "]");
    field("warmest", "[" + warmest + "]");
    field("above", "\"" + base64(above) + "\"");
    field("front", "\"" + base64(front) + "\"");
  }

  void write_path() {
    std::string path;
    for (const HeatToolPlace& p : scene_.path)
      path +=
          fmt::format("{}{:.2f},{:.3f},{:.3f},{:.3f}", path.empty() ? "" : ",\n", p.seconds, p.x, p.y, p.z);
    field("path", "[" + path + "]");
  }

  const HeatScene& scene_;
  std::string text_;
};

}  // namespace

std::string heat_page(const HeatScene& scene) {
  const auto& files = heat_page_files();
  std::string page(files.at("page.html"));
  // From the last place to the first: a name that looks like one of the places is not taken for it.
  put_text(page, "/* page.js */", files.at("page.js"));
  put_text(page, "\"the scene\"", HeatPageData(scene).json());
  put_text(page, "/* page.css */", files.at("page.css"));
  put_text(page, "the title", io::xml_text("Heat of " + scene.name));
  return page;
}

}  // namespace lekalo::draw
