#include "solid_check.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <optional>
#include <tuple>
#include <utility>

#include "certificate.hpp"
#include "measured_points.hpp"
#include "scan_widths.hpp"
#include "solid_document.hpp"
#include "solid_number.hpp"
#include "solid_window.hpp"
#include "triangle_distance.hpp"
#include "verify/locate/program_check.hpp"

namespace lekalo::verify {
namespace {

/// Points of contact are printed for people: they may be off by this share of the blank's size.
constexpr double kReadingTolerance = 1e-6;

/// Says whether a number that was computed in doubles may be meant for another one.
bool is_near(const Decimal& written, const Fraction& real, const Fraction& size) {
  return abs(to_fraction(written) - real) <= size / 1'000'000'000'000'000;
}

double size_of(const SolidMesh& mesh) {
  std::array<double, 3> low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  for (const auto& p : mesh.near)
    for (std::size_t axis = 0; axis < 3; ++axis)
      low[axis] = std::min(low[axis], p[axis]), high[axis] = std::max(high[axis], p[axis]);
  return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
}

/// Says whether a point may be no further than `slack` from a triangle by its number in the file.
bool is_near_triangle(const std::array<Decimal, 3>& point, const SolidMesh& mesh, std::size_t number,
                      double slack) {
  const auto triangle = mesh.triangle_of_file(number);
  if (!triangle) return false;
  const Vec3 p{enclosed(point[0]), enclosed(point[1]), enclosed(point[2])};
  Triangle3 at{};
  for (std::size_t corner = 0; corner < 3; ++corner)
    for (std::size_t axis = 0; axis < 3; ++axis)
      at[corner][axis] = mesh.enclosed(mesh.triangles[*triangle][corner], axis);
  return distance({p, p, p}, at).low <= slack;
}

class SolidCheck {
 public:
  SolidCheck(const LocateInputs& inputs, SolidDocument document) : inputs_(inputs), d_(std::move(document)) {}

  Result<LocateReport> run() {
    LEKALO_TRY(const std::optional<SolidMesh> part, read_input("part", inputs_.part, d_.part));
    LEKALO_TRY(std::optional<SolidMesh> blank, read_input("blank", inputs_.blank, d_.blank));
    LEKALO_TRY(const Json certificate, certificate_of());
    const bool has_certificate = certificate.is_object();
    if (blank) {
      check_scan(*blank);
      LEKALO_CHECK(check_points(*blank));
    }
    if (part && blank) {
      LEKALO_TRY(const SolidPair pair, SolidPair::make(*part, *blank, d_.pose));
      check_clearance(pair);
      check_contacts(pair, *part, *blank);
      if (has_certificate && d_.upper_bound) LEKALO_CHECK(check_certificate(certificate, *part, *blank));
    }
    check_pose();
    check_derived();
    check_status(has_certificate);
    check_nc();
    if (!d_.inside) note("the part does not lie in the blank at the placement, so there is no clearance");
    report_.verdict = !report_.findings.empty() ? Verdict::refuted
                      : open_                   ? Verdict::incomplete
                      : !has_certificate        ? Verdict::unproved
                                                : Verdict::confirmed;
    return std::move(report_);
  }

 private:
  template <class... Args>
  void find(fmt::format_string<Args...> format, Args&&... args) {
    report_.findings.push_back(fmt::format(format, std::forward<Args>(args)...));
  }
  void note(std::string sentence) { report_.notes.push_back(std::move(sentence)); }

  Result<std::optional<SolidMesh>> read_input(const char* role, const Document& document,
                                              const WrittenSolid& written);
  [[nodiscard]] Result<Json> certificate_of() const;
  void check_scan(SolidMesh& blank);
  Result<void> check_points(const SolidMesh& blank);
  void check_clearance(const SolidPair& pair);
  void check_contacts(const SolidPair& pair, const SolidMesh& part, const SolidMesh& blank);
  Result<void> check_certificate(Json certificate, const SolidMesh& part, const SolidMesh& blank);
  void check_pose();
  void check_derived();
  void check_status(bool has_certificate);
  void check_nc();

