#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"

namespace lekalo::verify {

/// The independent checker. It reads the written bytes itself, exactly (decimals become rationals), and
/// decides with outward rounding. It includes nothing of lekalo but base, and shares no code with any solver
/// or reader. It is short and slow on purpose.

struct Document {
  /// The name for messages. Its ending (.csv .txt .xyz .json .dxf) chooses the format.
  std::string name;
  std::string_view bytes;
};

struct LocateInputs {
  Document result, part, blank;
  /// Given when the result names a certificate file.
  std::optional<Document> certificate;
  /// Given when the result names a file of features.
  std::optional<Document> features = std::nullopt;
  /// The program that was to be moved, and the one that was written, where it is still there.
  std::optional<Document> program = std::nullopt, written_program = std::nullopt;
  /// The list of M words that the shop allows.
  std::optional<Document> allow = std::nullopt;
  /// The earlier result that this one was compared with.
  std::optional<Document> earlier = std::nullopt;
  /// The file of deviations that was written, where it is still there.
  std::optional<Document> deviations = std::nullopt;
  /// The points that the blank's mesh was made from.
  std::optional<Document> points = std::nullopt;
  /// The mesh that was moved to them instead, where they are touches.
  std::optional<Document> nominal = std::nullopt;
};

enum class Verdict {
  confirmed,  ///< clearance, bound and certificate hold
  /// They hold, but a claim was not rechecked, which a note names: the choice by a criterion that the checker
  /// does not know, or the edges of a feature that it cannot rebuild.
  incomplete,
  /// They hold for the regions as the result states them. How a file became its region was not rechecked,
  /// which a note says.
  stated_regions,
  unproved,  ///< the clearance holds; there is no certificate to check the bound with
  refuted    ///< something written is not true
};

/// True for the criteria of `lekalo locate` whose choice among placements is rechecked. Of the others is held
/// what holds for all: they give up no more of the margin, and of a smallest largest allowance, than the
/// result says.
[[nodiscard]] bool knows_criterion(std::string_view name) noexcept;

struct LocateReport {
  Verdict verdict = Verdict::refuted;
  /// The exact minimum allowance at the written pose, mm, as decimals that enclose it (30 digits).
  std::string clearance_low, clearance_high;
  /// The largest bound over the certificate, rounded up; empty without a certificate.
  std::string bound_high;
  std::size_t intervals = 0;
  /// A sentence for everything that does not hold.
  std::vector<std::string> findings;
  /// Sentences about what was not looked at.
  std::vector<std::string> notes;
};

/// Rechecks a result of `lekalo locate` (docs/formats.md) against the files it names. Fails with bad_input
/// when a document cannot be read at all. A document that can be read and is untrue is in the report.
[[nodiscard]] Result<LocateReport> verify_locate(const LocateInputs& inputs);

/// A placement: part point p goes to R(theta) p + (x, y), mirrored in x before if asked for. The doubles
/// count as exact.
struct Placement {
  double x = 0, y = 0, theta = 0;
  bool mirrored = false;
};

struct Enclosure {
  double low = 0, high = 0;
};

/// Encloses the exact clearance at a placement of regions (lines and arcs, holes, several pieces) in the JSON
/// form of docs/design/geometry.md: the least signed distance of a point of the part from the boundary of the
/// blank, positive inside. Where the part lies in the blank, the ends are a few last places of the
/// coordinates apart. Where it sticks out they are 1e-9 mm apart, or more if that takes more than 20,000
/// pieces to tell. Where a part that is not rotated (theta 0) touches its blank from inside, the result is
/// exactly {0, 0}, decided with fractions of the written decimals. bad_input for documents that are no
/// regions, and for outlines that meet themselves or one another.
///
/// Cost: every edge of one against every edge of the other, below a millisecond for 20 by 20.
[[nodiscard]] Result<Enclosure> verify_clearance(const Document& part, const Document& blank,
                                                 const Placement& placement);

}  // namespace lekalo::verify
