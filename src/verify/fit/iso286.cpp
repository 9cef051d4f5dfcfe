#include "iso286.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <vector>

namespace lekalo::verify {
namespace {

/// Each column of the table as text: its values at the sizes of its kind, "-" where there is none.
struct Column {
  std::string_view name, values;
};

constexpr std::string_view kSteps =
    "3 6 10 14 18 24 30 40 50 65 80 100 120 140 160 180 200 225 250 280 315 355 400 450 500";
constexpr std::string_view kGradeSteps = "3 6 10 18 30 50 80 120 180 250 315 400 500";

/// Shafts: the deviation that is nearer to the nominal size; k in the grades 4 to 7.
constexpr std::array kShafts = std::to_array<Column>(
    {{"a",
      "-270 -270 -280 -290 -290 -300 -300 -310 -320 -340 -360 -380 -410 -460 -520 -580 -660 "
      "-740 -820 -920 -1050 -1200 -1350 -1500 -1650"},
     {"b",
      "-140 -140 -150 -150 -150 -160 -160 -170 -180 -190 -200 -220 -240 -260 -280 -310 -340 "
      "-380 -420 -480 -540 -600 -680 -760 -840"},
     {"c",
      "-60 -70 -80 -95 -95 -110 -110 -120 -130 -140 -150 -170 -180 -200 -210 -230 -240 -260 "
      "-280 -300 -330 -360 -400 -440 -480"},
     {"cd", "-34 -46 -56 - - - - - - - - - - - - - - - - - - - - - -"},
     {"d",
      "-20 -30 -40 -50 -50 -65 -65 -80 -80 -100 -100 -120 -120 -145 -145 -145 -170 -170 -170 "
      "-190 -190 -210 -210 -230 -230"},
     {"e",
      "-14 -20 -25 -32 -32 -40 -40 -50 -50 -60 -60 -72 -72 -85 -85 -85 -100 -100 -100 -110 -110 "
      "-125 -125 -135 -135"},
     {"ef", "-10 -14 -18 - - - - - - - - - - - - - - - - - - - - - -"},
     {"f",
      "-6 -10 -13 -16 -16 -20 -20 -25 -25 -30 -30 -36 -36 -43 -43 -43 -50 -50 -50 -56 -56 -62 "
      "-62 -68 -68"},
     {"fg", "-4 -6 -8 - - - - - - - - - - - - - - - - - - - - - -"},
     {"g",
      "-2 -4 -5 -6 -6 -7 -7 -9 -9 -10 -10 -12 -12 -14 -14 -14 -15 -15 -15 -17 -17 -18 -18 -20 "
      "-20"},
     {"k", "0 1 1 1 1 2 2 2 2 2 2 3 3 3 3 3 4 4 4 4 4 4 4 5 5"},
     {"m", "2 4 6 7 7 8 8 9 9 11 11 13 13 15 15 15 17 17 17 20 20 21 21 23 23"},
     {"n", "4 8 10 12 12 15 15 17 17 20 20 23 23 27 27 27 31 31 31 34 34 37 37 40 40"},
     {"p", "6 12 15 18 18 22 22 26 26 32 32 37 37 43 43 43 50 50 50 56 56 62 62 68 68"},
     {"r", "10 15 19 23 23 28 28 34 34 41 43 51 54 63 65 68 77 80 84 94 98 108 114 126 132"},
     {"s", "14 19 23 28 28 35 35 43 43 53 59 71 79 92 100 108 122 130 140 158 170 190 208 232 252"},
     {"t", "- - - - - - 41 48 54 66 75 91 104 122 134 146 166 180 196 218 240 268 294 330 360"},
     {"u",
      "18 23 28 33 33 41 48 60 70 87 102 124 144 170 190 210 236 258 284 315 350 390 435 490 "
      "540"},
     {"v", "- - - - 39 47 55 68 81 102 120 146 172 202 228 252 284 310 340 385 425 475 530 595 660"},
     {"x",
      "20 28 34 40 45 54 64 80 97 122 146 178 210 248 280 310 350 385 425 475 525 590 660 740 "
      "820"},
     {"y", "- - - - - 63 75 94 114 144 174 214 254 300 340 380 425 470 520 580 650 730 820 920 1000"},
     {"z",
      "26 35 42 50 60 73 88 112 136 172 210 258 310 365 415 465 520 575 640 710 790 900 1000 "
      "1100 1250"},
     {"za",
      "32 42 52 64 77 98 118 148 180 226 274 335 400 470 535 600 670 740 820 920 1000 1150 1300 "
      "1450 1600"},
     {"zb",
      "40 50 67 90 108 136 160 200 242 300 360 445 525 620 700 780 880 960 1050 1200 1300 1500 "
      "1650 1850 2100"},
     {"zc",
      "60 80 97 130 150 188 218 274 325 405 480 585 690 800 900 1000 1150 1250 1350 1550 1700 "
      "1900 2100 2400 2600"}});

/// Grades, and the transition zones j.
constexpr std::array kGrades =
    std::to_array<Column>({{"01", "0.3 0.4 0.4 0.5 0.6 0.6 0.8 1 1.2 2 2.5 3 4"},
                           {"0", "0.5 0.6 0.6 0.8 1 1 1.2 1.5 2 3 4 5 6"},
                           {"1", "0.8 1 1 1.2 1.5 1.5 2 2.5 3.5 4.5 6 7 8"},
                           {"2", "1.2 1.5 1.5 2 2.5 2.5 3 4 5 7 8 9 10"},
                           {"3", "2 2.5 2.5 3 4 4 5 6 8 10 12 13 15"},
                           {"4", "3 4 4 5 6 7 8 10 12 14 16 18 20"},
                           {"5", "4 5 6 8 9 11 13 15 18 20 23 25 27"},
                           {"6", "6 8 9 11 13 16 19 22 25 29 32 36 40"},
                           {"7", "10 12 15 18 21 25 30 35 40 46 52 57 63"},
                           {"8", "14 18 22 27 33 39 46 54 63 72 81 89 97"},
                           {"9", "25 30 36 43 52 62 74 87 100 115 130 140 155"},
                           {"10", "40 48 58 70 84 100 120 140 160 185 210 230 250"},
                           {"11", "60 75 90 110 130 160 190 220 250 290 320 360 400"},
                           {"12", "100 120 150 180 210 250 300 350 400 460 520 570 630"},
                           {"13", "140 180 220 270 330 390 460 540 630 720 810 890 970"},
                           {"14", "250 300 360 430 520 620 740 870 1000 1150 1300 1400 1550"},
                           {"15", "400 480 580 700 840 1000 1200 1400 1600 1850 2100 2300 2500"},
                           {"16", "600 750 900 1100 1300 1600 1900 2200 2500 2900 3200 3600 4000"},
                           {"17", "1000 1200 1500 1800 2100 2500 3000 3500 4000 4600 5200 5700 6300"},
                           {"18", "1400 1800 2200 2700 3300 3900 4600 5400 6300 7200 8100 8900 9700"},
                           {"J6", "2 5 5 6 8 10 13 16 18 22 25 29 33"},
                           {"J7", "4 6 8 10 12 14 18 22 26 30 36 39 43"},
                           {"J8", "6 10 12 15 20 24 28 34 41 47 55 60 66"},
                           {"j5", "-2 -2 -2 -3 -4 -5 -7 -9 -11 -13 -16 -18 -20"},
                           {"j6", "-2 -2 -2 -3 -4 -5 -7 -9 -11 -13 -16 -18 -20"},
                           {"j7", "-4 -4 -5 -6 -8 -10 -12 -15 -18 -21 -26 -28 -32"},
                           {"j8", "-6 - - - - - - - - - - - -"}});

std::optional<double> number(std::string_view word) {
  double value = 0;
  const char* const end = word.data() + word.size();
  if (std::from_chars(word.data(), end, value).ptr != end) return {};
  return value;
}

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    words.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

template <std::size_t N>
std::optional<double> entry(const std::array<Column, N>& columns, std::string_view name,
                            std::string_view steps, double diameter) {
  for (const Column& column : columns) {
    if (column.name != name) continue;
    const std::vector<std::string_view> sizes = words_of(steps), values = words_of(column.values);
    for (std::size_t i = 0; i < sizes.size(); ++i)
      if (diameter <= *number(sizes[i])) return number(values[i]);
  }
  return {};
}

std::string with(std::string_view zone, std::string_view grade) {
  return std::string(zone) + std::string(grade);
}

std::string lowered(std::string_view zone) {
  std::string low(zone);
  for (char& c : low) c = static_cast<char>(c | 0x20);
  return low;
}

std::string raised(std::string_view zone) {
  std::string high(zone);
  for (char& c : high) c = static_cast<char>(c & ~0x20);
  return high;
}

/// The upper deviation of a hole from K to ZC: the shaft's mirrored, and in fine grades what the grade is
/// wider than the next finer one.
std::optional<double> upper_of_hole(double diameter, std::string_view zone, int grade, double shaft) {
  const bool near = zone == "K" || zone == "M" || zone == "N";
  if (grade <= (near ? 8 : 7)) {
    if (diameter <= 3) return -shaft;
    if (zone == "M" && grade == 6 && diameter > 250 && diameter <= 315) return -9;
    if (grade < 3) return {};
    const std::optional<double> own = entry(kGrades, std::to_string(grade), kGradeSteps, diameter);
    const std::optional<double> finer = entry(kGrades, std::to_string(grade - 1), kGradeSteps, diameter);
    return *own - *finer - shaft;
  }
  if (diameter > 3 && zone == "K") return {};
  if (zone == "N" && diameter <= 1) return {};
  if (zone == "N" && diameter > 3) return 0;
  return -shaft;
}

}  // namespace

std::optional<ClassLimits> iso286_limits(double diameter_mm, std::string_view tolerance_class) {
  if (!(diameter_mm > 0)) return {};  // the steps end at 500 mm
  const std::size_t cut = tolerance_class.find_first_of("0123456789");
  if (cut == std::string_view::npos || cut == 0) return {};
  const std::string_view zone = tolerance_class.substr(0, cut), grade = tolerance_class.substr(cut);
  const std::optional<double> width = entry(kGrades, grade, kGradeSteps, diameter_mm);
  if (!width) return {};
  const int count = grade == "01" ? -1 : static_cast<int>(*number(grade));
  const bool hole = zone[0] < 'a';
  const std::string shaft = lowered(zone);
  if (diameter_mm <= 1 && (count >= 14 || shaft == "a" || shaft == "b")) return {};
  if (zone == "JS" || zone == "js") return ClassLimits{-*width / 2, *width / 2};
  if (zone == "H") return ClassLimits{0, *width};
  if (zone == "h") return ClassLimits{-*width, 0};
  if (shaft == "j") {
    const std::optional<double> one = entry(kGrades, with(zone, grade), kGradeSteps, diameter_mm);
    if (!one) return {};
    return hole ? ClassLimits{*one - *width, *one} : ClassLimits{*one, *one + *width};
  }
  std::optional<double> one = entry(kShafts, shaft, kSteps, diameter_mm);
  if (!one || zone != (hole ? raised(shaft) : shaft)) return {};
  if (*one < 0) return hole ? ClassLimits{-*one, -*one + *width} : ClassLimits{*one - *width, *one};
  if (!hole) {
    if (shaft == "k" && (count < 4 || count > 7)) one = 0;
    return ClassLimits{*one, *one + *width};
  }
  const std::optional<double> upper = upper_of_hole(diameter_mm, zone, count, *one);
  if (!upper) return {};
  return ClassLimits{*upper - *width, *upper};
}

}  // namespace lekalo::verify
