#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rims.hpp"
#include "solid_document.hpp"
#include "solid_features.hpp"
#include "verify/number/both.hpp"

namespace lekalo::verify {

/// Bounds that take the place of one for all, by the demands of the part's triangles.
struct PartBounds {
  static constexpr std::uint32_t kAsCast = 0xffffffff;
  std::vector<Both> bounds;
  /// The place of each triangle's bound, or kAsCast.
  std::vector<std::uint32_t> of;
  /// The place of the least one; none where something is as cast.
  std::optional<std::uint32_t> least;
  /// No point of each triangle may be farther from the blank's surface, mm; infinite where it may.
  std::vector<double> within;
  /// Points in them demand nothing; null where there are none.
  const Rims* rims = nullptr;
};

/// The proof that no pose of a window has more clearance than a bound: a subdivision of a box of poses around
/// the window, each of whose leaves names what bounds the clearance there (certificate_leaf.hpp).
class SolidCertificate {
 public:
  /// \param part, blank  closed; all outlive this
  /// \param bounds  null where nothing has a demand of its own
  /// \param datums  poses that do not keep them do not count
  SolidCertificate(const SolidMesh& part, const SolidMesh& blank, const SolidWindow& window,
                   const Decimal& bound, const PartBounds* bounds, const std::vector<SolidDatum>& datums,
                   std::vector<std::string>& findings)
      : part_(part),
        blank_(blank),
        window_(window),
        bound_(bound),
        bounds_(bounds),
        datums_(datums),
        findings_(findings) {}

  /// Adds a finding for all that it fails to prove; bad_input where the certificate is none.
  /// Cost: a tree of boxes over each mesh, what is used of the tables, and some 40 us a leaf of balls.
  [[nodiscard]] Result<void> check(Json certificate, const std::string& name);

  [[nodiscard]] std::size_t leaves() const { return leaves_; }

 private:
  const SolidMesh &part_, &blank_;
  const SolidWindow& window_;
  const Decimal& bound_;
  const PartBounds* bounds_;
  const std::vector<SolidDatum>& datums_;
  std::vector<std::string>& findings_;
  std::size_t leaves_ = 0;
};

}  // namespace lekalo::verify
