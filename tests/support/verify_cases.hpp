#pragma once

// Results of `lekalo locate`, written without lekalo: a small solver of its own (every triple of edges at
// every angle, long double) and a writer whose every field a test can falsify.

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/verify/verify.hpp"

namespace lekalo::verify_cases {

using Real = long double;
using Points = std::vector<std::array<double, 2>>;

struct Case {
  std::string name;
  Points blank, part;
  double optimum = 0;
};

/// The six published examples; optima to 9 digits.
inline std::vector<Case> examples() {
  const Points a{{48.0, 146.0}, {46.0, 155.0}, {44.0, 162.0}, {40.0, 164.0}, {33.0, 163.0},
                 {26.0, 160.0}, {24.0, 155.0}, {25.0, 150.0}, {32.0, 145.0}, {39.0, 144.0}};
  const Points b{{87.0, 152.0}, {83.0, 153.0}, {78.0, 154.0}, {72.0, 154.0}, {68.0, 153.0}, {66.0, 152.0},
                 {63.0, 149.0}, {62.0, 147.0}, {61.5, 145.0}, {61.0, 137.0}, {63.0, 133.0}, {65.0, 130.0},
                 {70.0, 129.0}, {76.0, 130.0}, {80.0, 132.0}, {84.0, 139.0}, {86.0, 146.0}};
  const Points p1{{43.2, 131.4}, {41.4, 139.5}, {39.6, 145.8}, {36.0, 147.6}, {29.7, 146.7},
                  {23.4, 144.0}, {21.6, 139.5}, {22.5, 135.0}, {28.8, 130.5}, {35.1, 129.6}};
  const Points p2{{40.8, -124.1}, {39.1, -131.75}, {37.4, -137.7},  {34.0, -139.4},  {28.05, -138.55},
                  {22.1, -136.0}, {20.4, -131.75}, {21.25, -127.5}, {27.2, -123.25}, {33.15, -122.4}};
  Points p4 = a;
  for (auto& p : p4) p[1] = -p[1];
  const Points p5{{60.9, 106.4}, {58.1, 107.1}, {54.6, 107.8},  {50.4, 107.8}, {47.6, 107.1}, {46.2, 106.4},
                  {44.1, 104.3}, {43.4, 102.9}, {43.05, 101.5}, {42.7, 95.9},  {44.1, 93.1},  {45.5, 91.0},
                  {49.0, 90.3},  {53.2, 91.0},  {56.0, 92.4},   {58.8, 97.3},  {60.2, 102.2}};
  Points p6 = p5;
  for (auto& p : p6) p[1] = -p[1];
  return {{"example-1", a, p1, 0.946928020}, {"example-2", a, p2, 0.429429599},
          {"example-3", b, a, 0.882092590},  {"example-4", b, p4, 0.661610645},
          {"example-5", a, p5, 1.081789926}, {"example-6", a, p6, 0.671113798}};
}

inline std::string text_of(double value) { return fmt::format("{}", value); }

// ---- a solver for tests -----------------------------------------------------------------------------------

struct Contact {
  std::size_t part_vertex = 0, blank_edge = 0;
  Real multiplier = 0;
};

struct Basis {
  std::array<Contact, 3> contacts;
  Real x = 0, y = 0, value = 0;             ///< the best shift at the angle asked for
  Real constant = 0, cosine = 0, sine = 0;  ///< its bound at every angle
};

inline Real signed_area(const Points& p) {
  Real area = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto &a = p[i], &b = p[(i + 1) % p.size()];
    area += (Real(a[0]) - p[0][0]) * (Real(b[1]) - p[0][1]) - (Real(b[0]) - p[0][0]) * (Real(a[1]) - p[0][1]);
  }
  return area;
}

struct Line {
  Real ax, ay, nx, ny;
};

/// Edges in file order, material on the left.
inline std::vector<Line> lines_of(const Points& blank) {
  const bool ccw = signed_area(blank) > 0;
  std::vector<Line> lines;
  for (std::size_t k = 0; k < blank.size(); ++k) {
    auto a = blank[k], b = blank[(k + 1) % blank.size()];
    if (!ccw) std::swap(a, b);
    const Real ex = Real(b[0]) - a[0], ey = Real(b[1]) - a[1], length = std::sqrt(ex * ex + ey * ey);
    lines.push_back({Real(a[0]), Real(a[1]), -ey / length, ex / length});
  }
  return lines;
}

