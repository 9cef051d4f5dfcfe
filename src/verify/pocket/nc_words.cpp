#include "nc_words.hpp"

#include <fmt/core.h>

#include <array>

namespace lekalo::verify {
namespace {

constexpr std::array kCodes = {
    Code{'G', kRapid, Group::motion, "XYZ"},
    Code{'G', kFeed, Group::motion, "XYZ"},
    Code{'G', kClockwise, Group::motion, "XYZIJRP"},
    Code{'G', kCounterClockwise, Group::motion, "XYZIJRP"},
    Code{'G', kNoMotion, Group::motion},
    Code{'G', 40, Group::dwell, "P"},
    Code{'G', 170, Group::plane},
    Code{'G', 200, Group::unit},
    Code{'G', 210, Group::unit},
    Code{'G', 400, Group::compensation},
    Code{'G', 430, Group::tool_length, "H"},
    Code{'G', 490, Group::tool_length},
    Code{'G', 540, Group::work_offset},
    Code{'G', 550, Group::work_offset},
    Code{'G', 560, Group::work_offset},
    Code{'G', 570, Group::work_offset},
    Code{'G', 580, Group::work_offset},
    Code{'G', 590, Group::work_offset},
    Code{'G', 591, Group::work_offset},
    Code{'G', 592, Group::work_offset},
    Code{'G', 593, Group::work_offset},
    Code{'G', 610, Group::path_control},
    Code{'G', 611, Group::path_control},
    Code{'G', 640, Group::path_control, "PQ"},
    Code{'G', 900, Group::distance},
    Code{'G', 910, Group::distance},
    Code{'G', 901, Group::centre},
    Code{'G', 911, Group::centre},
    Code{'G', 940, Group::feed_mode},
    Code{'G', 970, Group::spindle_mode},
    Code{'G', 980, Group::retract},
    Code{'G', 990, Group::retract},
    Code{'M', 0, Group::stop},
    Code{'M', 10, Group::stop},
    Code{'M', 20, Group::stop},
    Code{'M', 300, Group::stop},
    Code{'M', 30, Group::spindle},
    Code{'M', 40, Group::spindle},
    Code{'M', 50, Group::spindle},
    Code{'M', 60, Group::tool_change},
    Code{'M', 70, Group::coolant},
    Code{'M', 80, Group::coolant},
    Code{'M', 90, Group::coolant},
    Code{'M', 480, Group::speed_control},
    Code{'M', 490, Group::speed_control},
    Code{'M', 620, Group::output, "P"},
    Code{'M', 630, Group::output, "P"},
    Code{'M', 640, Group::output, "P"},
    Code{'M', 650, Group::output, "P"},
};

}  // namespace

std::span<const Code> known_codes() noexcept { return kCodes; }

const Code* code_of(char letter, double value) noexcept {
  for (const Code& code : kCodes)
    if (code.letter == letter && code.tenths / 10.0 == value) return &code;
  return nullptr;
}

std::string name_of(const Code& code) { return fmt::format("{}{:g}", code.letter, code.tenths / 10.0); }

}  // namespace lekalo::verify
