#include "lekalo/heat/material.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

namespace lekalo::heat::heat_material_test {
namespace {

TEST(HeatMaterial, EveryFigureHasASourceAndLiesWhereMaterialsDo) {
  std::set<std::string_view> names;
  for (const KnownMaterial& material : known_materials()) {
    EXPECT_TRUE(names.insert(material.name).second) << material.name;
    for (std::size_t i = 0; i < kProperties; ++i) {
      const auto property = static_cast<Property>(i);
      SCOPED_TRACE(std::string(material.name) + ", " + std::string(words_of(property).name));
      const Figure& figure = material[property];
      if (!figure.known()) {
        EXPECT_EQ(figure.value, (Interval{}));
        continue;
      }
      // A source is a page or a paper with its publisher, not a word.
      EXPECT_GE(figure.source.size(), 20U);
      EXPECT_NE(figure.source.find_first_of(",("), std::string_view::npos) << figure.source;
      EXPECT_LE(words_of(property).range.least, figure.value.least);
      EXPECT_LE(figure.value.least, figure.value.greatest);
      EXPECT_LE(figure.value.greatest, words_of(property).range.greatest);
    }
  }
  EXPECT_EQ(names.size(), 6U);
}

TEST(HeatMaterial, FiguresHangTogetherAsThoseOfSolidsDo) {
  for (const KnownMaterial& m : known_materials()) {
    SCOPED_TRACE(m.name);
    // Diffusivity, mm2/s: from plastics to light metals.
    const double diffusivity =
        1e6 * m[Property::conductivity].value.middle() /
        (m[Property::density].value.middle() * m[Property::heat_capacity].value.middle());
    EXPECT_GT(diffusivity, 0.09);
    EXPECT_LT(diffusivity, 75);
    // Yield is reached at a strain of 0.1 to 3 %.
    const double strain = m[Property::yield].value.least / m[Property::youngs].value.middle();
    EXPECT_GT(strain, 0.001);
    EXPECT_LT(strain, 0.03);
    EXPECT_NE(m[Property::melting].known(), m[Property::glass].known());
  }
}

TEST(HeatMaterial, CoolingsHaveSourcesAndGrow) {
  double before = 0;
  for (const KnownCooling& cooling : known_coolings()) {
    EXPECT_TRUE(cooling.film.known()) << cooling.name;
    EXPECT_GT(cooling.film.value.middle(), before) << cooling.name;
    before = cooling.film.value.middle();
  }
  EXPECT_EQ(film_of("flood")->least, 1000);
  EXPECT_EQ(*film_of("20"), (Interval{20, 20}));
  EXPECT_EQ(*film_of("20..60"), (Interval{20, 60}));
  for (const char* wrong : {"wet", "", "60..20", "-1", "1e9", "20..", "..20", "nan", "20..60..80"})
    EXPECT_EQ(film_of(wrong).error().message, std::string(wrong) +
                                                  ": no such cooling; there are dry, mql, flood, or a figure "
                                                  "from 0 to 100000 W/m2K, or two as in 20..60");
}

MaterialWords named(const char* name) { return {name, {}}; }
void state(MaterialWords& words, Property property, Interval value) {
  words.stated[static_cast<std::size_t>(property)] = value;
}

TEST(HeatMaterial, WhatNoSourceSaysIsAskedFor) {
  EXPECT_EQ(material_of(named("6061-T6")).error().message,
            "6061-T6: what no public source is known to say has to be stated: --share (share of the cutting "
            "power that heats the workpiece)");
  EXPECT_EQ(
      material_of(named("PMMA")).error().message,
      "PMMA: what no public source is known to say has to be stated: --cutting-force (cutting force "
      "k_c1.1, N/mm2), --force-exponent (exponent m_c of the cutting force), --poisson (Poisson's ratio), "
      "--share (share of the cutting power that heats the workpiece)");
  MaterialWords words = named("PMMA");
  state(words, Property::cutting_force, {100, 200});
  state(words, Property::force_exponent, {0.2, 0.2});
  state(words, Property::share, {0.1, 0.3});
  EXPECT_EQ(material_of(words).error().message,
            "PMMA: what no public source is known to say has to be stated: --poisson (Poisson's ratio)");
  state(words, Property::poisson, {0.37, 0.37});
  ASSERT_TRUE(material_of(words));
  EXPECT_EQ(material_of(words)->limit_c(), 105);
}

TEST(HeatMaterial, StatedFiguresGoBeforeThoseOfTheTable) {
  MaterialWords words = named("C45");
  state(words, Property::share, {0.05, 0.25});
  state(words, Property::conductivity, {42, 44});
  const auto material = material_of(words);
  ASSERT_TRUE(material);
  EXPECT_EQ((*material)[Property::conductivity], (Interval{42, 44}));
  EXPECT_EQ((*material)[Property::cutting_force], (Interval{1500, 1675}));
  // Half of 1420 C, from absolute zero.
  EXPECT_NEAR(material->limit_c(), (1420 + 273.15) / 2 - 273.15, 1e-9);
}

TEST(HeatMaterial, NumbersAloneMakeAMaterial) {
  MaterialWords words;
  EXPECT_NE(material_of(words).error().message.find("--melting (temperature of melting, degrees C), --share"),
            std::string::npos);
  for (std::size_t i = 0; i < kProperties; ++i) {
    if (static_cast<Property>(i) == Property::glass) continue;
    const Interval range = words_of(static_cast<Property>(i)).range;
    words.stated[i] = Interval{range.least, range.middle()};
  }
  ASSERT_TRUE(material_of(words));
  EXPECT_EQ(material_of(words)->name, "as stated");
}

TEST(HeatMaterial, WrongNamesAndFiguresAreRefused) {
  EXPECT_EQ(
      material_of(named("6061")).error().message,
      "6061: no such material; there are C45, 6061-T6, 7075-T6, Ti-6Al-4V, GJL-250, PMMA, or name none and "
      "state all figures");
  for (const Interval wrong : {Interval{0.3, 0.2}, {-0.1, 0.2}, {0.1, 1.2}, {0.1, std::nan("")}}) {
    MaterialWords words = named("6061-T6");
    state(words, Property::share, wrong);
    const auto material = material_of(words);
    ASSERT_FALSE(material);
    EXPECT_EQ(material.error().code, ErrorCode::bad_input);
    EXPECT_NE(material.error().message.find("it has to be from 0 to 1"), std::string::npos);
  }
}

}  // namespace
}  // namespace lekalo::heat::heat_material_test
