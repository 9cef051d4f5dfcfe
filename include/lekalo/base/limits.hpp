#pragma once

#include <cstddef>
#include <cstdint>

/// The limits of numbers in files. They stand here once, for the readers, for what works with the numbers and
/// for the checker: what one of them takes, the others take too, so that a number out of range is a mistake
/// of its file and never one of lekalo. docs/limits.md lists them for people, and the tests unit.base_limits
/// and e2e.cli_limits hold page, schema and program against them.
namespace lekalo::limits {

/// A written number has at most this many digits from its first to its last that is not 0,
inline constexpr std::size_t kMostDigits = 800;
/// and is 0 or lies from 10^-n to 10^n. The shortest form of every double is well inside; more would only
/// cost the exact arithmetic memory.
inline constexpr int kMostPlaces = 400;

/// Outlines, points, drawings, scans, demands, locked shifts and the distances of options, mm. A double still
/// resolves 1e-7 mm there, and a larger number is most likely a mistyped exponent.
inline constexpr double kLargestCoordinate = 1e9;
/// A coordinate of smaller magnitude, mm, counts as 0.
inline constexpr double kSmallestCoordinate = 1e-100;
/// Numbers computed from coordinates: poses, and radii and boxes of the proof of a result, mm.
inline constexpr double kLargestDerived = 1e12;
/// The factor by which the margin of a feature is measured, and its inverse.
inline constexpr double kLargestFactor = 1e6;
/// Vertices, and triangles, of the file of a solid.
inline constexpr std::size_t kMostSolidItems = 20'000'000;
/// Rows of each table, and nodes of all trees, in the certificate of a placement of solids; terms of a leaf.
inline constexpr std::size_t kMostCertificateRows = 1'000'000, kMostCertificateNodes = 4'000'000,
                             kMostCertificateTerms = 64;
/// Programs and the pockets that they cut, mm: a kilometre, beyond any machine.
inline constexpr double kLargestProgramCoordinate = 1e6;

/// Places of a pocket's walls at which the heat of milling is looked for, at all heights together.
inline constexpr std::size_t kMostHeatPlaces = 1'000'000;

/// Layouts. Outlines, strips and gaps, mm; 2^38 steps of the grid.
inline constexpr double kLargestOutline = 0x1p18;
/// Placements, mm.
inline constexpr double kLargestPlacement = 0x1p19;
/// The sides of a strip or a bin, mm.
inline constexpr double kShortestSide = 1e-3;
/// Rotations and directions of grain.
inline constexpr double kMostDegrees = 3600;
/// A cosine or a sine; whether the two are a rotation is another question.
inline constexpr double kLargestSine = 1.5;
/// Heights of texts on parts, mm, and how many times wider than the font their letters are.
inline constexpr double kLowestText = 0.01, kHighestText = 1e4, kNarrowestText = 0.01, kWidestText = 100;
/// The distance of chords from curves, mm.
inline constexpr double kLeastChordTolerance = 0x1p-16, kMostChordTolerance = 100;
/// Counts of stocks and parts, and the number of a copy, which begins with 0.
inline constexpr std::int64_t kMostCount = 1'000'000'000;
/// Kits wanted and pieces in one: their products fit 64 bits.
inline constexpr std::int64_t kMostKits = 1'000'000;
/// Qualities, tolerated severities and priorities, which may also be negative.
inline constexpr std::int64_t kMostLevel = 1'000'000;
/// Severities of defects: one more than any part can tolerate.
inline constexpr std::int64_t kMostSeverity = kMostLevel + 1;
/// Ids of placements: whole numbers that doubles hold.
inline constexpr std::int64_t kMostId = (std::int64_t{1} << 53) - 1;
/// Costs of stocks and values of kits.
inline constexpr double kMostMoney = 1e12;

/// Edges of outlines are compared with those whose boxes meet theirs. Of ordinary outlines that is a handful
/// each; where almost every box meets every other, as those of slanting slots or of nested circles do, it
/// would be the square of their number.
[[nodiscard]] constexpr std::size_t most_meeting_boxes(std::size_t edges) noexcept {
  return 8'000'000 + 16 * edges;
}
/// Unions, differences and offsets of shapes cut edges into pieces, most of which meet a few others.
[[nodiscard]] constexpr std::size_t most_meeting_pieces(std::size_t edges) noexcept {
  return 4 * most_meeting_boxes(edges);
}
/// Places where pieces of edges meet.
inline constexpr std::size_t kMostCrossings = 1'000'000;

}  // namespace lekalo::limits
