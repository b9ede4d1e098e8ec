#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "hal/clock.h"

namespace orbwatch::hal {

/// A line's address: the board's name of it, or the label of its chip and its offset there. A
/// chip's number is no address: it changes between boots.
struct LineAddress {
  std::string name{};  ///< empty: by chip and offset
  std::string chip{};  ///< label
  unsigned offset = 0;

  /// "TRIGGER_IN" or "pinctrl-bcm2711 line 17"
  std::string text() const {
    return name.empty() ? chip + " line " + std::to_string(offset) : name;
  }
};

/// The chip's pull resistor; a chip without one refuses.
enum class LineBias : std::uint8_t { AsIs, Disabled, PullUp, PullDown };

/// A change of a line's logical level, which is the wire's unless the line is active low.
enum class Edge : std::uint8_t { Rising, Falling };

/// The edge that leads to a level.
constexpr Edge edge_to(bool active) { return active ? Edge::Rising : Edge::Falling; }

struct EdgeEvent {
  Edge edge = Edge::Rising;
  TimePoint stamp;  ///< the kernel's; with debounce: of the edge to the level that was kept
};

/// The faults of a line in use. Append, never renumber.
enum class LineFault : std::uint8_t {
  None = 0,
  Gone = 1,
  ReadError = 2,
};

/// The one place of the operator's text for each fault.
constexpr std::string_view operator_text(LineFault fault) {
  switch (fault) {
    case LineFault::None:
      return "line works";
    case LineFault::Gone:
      return "the line's chip is not connected";
    case LineFault::ReadError:
      return "line reports an error";
  }
  return "unknown line fault";
}

/// A change of a line's state. LineFault::None: it works again.
struct LineFaultReport {
  LineFault fault = LineFault::None;
  std::string detail;  ///< line and system message; may be empty
};

/// A value of a line in use, or its fault.
template <class T = void>
using LineResult = tl::expected<T, LineFaultReport>;

}  // namespace orbwatch::hal