inline Basis best_basis(const std::vector<Line>& lines, const Points& part, Real theta) {
  const Real c = std::cos(theta), s = std::sin(theta);
  const std::size_t n = lines.size();
  std::vector<Real> room(n);
  std::vector<std::size_t> nearest(n);
  for (std::size_t k = 0; k < n; ++k) {
    room[k] = std::numeric_limits<Real>::infinity();
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Real x = c * part[i][0] - s * part[i][1] - lines[k].ax,
                 y = s * part[i][0] + c * part[i][1] - lines[k].ay;
      const Real d = lines[k].nx * x + lines[k].ny * y;
      if (d < room[k]) room[k] = d, nearest[k] = i;
    }
  }
  const auto turn = [&](std::size_t i, std::size_t j) {
    return lines[i].nx * lines[j].ny - lines[i].ny * lines[j].nx;
  };
  // Any three edges whose normals balance bound the clearance; the least bound is reached by some shift. When
  // two opposite edges alone give it, the third says nothing about the bound, but must be the one that holds
  // the shift.
  Basis best;
  best.value = std::numeric_limits<Real>::infinity();
  Real reached = -std::numeric_limits<Real>::infinity();
  for (const bool choose : {false, true}) {
    const Real least = best.value;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = i + 1; j < n; ++j) {
        for (std::size_t k = j + 1; k < n; ++k) {
          const Real a = turn(j, k), b = turn(k, i), d = turn(i, j), sum = a + b + d;
          // An exactly opposite pair comes out as a rounding of 0.
          constexpr Real kZero = -1e-17L;
          if (!(a * sum >= kZero && b * sum >= kZero && d * sum >= kZero) || std::abs(sum) < 1e-9L) continue;
          const Real value = (a * room[i] + b * room[j] + d * room[k]) / sum;
          if (!choose) best.value = std::min(best.value, value);
          if (!choose || value > least + 1e-14L * std::abs(least)) continue;
          // n . shift = value - room for all three: Cramer's rule on a pair that is not parallel.
          std::size_t p = i, q = j;
          if (std::abs(turn(j, k)) > std::abs(turn(p, q))) p = j, q = k;
          if (std::abs(turn(k, i)) > std::abs(turn(p, q))) p = k, q = i;
          const Real u = value - room[p], v = value - room[q];
          const Real x = (u * lines[q].ny - v * lines[p].ny) / turn(p, q);
          const Real y = (lines[p].nx * v - lines[q].nx * u) / turn(p, q);
          Real worst = std::numeric_limits<Real>::infinity();
          for (std::size_t e = 0; e < n; ++e)
            worst = std::min(worst, room[e] + lines[e].nx * x + lines[e].ny * y);
          if (worst <= reached) continue;
          reached = worst;
          best.x = x;
          best.y = y;
          best.contacts = {Contact{nearest[i], i, a / sum}, Contact{nearest[j], j, b / sum},
                           Contact{nearest[k], k, d / sum}};
        }
      }
    }
  }
  for (const Contact& contact : best.contacts) {
    const Line& l = lines[contact.blank_edge];
    const auto& v = part[contact.part_vertex];
    best.constant -= contact.multiplier * (l.nx * l.ax + l.ny * l.ay);
    best.cosine += contact.multiplier * (l.nx * v[0] + l.ny * v[1]);
    best.sine += contact.multiplier * (l.ny * v[0] - l.nx * v[1]);
  }
  return best;
}

inline Real sinusoid_maximum(const Basis& b, Real from, Real to) {
  const Real crest = std::atan2(b.sine, b.cosine), turn = 2 * std::numbers::pi_v<Real>;
  const auto at = [&b](Real t) { return b.constant + b.cosine * std::cos(t) + b.sine * std::sin(t); };
  const Real first = crest + turn * std::ceil((from - crest) / turn);
  return first <= to ? b.constant + std::hypot(b.cosine, b.sine) : std::max(at(from), at(to));
}

/// Least signed distance of a part vertex from a blank edge's line, straight from the definition.
inline Real clearance_at(const Points& blank, const Points& part, Real x, Real y, Real theta) {
  Real least = std::numeric_limits<Real>::infinity();
  const Real c = std::cos(theta), s = std::sin(theta);
  for (const Line& l : lines_of(blank)) {
    for (const auto& v : part) {
      least =
          std::min(least, l.nx * (c * v[0] - s * v[1] + x - l.ax) + l.ny * (s * v[0] + c * v[1] + y - l.ay));
    }
  }
  return least;
}

struct Piece {
  double from = 0, to = 0;
  Basis basis;
};

struct Solution {
  double x = 0, y = 0, theta = 0, clearance = 0, upper_bound = 0;
  Basis basis;
  std::vector<Piece> pieces;
};

