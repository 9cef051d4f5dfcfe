#include "lekalo/heat/material.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lekalo/base/double_of_text.hpp"

namespace lekalo::heat {
namespace {

constexpr double kAbsoluteZero = -273.15;  // degrees Celsius

constexpr std::array<PropertyWords, kProperties> kWords{{
    {"cutting force k_c1.1", "cutting-force", "N/mm2", {1, 10'000}},
    {"exponent m_c of the cutting force", "force-exponent", "", {0, 0.6}},
    {"conductivity", "conductivity", "W/(m K)", {0.01, 500}},
    {"density", "density", "kg/m3", {500, 25'000}},
    {"heat capacity", "heat-capacity", "J/(kg K)", {100, 5'000}},
    {"expansion", "expansion", "1/K", {1e-7, 3e-4}},
    {"Young's modulus", "youngs", "MPa", {100, 1e6}},
    {"Poisson's ratio", "poisson", "", {0, 0.49}},
    {"yield stress", "yield", "MPa", {1, 5'000}},
    {"temperature of melting", "melting", "degrees C", {40, 4'000}},
    {"glass transition", "glass", "degrees C", {40, 500}},
    {"share of the cutting power that heats the workpiece", "share", "", {0, 1}},
}};

// ISCAR's material groups by ISO 513 and VDI 3323 stand in many of its catalogues.
constexpr std::string_view kIscar =
    "ISCAR, Boring Systems 2022, material groups "
    "(docs.steelcam.org/iscar/katalog-iscar-rastochnye-sistemy-2022-page111)";
constexpr std::string_view kIscarTitanium =
    "ISCAR, material groups, group 37: 1245 and 0.24 in Boring Systems 2022 "
    "(docs.steelcam.org/iscar/katalog-iscar-rastochnye-sistemy-2022-page111), 2110 and 0.22 in Turning Tools "
    "2017 (docs.steelcam.org/iscar/katalog-tokarnyj-instrument-2017-page558)";
constexpr std::string_view kMeasured6061 =
    "least: milling 6061-T6, 243.77 + 7.53/h at h 0.05 mm, Milling Force Model for Aviation Aluminum Alloy, "
    "table 5 (doi 10.1186/s10033-021-00536-9); greatest: ISCAR, group 22 "
    "(docs.steelcam.org/iscar/katalog-iscar-rastochnye-sistemy-2022-page111)";
constexpr std::string_view kMeasured7075 =
    "milling 7075-T6, 600.46 + 17.9/h, and 7075, 1319.41 + 19.65/h, both at h 0.05 mm, Milling Force Model "
    "for "
    "Aviation Aluminum Alloy, table 5 (doi 10.1186/s10033-021-00536-9)";
constexpr std::string_view kMakeItFrom1045 = "makeitfrom.com, SAE-AISI 1045 (S45C, C45, 1.0503) Carbon Steel";
constexpr std::string_view kNineSteel = "ninesteel-cs.com, Mat. No. 1.0503";
constexpr std::string_view kGlemco = "Glemco, Aluminum 6061-T6 (typical values of the Aluminum Association)";
constexpr std::string_view kBti6061 = "btimetals.com, aluminum 6061 tubes, T6";
constexpr std::string_view kApac = "apacinfrastructure.com.au, material specifications 7075 T6";
constexpr std::string_view kMatWebTitanium = "asm.matweb.com, Ti-6Al-4V (Grade 5), annealed bar (MTP644)";
constexpr std::string_view kBtiTitanium = "btimetals.com, Ti 6Al-4V ELI";
constexpr std::string_view kMakeItFromIron = "makeitfrom.com, ISO 250, EN-JL 1040 Grey Cast Iron";
constexpr std::string_view kSnCastIron = "sn-castiron.nl, EN-GJL-250 by DIN EN 1561";
constexpr std::string_view kAcrylic = "stainlessandaluminium.co.uk, cast acrylic sheet";

constexpr Interval exactly(double value) { return {value, value}; }
constexpr Figure kUnknown{};

constexpr std::array<KnownMaterial, 6> kKnown{{
    {"C45",
     {{{{1500, 1675}, kIscar},
       {{0.22, 0.24}, kIscar},
       {{50.8, 51}, "compraco.com.br, SAE 1045, 50.8 at 100 C; makeitfrom.com, SAE-AISI 1045, 51"},
       {exactly(7850), kNineSteel},
       {{470, 486}, "makeitfrom.com, SAE-AISI 1045, 470; a179.net, SAE 1045, 486"},
       {exactly(11.5e-6), kNineSteel},
       {{205000, 210000}, "ninesteel-cs.com, 1.0503, 205; szrtjs.com, 1.0503, 210"},
       {exactly(0.29), kMakeItFrom1045},
       {{275, 340}, "Saarstahl, material specification sheet C45 (EN 10083), normalised, up to 250 mm"},
       {exactly(1420), kMakeItFrom1045},
       kUnknown,
       kUnknown}}},
    {"6061-T6",
     {{{{186, 800}, kMeasured6061},
       {exactly(0.25), kIscar},
       {exactly(167), kGlemco},
       {exactly(2700), kGlemco},
       {exactly(896), kBti6061},
       {exactly(23.6e-6), kGlemco},
       {exactly(68900), kGlemco},
       {exactly(0.33), kGlemco},
       {exactly(276), kGlemco},
       {exactly(582), kGlemco},
       kUnknown,
       kUnknown}}},
    {"7075-T6",
     {{{{453, 810}, kMeasured7075},
       {exactly(0.25), kIscar},
       {exactly(130), kApac},
       {exactly(2810), kApac},
       {{870, 960}, "makeitfrom.com, 7075-T76, 870; apacinfrastructure.com.au, 7075 T6, 960"},
       {{23.4e-6, 23.6e-6}, "btimetals.com, 7075 tubes, 23.4; apacinfrastructure.com.au, 7075 T6, 23.6"},
       {{71000, 72000}, "btimetals.com, 7075 tubes, 71.0; substech.com, alloy 7075, 72"},
       {exactly(0.33), kApac},
       {exactly(503), kApac},
       {exactly(477), kApac},
       kUnknown,
       kUnknown}}},
    {"Ti-6Al-4V",
     {{{{1245, 2110}, kIscarTitanium},
       {{0.22, 0.24}, kIscarTitanium},
       {{6.6, 6.7}, "ctemag.com, Tackling Titanium, 6.6; btimetals.com, Ti 6Al-4V ELI, 6.7"},
       {exactly(4430), kMatWebTitanium},
       {{526, 586}, "btimetals.com, Ti 6Al-4V ELI, 526; luminatitan.com, ASTM Grade 5, 586"},
       {exactly(8.6e-6), kBtiTitanium},
       {exactly(114000), kMatWebTitanium},
       {exactly(0.33), kMatWebTitanium},
       {exactly(830), kMatWebTitanium},
       {exactly(1604), kBtiTitanium},
       kUnknown,
       kUnknown}}},
    {"GJL-250",
     {{{{1150, 1350}, kIscar},
       {{0.20, 0.28}, kIscar},
       {exactly(46), kMakeItFromIron},
       {exactly(7200), kSnCastIron},
       {exactly(490), kMakeItFromIron},
       {{10.5e-6, 11e-6}, "dueker.de, cast iron with flake graphite, 10.5; makeitfrom.com, ISO 250, 11"},
       {{103000, 118000}, kSnCastIron},
       {exactly(0.26), kSnCastIron},
       {{165, 228}, "sn-castiron.nl, EN-GJL-250, 0.1 % proof stress"},
       {exactly(1180), kMakeItFromIron},
       kUnknown,
       kUnknown}}},
    {"PMMA",
     {{kUnknown,
       kUnknown,
       {exactly(0.19), kAcrylic},
       {exactly(1190), "designerdata.nl, PMMA (cast)"},
       {{1460, 1470}, "stainlessandaluminium.co.uk, cast acrylic, 1460; usplastic.com, acrylic sheet, 1470"},
       {{72e-6, 80e-6}, "usplastic.com, extruded acrylic, 72; stainlessandaluminium.co.uk, cast, 80"},
       {{2800, 3200}, kAcrylic},
       kUnknown,
       {{67, 75}, "stainlessandaluminium.co.uk, cast acrylic sheet, tensile strength"},
       kUnknown,
       {exactly(105), "designerdata.nl, PMMA (cast); matmake.com, polymethyl methacrylate"},
       kUnknown}}},
}};

constexpr std::string_view kCoolant =
    "HiAPI manual, Coolant (superhightech.com.tw/HiAPI-docsite/manual/setup/coolant.html)";
constexpr std::array<KnownCooling, 3> kCoolings{{
    {"dry", {{5, 50}, kCoolant}},
    {"mql",
     {{25, 500},
      "least: forced convection of gases, Cengel (mhhe.com/engcs/mech/cengel/notes); greatest: half of "
      "flood, HiAPI manual, Coolant"}},
    {"flood", {{1000, 3000}, kCoolant}},
}};

tl::unexpected<Error> refused(const std::string& sentence) { return failure(ErrorCode::bad_input, sentence); }

template <class Table>
std::string names_in(const Table& table) {
  std::string names;
  for (const auto& entry : table) names += (names.empty() ? "" : ", ") + std::string(entry.name);
  return names;
}

/// One of the two temperatures is enough.
bool is_needed(Property property, const std::array<std::optional<Interval>, kProperties>& found) {
  const auto has = [&](Property p) { return found[static_cast<std::size_t>(p)].has_value(); };
  if (property == Property::melting) return !has(Property::glass);
  return property != Property::glass;
}

}  // namespace

const PropertyWords& words_of(Property property) noexcept {
  return kWords[static_cast<std::size_t>(property)];
}

std::span<const KnownMaterial> known_materials() noexcept { return kKnown; }

const KnownMaterial* known_material(std::string_view name) noexcept {
  const auto* const at =
      std::find_if(kKnown.begin(), kKnown.end(), [&](const KnownMaterial& m) { return m.name == name; });
  return at == kKnown.end() ? nullptr : at;
}

double Material::limit_c() const noexcept {
  const double glass = (*this)[Property::glass].least, melting = (*this)[Property::melting].least;
  return glass > 0 ? glass : (melting - kAbsoluteZero) / 2 + kAbsoluteZero;
}

Result<Material> material_of(const MaterialWords& words) {
  const KnownMaterial* known = nullptr;
  if (!words.name.empty() && (known = known_material(words.name)) == nullptr)
    return refused(fmt::format("{}: no such material; there are {}, or name none and state all figures",
                               words.name, names_in(kKnown)));
  std::array<std::optional<Interval>, kProperties> found = words.stated;
  for (std::size_t i = 0; i < kProperties; ++i)
    if (!found[i] && known != nullptr && known->figures[i].known()) found[i] = known->figures[i].value;
  Material material{words.name.empty() ? "as stated" : words.name, {}};
  std::string missing;
  for (std::size_t i = 0; i < kProperties; ++i)
    if (!found[i] && is_needed(static_cast<Property>(i), found))
      missing += fmt::format("{}--{} ({}{}{})", missing.empty() ? "" : ", ", kWords[i].option, kWords[i].name,
                             kWords[i].unit.empty() ? "" : ", ", kWords[i].unit);
  if (!missing.empty())
    return refused(fmt::format("{}: what no public source is known to say has to be stated: {}",
                               material.name, missing));
  for (std::size_t i = 0; i < kProperties; ++i) {
    if (!found[i]) continue;
    const PropertyWords& property = kWords[i];
    const Interval value = *found[i];
    if (!(value.least >= property.range.least && value.least <= value.greatest &&
          value.greatest <= property.range.greatest))
      return refused(fmt::format("{}: the {} is {:g} to {:g}; it has to be from {:g} to {:g}{}{}",
                                 material.name, property.name, value.least, value.greatest,
                                 property.range.least, property.range.greatest,
                                 property.unit.empty() ? "" : " ", property.unit));
    material.values[i] = value;
  }
  return material;
}

std::span<const KnownCooling> known_coolings() noexcept { return kCoolings; }

std::optional<Interval> read_interval(std::string_view words) {
  const std::size_t dots = words.find("..");
  const auto number = [](std::string_view text) -> std::optional<double> {
    const std::optional<double> value = double_of_text(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
  };
  const std::optional<double> least = number(words.substr(0, dots));
  const std::optional<double> greatest =
      dots == std::string_view::npos ? least : number(words.substr(dots + 2));
  if (!least || !greatest || !(*least <= *greatest)) return std::nullopt;
  return Interval{*least, *greatest};
}

Result<Interval> film_of(std::string_view words) {
  constexpr double kGreatestFilm = 100'000;
  for (const KnownCooling& cooling : kCoolings)
    if (cooling.name == words) return cooling.film.value;
  const std::optional<Interval> film = read_interval(words);
  if (!film || !(film->least >= 0 && film->greatest <= kGreatestFilm))
    return refused(
        fmt::format("{}: no such cooling; there are {}, or a figure from 0 to {:g} W/m2K, or two as "
                    "in 20..60",
                    words, names_in(kCoolings), kGreatestFilm));
  return *film;
}

}  // namespace lekalo::heat
