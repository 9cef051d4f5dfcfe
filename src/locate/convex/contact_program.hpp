#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lekalo/geom/polygon.hpp"
#include "locate/search/sinusoid.hpp"

namespace lekalo::locate {

/// Three contacts that hold the part against the blank at every angle. The inward unit normals n_j of the
/// blank edges span the plane positively: sum lambda_j n_j = 0, sum lambda_j = 1, lambda_j >= 0. Hence for
/// every placement at angle theta  clearance <= sum lambda_j n_j . (R(theta) v_j - a_j) = bound(theta).
struct Basis {
  std::array<std::uint32_t, 3> edge{};    ///< of the blank
  std::array<std::uint32_t, 3> vertex{};  ///< of the part, one per edge
  std::array<double, 3> lambda{};
  Sinusoid bound;
  /// A shift at which the three contacts are about equally wide open; error bounds are taken there.
  geom::Point shift;
};

/// The linear program of one fixed angle,
///   maximise r over (t, r)   subject to   n_k . (R v_i + t - a_k) >= r   for all edges k and vertices i,
/// solved by the dual simplex method on three contacts. The matrix [n_k, -1] does not depend on the angle, so
/// the basis of one angle is dual feasible, hence a warm start, at every other.
class ContactProgram {
 public:
  /// \pre polygons in one local frame (coordinates of the size of the shapes, not of their place).
  ContactProgram(const geom::Ring& part, const geom::Ring& blank);

  struct Solution {
    /// A valid bound, whatever has happened.
    Basis basis;
    /// The best shift found.
    geom::Point shift;
    /// The least n_k . (R v_i + shift - a_k) over *all* edges: a value that is reached, not only a bound. It
    /// is -infinity when the bound turned out not to be of interest.
    double value = 0;
  };

  enum class Effort {
    /// The tightest bound, which says most about the angles around.
    optimum,
    /// Any bound that is at most `of_interest`.
    bound
  };

  /// Edges of a large blank are taken into the program only as they are found violated. That is looked for
  /// only while the bound at this angle exceeds `of_interest`.
  [[nodiscard]] Solution solve(const Angle& angle, const Basis& warm, double of_interest,
                               Effort effort = Effort::optimum);

  [[nodiscard]] Basis first_basis() const { return first_basis_; }

  /// Returns the basis with its lightest contact given to the edge that stands most across the other two, and
  /// those two's multipliers adjusted. Where two edges are nearly opposite, what rounding hides of them
  /// weighs least then. The bound at this angle is about the same when the lightest contact weighed nothing.
  [[nodiscard]] Basis braced(const Basis& basis, const Angle& angle) const;

  /// Returns the size of the shapes in the local frame, the largest |coordinate|.
  [[nodiscard]] double scale() const { return scale_; }

 private:
  static constexpr std::uint32_t kNoRow = 0xffffffff;

  /// The rows of a basis while pivoting, with the point (shift, value) where their three planes meet.
  struct Tableau {
    std::array<std::uint32_t, 3> row{};
    std::array<double, 3> lambda{};
    geom::Point shift;
    double value = 0;
  };

  void collect_sides(const geom::Ring& part);
  void collect_edges(const geom::Ring& blank);
  void choose_first_rows();

  std::uint32_t add_row(std::uint32_t edge);
  /// Sets row_open_ of all rows (from `first` on) for an angle.
  void place(const Angle& angle, std::size_t first = 0);
  void change_vertex(std::size_t row, const Angle& angle, std::uint32_t hint);
  bool walk_outwards(double qx, double qy, std::uint32_t& vertex, std::uint32_t limit) const;
  [[nodiscard]] std::uint32_t outermost_vertex(double qx, double qy, std::size_t edge, double theta,
                                               std::uint32_t hint) const;
  [[nodiscard]] std::uint32_t outermost_by_search(double direction) const;

  /// The row that is least open at a shift, and by how much it is open.
  struct LeastOpen {
    std::uint32_t row = 0;
    double open = 0;
  };
  [[nodiscard]] LeastOpen least_open(geom::Point shift) const;
  void meet(Tableau& tableau) const;
  void pivot(Tableau& tableau, std::uint32_t entering) const;
  /// Pivots until no row in the program is violated or the value is at most `enough`. Returns how far the
  /// least open row is open.
  double optimise(Tableau& tableau, double enough) const;
  /// An edge of the blank with the part placed: the vertex outermost for it, and how far it is open.
  struct PlacedEdge {
    std::uint32_t edge = 0, vertex = 0;
    double open = 0;
    /// The placed vertex.
    geom::Point corner;
  };
  [[nodiscard]] PlacedEdge place_edge(std::uint32_t edge, const Angle& angle, geom::Point shift,
                                      std::uint32_t hint) const;
  /// Says whether all edges strictly between two are open by at least `least`. A no may be wrong.
  [[nodiscard]] bool all_open_between(const PlacedEdge& first, const PlacedEdge& last, double least) const;
  /// Makes `least` the least open edge strictly between two, if one of them is less open than it.
  void find_least_open(const PlacedEdge& first, const PlacedEdge& last, const Angle& angle, geom::Point shift,
                       PlacedEdge& least) const;
  /// Takes edges outside the program that are violated at (shift, value) into it, the worst of each stretch
  /// between the first rows. Returns false when no edge is violated.
  bool add_violated(const Angle& angle, geom::Point shift, double value);
  /// Returns the first edge, in order of direction, whose normal's direction is at least this one, in [0, 2
  /// pi).
  [[nodiscard]] std::size_t edge_beyond(double direction) const;
  void add_contact(Basis& basis, std::size_t j, std::uint32_t edge, std::uint32_t vertex,
                   double lambda) const;
  [[nodiscard]] Basis basis_of(const Tableau& tableau) const;

  // The part has vertices, and sides from vertex i to i + 1.
  std::vector<double> vertex_x_, vertex_y_, side_x_, side_y_;
  /// The directions in [0, 2 pi), by side and ascending.
  std::vector<double> direction_of_side_, side_direction_;
  std::vector<std::uint32_t> side_by_direction_;
  // The blank has vertices, and edge k from vertex k with the inward unit normal n and the points with n . p
  // = offset.
  geom::Ring blank_;
  std::vector<double> normal_x_, normal_y_, offset_, normal_direction_;
  /// The edge whose normal's direction is least; from it on the directions ascend.
  std::size_t lowest_direction_ = 0;
  /// The edges of the first rows, ascending.
  std::vector<std::uint32_t> first_edges_;
  // The vertex row_vertex_ of a row is outermost for angles in [row_from_, row_to_], where n . R v =
  // row_cosine_ cos + row_sine_ sin. The opening at shift 0 and the current angle is row_open_ = n . R v -
  // offset.
  std::vector<std::uint32_t> row_edge_, row_vertex_, row_of_edge_;
  std::vector<double> row_from_, row_to_, row_cosine_, row_sine_, row_offset_, row_nx_, row_ny_, row_open_;
  Basis first_basis_;
  double scale_ = 0, tolerance_ = 0;
};

}  // namespace lekalo::locate
