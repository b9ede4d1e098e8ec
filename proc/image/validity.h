#pragma once

#include <cstdint>

namespace orbwatch {

/// Why a pixel of a view is or is not known.
enum class Validity : std::uint8_t {
  Outside = 0,  ///< the direction's place on the ball lies outside every camera's picture
  Blind = 1,    ///< no camera sees the direction on the ball, or the one that does has a fault
  Seen = 255,
};

}  // namespace orbwatch
