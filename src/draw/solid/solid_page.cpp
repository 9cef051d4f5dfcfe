#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <string_view>

#include "draw/paper/base64.hpp"
#include "draw/paper/colour_scale.hpp"
#include "draw/paper/printed_number.hpp"
#include "draw/paper/script_text.hpp"
#include "lekalo/draw/solid_picture.hpp"
#include "lekalo/io/text/words.hpp"
#include "page_files.hpp"
#include "solid_look.hpp"

namespace lekalo::draw {
namespace {

using solid::Vector;

constexpr double kSteps = 65'535;  ///< of the largest side of the box; for showing alone

std::string vector(Vector v) { return fmt::format("[{},{},{}]", v.x, v.y, v.z); }

/// Numbers as the page's typed arrays hold them, little endian.
class Packed {
 public:
  void put16(std::uint32_t value) {
    bytes_ += static_cast<char>(value & 255);
    bytes_ += static_cast<char>(value >> 8 & 255);
  }
  void put32(std::uint32_t value) { put16(value & 0xffff), put16(value >> 16); }
  /// -1 to 1.
  void put_share(double value) {
    const long whole = std::lround(32'767 * std::clamp(value, -1.0, 1.0));
    put16(static_cast<std::uint32_t>(whole) & 0xffff);
  }
  [[nodiscard]] std::string json() const { return "\"" + base64(bytes_) + "\""; }

 private:
  std::string bytes_;
};

class Page {
 public:
  explicit Page(const SolidScene& scene)
      : scene_(scene), look_(scene), box_(solid::box_of(look_.part.surface.places)) {
    for (const Vector p : look_.blank.surface.places) box_.hold(p);
    const Vector extent = box_.high - box_.low;
    const double largest = std::max({extent.x, extent.y, extent.z});
    step_ = largest > 0 ? largest / kSteps : 1;
  }

  std::string compose() && {
    const auto& files = solid_page_files();
    std::string page(files.at("page.html"));
    // From the last place to the first: a name that looks like one of the places is not taken for it.
    put_text(page, "/* page.js */", files.at("page.js"));
    put_text(page, "\"the scene\"", json());
    put_text(page, "/* page.css */", files.at("page.css"));
    put_text(page, "the title", io::xml_text(io::file_name(scene_.part_name)));
    return page;
  }

 private:
  void field(const char* name, const std::string& value) {
    text_ += fmt::format("{}\"{}\":{}", text_.empty() ? "{" : ",\n", name, value);
  }
  template <class List, class Write>
  void list(const char* name, const List& entries, const Write& write) {
    std::string text;
    for (const auto& entry : entries) text += (text.empty() ? "" : ",") + write(entry);
    field(name, "[" + text + "]");
  }

  std::string json() {
    const Vector towards = facing(look_).towards;
    field("part", script_string(io::file_name(scene_.part_name)));
    field("blank", script_string(io::file_name(scene_.blank_name)));
    field("status", script_string(scene_.status));
    field("statusColour", script_colour(colour_of_status(scene_.status)));
    field("method", script_string(scene_.method));
    field("clearance", script_string(clearance_text(scene_, look_)));
    field("sticksOut", scene_.placement.inside ? "false" : "true");
    list("figures", figures_of(scene_, look_), [](const SolidFigure& figure) {
      return fmt::format("[{},{},{}]", script_string(figure.what), script_string(figure.value), figure.bad);
    });
    list("notes", scene_.notes, script_string);
    write_scale();
    list("key", key_of(scene_, look_), [](const SolidKey& key) {
      return fmt::format("[{},{}]", script_colour(key.colour), script_string(key.words));
    });
    field("plainPart", script_colour(kPlainPart));
    field("unknownColour", script_colour(kUnknownGlass));
    field("extent", vector(box_.high - box_.low));
    field("step", fmt::format("{}", step_));
    field("towards", vector(towards));
    write_contacts();
    field("partMesh", mesh(look_.part.surface, look_.part.values, {}));
    field("blankMesh", mesh(look_.blank.surface, {}, look_.blank.unknown));
    return text_ + "}";
  }

  void write_scale() {
    std::string palette;
    for (int k = 0; k < kColourSteps; ++k) palette += (k == 0 ? "" : ",") + script_colour(scale_colour(k));
    field("palette", "[" + palette + "]");
    ScaleTicks scale;
    if (!scene_.allowances.empty()) scale = scale_ticks(look_.range, 52, 2.7);
    field("scaleTitle", script_string(fmt::format("{}, {}", scale_words(scene_), scale.unit)));
    list("ticks", scale.ticks, [](const ScaleTicks::Tick& tick) {
      return fmt::format("[{:.4f},{}]", tick.share, script_string(tick.text));
    });
  }

  /// Writes the contacts, or the place where most is missing.
  void write_contacts() {
    std::string text;
    const auto add = [&](Vector place, Vector outward, double distance, const char* words) {
      text += fmt::format("{}{{\"place\":{},\"outward\":{},\"distance\":{},\"text\":{}}}",
                          text.empty() ? "" : ",", vector(place - box_.low), vector(outward), distance,
                          script_string(decimal(std::abs(distance), look_.table_decimals) + words));
    };
    for (std::size_t k = 0; k < look_.contacts.size(); ++k)
      add(look_.contacts[k], look_.outward(k), look_.touches[k].distance, " mm");
    const bool worst = look_.contacts.empty() && look_.focus;
    if (worst)
      add(look_.focus->place, look_.focus->outward, look_.focus->distance,
          look_.focus->distance < 0 ? " mm outside" : " mm");
    field("contacts", "[" + text + "]");
    field("contactsTitle", script_string(worst          ? "Where most is missing"
                                         : text.empty() ? "No contacts"
                                                        : "Contacts"));
  }

  /// Triangles that nobody measured come last.
  [[nodiscard]] std::string mesh(const ShadedMesh& surface, const std::vector<double>& values,
                                 const std::vector<unsigned char>& unknown) const {
    Packed places, normals, indices;
    for (std::size_t v = 0; v < surface.places.size(); ++v) {
      const Vector p = surface.places[v] - box_.low, n = surface.normals[v];
      for (const double along : {p.x, p.y, p.z})
        places.put16(static_cast<std::uint32_t>(std::lround(std::clamp(along / step_, 0.0, kSteps))));
      for (const double along : {n.x, n.y, n.z}) normals.put_share(along);
      // A vertex that is as cast has the least share, which no other has.
      const double value = values.empty() ? 0 : values[v];
      normals.put_share(std::isnan(value) ? -1 : std::max(-0.98, value));
    }
    std::size_t known = 0;
    for (const bool wanted : {false, true}) {
      for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        if ((!unknown.empty() && unknown[t] != 0) != wanted) continue;
        for (const std::uint32_t v : surface.triangles[t]) indices.put32(v);
        if (!wanted) ++known;
      }
    }
    for (const ShadedMesh::Edge& edge : surface.edges)
      if (edge.sharp) indices.put32(edge.a), indices.put32(edge.b);
    return fmt::format("{{\"places\":{},\"surface\":{},\"indices\":{},\"triangles\":{},\"known\":{}}}",
                       places.json(), normals.json(), indices.json(), surface.triangles.size(), known);
  }

  const SolidScene& scene_;
  SolidLook look_;
  solid::Box box_;
  double step_ = 1;
  std::string text_;
};

}  // namespace

std::string solid_page(const SolidScene& scene) { return Page(scene).compose(); }

}  // namespace lekalo::draw