  const LocateInputs& inputs_;
  SolidDocument d_;
  bool open_ = false;
  LocateReport report_;
};

/// Returns nothing where the file is in a form that is not read here.
Result<std::optional<SolidMesh>> SolidCheck::read_input(const char* role, const Document& document,
                                                        const WrittenSolid& written) {
  LEKALO_TRY(SolidReading reading, read_solid(document, written.unit));
  if (reading.open) {
    open_ = true;
    note(fmt::format("what is said of the {} was not rechecked: {} is not read here, because {}", role,
                     document.name, *reading.open));
    return std::nullopt;
  }
  if (reading.mesh.triangles.size() != written.triangles)
    find("the {} is said to have {} triangles, but {} has {}", role, written.triangles, document.name,
         reading.mesh.triangles.size());
  LEKALO_TRY(SolidMesh made, closed(std::move(reading.mesh), document.name));
  return made;
}

/// Returns null where there is none.
Result<Json> SolidCheck::certificate_of() const {
  if (!d_.boxes_in_file || !inputs_.certificate) return d_.certificate;
  return read_solid_certificate_document(*inputs_.certificate);
}

/// Gives the blank its widths, and holds what the result says of them against them.
void SolidCheck::check_scan(SolidMesh& blank) {
  const auto is_off = [](const Decimal& written, Span is) {
    const double slack = kReadingTolerance * std::max(1.0, is.high), value = approximate(written);
    return !(value >= is.low - slack && value <= is.high + slack);
  };
  if (!d_.scan) {
    if (sgn(d_.unknown_area.digits) != 0)
      find("unknown_area_mm2 is {}, but all of a closed mesh is known", approximate(d_.unknown_area));
    return;
  }
  ScanWidths widths = scan_widths(blank, *d_.scan);
  if (is_off(d_.unknown_area, widths.unknown_area))
    find("unknown_area_mm2 is {}, but {} mm2 are unknown", approximate(d_.unknown_area),
         widths.unknown_area.high);
  if (is_off(d_.scan->widest, widths.widest))
    find("scan.widest is {}, but the widest triangle has {} mm", approximate(d_.scan->widest),
         widths.widest.high);
  if (d_.scan->unknown_triangles != widths.unknown)
    find("scan.unknown_triangles is {}, but there are {}", d_.scan->unknown_triangles, widths.unknown);
  if (d_.scan->proved != (widths.unknown == 0))
    find("scan.proved is {}, but {} triangles are unknown", d_.scan->proved, widths.unknown);
  if (widths.unknown > 0) {
    open_ = true;
    note(fmt::format(
        "{} triangles of the scan are unknown, {:.6g} mm2, so that nothing of the blank is proved",
        widths.unknown, widths.unknown_area.high));
  }
  blank.widths = std::move(widths.of);
}

/// Holds the blank against the points that it was made from.
Result<void> SolidCheck::check_points(const SolidMesh& blank) {
  if (d_.points.has_value() != inputs_.points.has_value()) {
    find("the result {} points that its blank was made from",
         d_.points ? "was checked without the" : "names no");
    return {};
  }
  if (!d_.points) {
    if (d_.scan && !d_.scan->left_out.empty())
      find("scan.left_out names points, but there is no file of points");
    return {};
  }
  if (!d_.scan) {
    find("the blank was made from points, but scan is null");
    return {};
  }
  LEKALO_TRY(const SolidReading reading, read_measured_points(*inputs_.points, d_.points->unit));
  if (reading.open) {
    open_ = true;
    note(fmt::format(
        "that the blank was made from measured points was not rechecked: {} is not read here, because {}",
        inputs_.points->name, *reading.open));
    return {};
  }
  const auto& points = reading.mesh.near;
  if (points.size() != d_.points->count)
    find("{} points are said to be measured, but {} has {}", d_.points->count, inputs_.points->name,
         points.size());
  for (const std::string& fault : faults_of_points(points, blank, *d_.scan)) find("{}", fault);
  return {};
}

/// A part that touches the blank's surface is not inside.
void SolidCheck::check_clearance(const SolidPair& pair) {
  const bool is_number = d_.clearance && sgn(d_.clearance->digits) > 0;
  const SolidAnswer answer = pair.check(is_number ? *d_.clearance : Decimal{});
  if (!d_.inside) {
    if (!answer.fault && !answer.open) find("inside is false, but the part lies in the blank");
    return;
  }
  report_.clearance_low = fmt::format("{}", answer.least.low);
  report_.clearance_high = fmt::format("{}", answer.least.high);
  if (answer.fault) find("{}", *answer.fault);
  if (answer.open) find("inside is true, but the part touches the blank's surface");
}

void SolidCheck::check_contacts(const SolidPair& pair, const SolidMesh& part, const SolidMesh& blank) {
  const double slack = kReadingTolerance * std::max(1.0, size_of(blank));
  for (std::size_t k = 0; k < d_.contacts.size(); ++k) {
    const WrittenSolidContact& contact = d_.contacts[k];
    for (const auto& [role, mesh, number, point] :
         {std::tuple("part", &part, contact.part_triangle, &contact.points.part_point),
          std::tuple("blank", &blank, contact.blank_triangle, &contact.points.blank_point)})
      if (!is_near_triangle(*point, *mesh, number, slack))
        find("contact {}: {}_point is not on triangle {} of the {}", k, role, number, role);
    const auto triangle = blank.triangle_of_file(contact.blank_triangle);
    const Span width = triangle ? blank.width(*triangle) : Span{};
    if (const auto bound = pair.bound_of(contact.points, slack, width); !bound)
      find("contact {}: {}", k, bound.error().message);
  }
}

Result<void> SolidCheck::check_certificate(Json certificate, const SolidMesh& part, const SolidMesh& blank) {
  SolidCertificate proof(part, blank, d_.window, *d_.upper_bound, report_.findings);
  LEKALO_CHECK(proof.check(certificate, d_.boxes_in_file ? inputs_.certificate->name : inputs_.result.name));
  report_.intervals = proof.leaves();
  report_.bound_high = fmt::format("{}", enclosed(*d_.upper_bound).high);
  if (d_.boxes_in_file && *d_.boxes_in_file != proof.leaves())
    find("certificate_file.boxes is {}, but the certificate has {} leaves", *d_.boxes_in_file,
         proof.leaves());
  return {};
}

void SolidCheck::check_pose() {
  if (const auto how = off_window(d_.window, d_.pose)) find("the placement is not in the window: {}", *how);
}

void SolidCheck::check_derived() {
  if (d_.inside != d_.clearance.has_value())
    find("inside is {}, but {} clearance", d_.inside, d_.clearance ? "there is a" : "there is no");
  if (d_.clearance && sgn(d_.clearance->digits) < 0)
    find("clearance {} is below 0, which no part in its blank has", approximate(*d_.clearance));
  if (d_.gap.has_value() != (d_.clearance && d_.upper_bound))
    find("{}", d_.gap ? "there is a gap, but not both a clearance and an upper_bound" : "gap is null");
  if (d_.shortfall.has_value() != d_.clearance.has_value())
    find("{}", d_.shortfall ? "there is a shortfall, but no clearance" : "shortfall is null");
  if (!d_.clearance) return;
  const Fraction clearance = to_fraction(*d_.clearance), demand = to_fraction(d_.min_allowance);
  if (d_.upper_bound) {
    const Fraction bound = to_fraction(*d_.upper_bound);
    if (bound < clearance)
      find("upper_bound {} is below clearance {}", approximate(*d_.upper_bound), approximate(*d_.clearance));
    if (d_.gap && !is_near(*d_.gap, bound - clearance, abs(bound) + clearance))
      find("gap is not upper_bound less clearance");
  }
  const Fraction missing = demand - clearance;
  if (d_.shortfall && (sgn(missing) <= 0 ? sgn(d_.shortfall->digits) != 0
                                         : !is_near(*d_.shortfall, missing, abs(demand) + clearance)))
    find("shortfall is not min_allowance less clearance");
}

void SolidCheck::check_status(bool has_certificate) {
  if (has_certificate && !d_.upper_bound)
    find("there is a certificate, but no upper_bound that it is to prove");
  if (!has_certificate && d_.upper_bound)
    note(fmt::format("there is no certificate, so that upper_bound {} was not rechecked",
                     approximate(*d_.upper_bound)));
  if (d_.status == "stopped") return;
  if (d_.status == "unproved") {
    if (has_certificate) find("status is unproved, but there is a certificate");
    return;
  }
  if (!d_.upper_bound) return find("status is {}, but there is no upper_bound", d_.status);
  const bool out_of_reach = compare(*d_.upper_bound, d_.min_allowance) < 0;
  if (out_of_reach != (d_.status == "infeasible"))
    find("status is {}, but upper_bound {} is {} min_allowance {}", d_.status, approximate(*d_.upper_bound),
         out_of_reach ? "below" : "not below", approximate(d_.min_allowance));
  if (d_.status == "optimal" && !d_.inside) find("status is optimal, but the part is not in the blank");
}

/// Holds the program that was written against the original.
void SolidCheck::check_nc() {
  if (!d_.nc) return;
  if (!d_.clearance) return find("a program was written, but the part is not in the blank");
  const auto& [w, x, y, z] = d_.pose.quaternion;
  if (sgn(x.digits) != 0 || sgn(y.digits) != 0)
    return find("a program was written, but the part lies tilted, which three axes cannot follow");
  if (to_fraction(d_.nc->clearance) > to_fraction(*d_.clearance) - to_fraction(d_.nc->rounding_mm) ||
      sgn(d_.nc->rounding_mm.digits) < 0)
    find("the program's clearance {} is above clearance less its rounding", approximate(d_.nc->clearance));
  const auto& at = d_.pose.shift;
  const ProgramPose pose{at[0], at[1], {}, ProgramClaim::Solid{at[2], {w, z}}};
  open_ = !check_program(inputs_, *d_.nc, pose, report_) || open_;
}

}  // namespace

Result<LocateReport> check_solids(const LocateInputs& inputs, Json written) {
  LEKALO_TRY(SolidDocument document, read_solid_document(written, inputs.result.name));
  return SolidCheck(inputs, std::move(document)).run();
}

}  // namespace lekalo::verify
