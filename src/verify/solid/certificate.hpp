#pragma once

#include <string>
#include <vector>

#include "solid_document.hpp"

namespace lekalo::verify {

/// The proof that no pose of a window has more clearance than a bound: a subdivision of a box of poses around
/// the window, each of whose leaves names what bounds the clearance there (certificate_leaf.hpp).
class SolidCertificate {
 public:
  /// \param part, blank  closed; all outlive this
  SolidCertificate(const SolidMesh& part, const SolidMesh& blank, const SolidWindow& window,
                   const Decimal& bound, std::vector<std::string>& findings)
      : part_(part), blank_(blank), window_(window), bound_(bound), findings_(findings) {}

  /// Adds a finding for all that it fails to prove; bad_input where the certificate is none.
  /// Cost: a tree of boxes over each mesh, what is used of the tables, and some 40 us a leaf of balls.
  [[nodiscard]] Result<void> check(Json certificate, const std::string& name);

  [[nodiscard]] std::size_t leaves() const { return leaves_; }

 private:
  const SolidMesh &part_, &blank_;
  const SolidWindow& window_;
  const Decimal& bound_;
  std::vector<std::string>& findings_;
  std::size_t leaves_ = 0;
};

}  // namespace lekalo::verify
