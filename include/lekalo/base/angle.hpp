#pragma once

namespace lekalo {

/// Angles are radians inside. Each of these is the double nearest to its value, so that whoever writes
/// `degrees * kDegree` or `radians * kDegreesPerRadian` gets the same bits as everybody else.
inline constexpr double kPi = 0x1.921fb54442d18p+1;         ///< half a turn, a little below it
inline constexpr double kTurn = 2 * kPi;                    ///< a full turn, a little below it
inline constexpr double kTurnAbove = 0x1.921fb54442d19p+2;  ///< the next double: above a full turn
inline constexpr double kDegree = kPi / 180;                ///< radians of a degree
inline constexpr double kDegreesPerRadian = 180 / kPi;

}  // namespace lekalo
