#include "cut_work.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "verify/shape/shape_inside.hpp"

namespace lekalo::verify {
namespace {

/// A contact may cross the stock's border by so much, mm.
constexpr double kBeyond = 0.01;
/// Steps along a contact's arc at which the border is looked at.
constexpr int kArcSteps = 8;

class Booking {
 public:
  Booking(const CheckedStock& stock, const CheckedCutting& cutting, double top)
      : stock_(stock), c_(cutting), bottom_(top - stock.thickness), radius_(cutting.diameter / 2) {}

  BookedWork run(const CutHistory& history) {
    for (const CutPiece& piece : history.pieces) {
      booked_.seconds = std::max(booked_.seconds, piece.start + piece.seconds);
      if (piece.seconds > 0) book(piece);
      if (!booked_.fault.empty()) return std::move(booked_);
    }
    booked_.into_j = {booked_.work_j.least * c_.share.least, booked_.work_j.greatest * c_.share.greatest};
    booked_.carried_off_j = {booked_.work_j.least * (1 - c_.share.greatest),
                             booked_.work_j.greatest * (1 - c_.share.least)};
    return std::move(booked_);
  }

 private:
  void book(const CutPiece& piece) {
    const double x = (piece.from_x + piece.to_x) / 2, y = (piece.from_y + piece.to_y) / 2;
    const double middle = stock_.inside(x, y), teeth = c_.teeth * c_.spindle_rpm / 60 * piece.seconds;
    CheckedRange work;
    double volume = 0;
    const auto add = [&](double cut, double chip) {
      if (!(cut > 0)) return;
      const double mild = std::pow(chip, -c_.exponent.least), steep = std::pow(chip, -c_.exponent.greatest);
      work.least += c_.force.least * std::min(mild, steep) * c_.wear.least * cut / 1000;
      work.greatest += c_.force.greatest * std::max(mild, steep) * c_.wear.greatest * cut / 1000;
      volume += cut;
    };
    for (const EngagedLayer& layer : piece.rim) {
      if (!meets(layer, x, y, middle, piece.line)) continue;
      const double high = layer.high_z - std::max(layer.low_z, bottom_), arc = layer.end - layer.begin;
      if (arc > 0)
        add(layer.width * high * piece.length, piece.length / teeth * layer.width / (radius_ * arc));
    }
    const double drop = piece.from_z - std::max(piece.to_z, bottom_);
    if (middle > -radius_) add(piece.floor_area * drop, (piece.from_z - piece.to_z) / teeth);
    if (!(volume > 0)) return;
    booked_.cutting_seconds += piece.seconds, booked_.volume_mm3 += volume;
    booked_.work_j.least += work.least, booked_.work_j.greatest += work.greatest;
    booked_.power_w.least = std::max(booked_.power_w.least, work.least / piece.seconds);
    booked_.power_w.greatest = std::max(booked_.power_w.greatest, work.greatest / piece.seconds);
  }

  /// Says whether a contact meets the stock. One that crosses its border is a fault.
  bool meets(const EngagedLayer& layer, double x, double y, double middle, std::size_t line) {
    if (middle >= radius_) return true;
    double least = HUGE_VAL, greatest = -HUGE_VAL;
    for (int k = 0; k <= kArcSteps; ++k) {
      const double angle = layer.begin + (layer.end - layer.begin) * k / kArcSteps;
      const double inside = stock_.inside(x + radius_ * std::cos(angle), y + radius_ * std::sin(angle));
      least = std::min(least, inside), greatest = std::max(greatest, inside);
    }
    // The maker's rounding may stand on the other side of the limits.
    constexpr double kRounding = 1e-9;
    if (greatest <= kBeyond + kRounding) return false;
    if (least < -kBeyond - kRounding)
      booked_.fault = fmt::format("line {} of the program cuts {:.3f} mm beyond the stock", line, -least);
    return true;
  }

  const CheckedStock& stock_;
  const CheckedCutting& c_;
  double bottom_, radius_;
  BookedWork booked_;
};

}  // namespace

double CheckedStock::inside(double x, double y) const {
  if (outline) {
    const Span distance = signed_distance({just(x), just(y)}, *outline);
    return 0.5 * (distance.low + distance.high);
  }
  const double across = std::min(x - low_x, high_x - x), along = std::min(y - low_y, high_y - y);
  return across < 0 && along < 0 ? -std::sqrt(across * across + along * along) : std::min(across, along);
}

BookedWork booked_work(const CutHistory& history, const CheckedStock& stock, const CheckedCutting& cutting,
                       double top) {
  return Booking(stock, cutting, top).run(history);
}

}  // namespace lekalo::verify