/// Largest |coordinate|, for rounding allowances.
inline Real scale_of(const Points& a, const Points& b) {
  Real scale = 0;
  for (const Points* points : {&a, &b}) {
    for (const auto& p : *points) scale = std::max({scale, std::abs(Real(p[0])), std::abs(Real(p[1]))});
  }
  return scale;
}

inline Solution solve(const Case& c, double from = 0, double to = 6.283185307179587, Real gap = 1e-7L) {
  const std::vector<Line> lines = lines_of(c.blank);
  Solution best;
  Real best_value = -std::numeric_limits<Real>::infinity(), bound = best_value;
  std::vector<std::pair<double, double>> stack;
  constexpr int kFirst = 64;
  for (int i = kFirst; i-- > 0;) {
    const double a = from + (to - from) * i / kFirst,
                 b = i + 1 == kFirst ? to : from + (to - from) * (i + 1) / kFirst;
    stack.emplace_back(a, b);
  }
  for (const auto& [a, b] : stack) {
    const double middle = a + (b - a) / 2;
    const Basis basis = best_basis(lines, c.part, middle);
    if (basis.value > best_value) best_value = basis.value, best.theta = middle, best.basis = basis;
  }
  while (!stack.empty()) {
    const auto [a, b] = stack.back();
    stack.pop_back();
    const double middle = a + (b - a) / 2;
    const Basis basis = best_basis(lines, c.part, middle);
    if (basis.value > best_value) best_value = basis.value, best.theta = middle, best.basis = basis;
    const Real top = sinusoid_maximum(basis, a, b);
    if (top <= best_value + gap || !(a < middle && middle < b)) {
      bound = std::max(bound, top);
      best.pieces.push_back({a, b, basis});
    } else {
      stack.emplace_back(middle, b);
      stack.emplace_back(a, middle);
    }
  }
  best.x = static_cast<double>(best.basis.x);
  best.y = static_cast<double>(best.basis.y);
  const Real guard = 4e-15L * (scale_of(c.blank, c.part) + std::abs(best.basis.x) + std::abs(best.basis.y));
  best.clearance = static_cast<double>(clearance_at(c.blank, c.part, best.x, best.y, best.theta) - guard);
  best.upper_bound = static_cast<double>(bound + guard);
  return best;
}

// ---- writing ----------------------------------------------------------------------------------------------

struct ContactText {
  std::string part_vertex, blank_edge, multiplier;
  [[nodiscard]] std::string json() const {
    return fmt::format(R"({{"part_vertex": {}, "blank_edge": {}, "multiplier": {}}})", part_vertex,
                       blank_edge, multiplier);
  }
};

inline ContactText contact_text(const Contact& c) {
  return {std::to_string(c.part_vertex), std::to_string(c.blank_edge),
          text_of(static_cast<double>(c.multiplier))};
}

struct IntervalText {
  std::string from, to;
  std::vector<ContactText> contacts;
  [[nodiscard]] std::string json() const {
    std::string list;
    for (const ContactText& c : contacts) list += (list.empty() ? "" : ", ") + c.json();
    return fmt::format(R"({{"from": {}, "to": {}, "contacts": [{}]}})", from, to, list);
  }
};

inline std::string list_json(const std::vector<IntervalText>& intervals) {
  std::string list;
  for (const IntervalText& i : intervals) list += (list.empty() ? "\n" : ",\n") + i.json();
  return "[" + list + "]";
}

/// Everything verify reads; all texts, so that a test can write whatever it likes.
struct Files {
  std::string part_name = "part.json", blank_name = "blank.json", part, blank;
  std::vector<std::pair<std::string, std::string>>
      fields;  ///< of the result, raw JSON, without the certificate
  std::vector<IntervalText> certificate;
  bool inline_certificate = true, give_certificate = true;

  std::string& operator[](const std::string& key) {
    for (auto& [name, value] : fields) {
      if (name == key) return value;
    }
    fields.emplace_back(key, "");
    return fields.back().second;
  }
  void erase(const std::string& key) {
    fields.erase(
        std::remove_if(fields.begin(), fields.end(), [&key](const auto& f) { return f.first == key; }),
        fields.end());
  }
  [[nodiscard]] std::string result() const {
    std::string text = "{";
    for (const auto& [key, value] : fields) text += fmt::format("\"{}\": {},\n", key, value);
    if (inline_certificate)
      return text + "\"certificate\": " + list_json(certificate) + ", \"certificate_file\": null}";
    return text +
           fmt::format(
               R"("certificate": null, "certificate_file": {{"path": "c.json", "sha256": "", "intervals": {}}}}})",
               certificate.size());
  }
  [[nodiscard]] std::string certificate_document() const {
    return R"({"format": {"name": "lekalo-certificate", "version": 1}, "intervals": )" +
           list_json(certificate) + "}";
  }
};

inline Result<verify::LocateReport> check(const Files& files) {
  const std::string result = files.result(), certificate = files.certificate_document();
  verify::LocateInputs inputs{
      {"result.json", result}, {files.part_name, files.part}, {files.blank_name, files.blank}, {}};
  if (!files.inline_certificate && files.give_certificate)
    inputs.certificate = {"certificate.json", certificate};
  return verify::verify_locate(inputs);
}

inline std::string points_json(const Points& points) {
  std::string text;
  for (const auto& p : points) text += fmt::format("{}[{}, {}]", text.empty() ? "" : ", ", p[0], p[1]);
  return "[" + text + "]";
}

inline std::string input_json(const char* role, std::size_t points, const std::string& dropped = "[]",
                              const char* units = "mm") {
  return fmt::format(
      R"({{"role": "{}", "path": "{}.json", "sha256": "", "units": "{}", "points": {}, "dropped": {}}})",
      role, role, units, points, dropped);
}

inline std::string inputs_json(std::size_t part, std::size_t blank, const std::string& part_dropped = "[]",
                               const std::string& blank_dropped = "[]", const char* units = "mm") {
  return "[" + input_json("part", part, part_dropped, units) + ", " +
         input_json("blank", blank, blank_dropped, units) + "]";
}

inline void set_pose(Files& f, double x, double y, double theta) {
  f["x"] = text_of(x);
  f["y"] = text_of(y);
  f["theta"] = text_of(theta);
  f["theta_deg"] = text_of(theta * 57.29577951308232);
}

inline void set_values(Files& f, double clearance, double upper_bound, double min_allowance) {
  f["clearance"] = text_of(clearance);
  f["upper_bound"] = text_of(upper_bound);
  f["gap"] = text_of(upper_bound - clearance);
  f["min_allowance"] = text_of(min_allowance);
  f["shortfall"] = text_of(std::max(0.0, min_allowance - clearance));
  f["status"] = upper_bound < min_allowance ? "\"infeasible\"" : "\"optimal\"";
}

/// The true result of a case, as `lekalo locate` would write it.
inline Files write(const Case& c, const Solution& s, double from_deg = 0, double to_deg = 360,
                   double min_allowance = 0) {
  Files f;
  f.part = points_json(c.part);
  f.blank = points_json(c.blank);
  f["format"] = R"({"name": "lekalo-locate", "version": 1})";
  f["units"] = "\"mm\"";
  f["inputs"] = inputs_json(c.part.size(), c.blank.size());
  f["warnings"] = "[]";
  f["method"] = "\"certified\"";
  f["mirrored"] = "false";
  set_pose(f, s.x, s.y, s.theta);
  set_values(f, s.clearance, s.upper_bound, min_allowance);
  f["window_deg"] = fmt::format("[{}, {}]", from_deg, to_deg);
  std::string contacts;
  for (const Contact& contact : s.basis.contacts)
    contacts += (contacts.empty() ? "" : ", ") + contact_text(contact).json();
  f["contacts"] = "[" + contacts + "]";
  f["alternatives"] = "[]";
  f["alternatives_complete"] = "true";
  f["trim"] = "null";
  f["nc"] = "null";
  f["comparison"] = f["deviations"] = "null";
  f["run"] = R"({"seconds": 0.1, "threads": 1})";
  for (const Piece& piece : s.pieces) {
    IntervalText interval{text_of(piece.from), text_of(piece.to), {}};
    for (const Contact& contact : piece.basis.contacts) interval.contacts.push_back(contact_text(contact));
    f.certificate.push_back(std::move(interval));
  }
  return f;
}

inline Files write(const Case& c) { return write(c, solve(c)); }

/// All findings in one text, for messages of failed tests.
inline std::string findings(const Result<verify::LocateReport>& report) {
  if (!report) return report.error().message;
  std::string text;
  for (const std::string& sentence : report->findings) text += sentence + "\n";
  return text;
}

// ---- random convex shapes ---------------------------------------------------------------------------------

/// SplitMix64 (Steele, Lea and Flood 2014): the same numbers everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits() {
    state_ += 0x9e3779b97f4a7c15;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(bits() >> 11) * 0x1p-53;
  }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(bits() % n); }

 private:
  std::uint64_t state_;
};

}  // namespace lekalo::verify_cases
