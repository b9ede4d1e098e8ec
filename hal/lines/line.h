// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "hal/clock.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Address of a line: the board's name of it, or the label of its chip and its offset there. A
/// chip's number is not an address: it changes between boots.
struct LineAddress {
  std::string name{};  ///< empty: addressed by chip and offset
  std::string chip{};  ///< label of the chip
  unsigned offset = 0;

  /// Text such as "TRIGGER_IN" or "pinctrl-bcm2711 line 17".
  std::string text() const {
    return name.empty() ? chip + " line " + std::to_string(offset) : name;
  }
};

/// Pull resistor of the chip; a chip without one refuses.
enum class LineBias : std::uint8_t { AsIs, Disabled, PullUp, PullDown };

/// Change of a line's logical level, which is the wire's unless the line is active low.
enum class Edge : std::uint8_t { Rising, Falling };

/// Edge that leads to a level.
constexpr Edge edge_to(bool active) { return active ? Edge::Rising : Edge::Falling; }

struct EdgeEvent {
  Edge edge = Edge::Rising;
  TimePoint stamp;  ///< kernel's stamp; with debounce that of the edge to the level that was kept
  /// Edges that a full queue dropped between the previous edge and this one, if the kernel numbers
  /// edges (libgpiod 2.x); otherwise 0.
  std::uint32_t lost_before = 0;
};

/// Faults of a line in use. Append, never renumber.
enum class LineFault : std::uint8_t {
  None = 0,
  Gone = 1,
  ReadError = 2,
};

/// The operator's text for each fault, declared only here.
constexpr std::string_view operator_text(LineFault fault) {
  switch (fault) {
    case LineFault::None:
      return "line works";
    case LineFault::Gone:
      return "line is not there, or cannot be opened";
    case LineFault::ReadError:
      return "line reports an error";
  }
  return "unknown line fault";
}

/// The word for each fault in the log, declared only here; empty for an unknown one.
constexpr std::string_view word(LineFault fault) {
  switch (fault) {
    case LineFault::None:
      return "";
    case LineFault::Gone:
      return "line_gone";
    case LineFault::ReadError:
      return "line_read_error";
  }
  return {};
}

/// Change of a line's state. LineFault::None: it works again.
struct LineFaultReport {
  LineFault fault = LineFault::None;
  std::string detail;  ///< line and system message; may be empty
};

/// Value of a line in use, or its fault.
template <class T = void>
using LineResult = tl::expected<T, LineFaultReport>;

/// Consumer name of our lines in the kernel.
inline constexpr const char* kLineConsumer = "orbwatch";

struct InputSettings {
  LineAddress address{};
  bool active_low = false;  ///< GenICam LineInverter
  LineBias bias = LineBias::AsIs;
  Clock::duration debounce{0};  ///< GenICam LineDebouncerTime: shorter pulses are not edges
};

struct OutputSettings {
  LineAddress address{};
  bool active_low = false;
  LineBias bias = LineBias::AsIs;  ///< pulls the wire to a level when it is not driven
};

/// Digital input. Both edges are recorded once it is open. Thread-bound, apart from level().
class DigitalInput {
 public:
  DigitalInput() = default;
  DigitalInput(const DigitalInput&) = delete;
  DigitalInput& operator=(const DigitalInput&) = delete;
  virtual ~DigitalInput() = default;

  /// File descriptor for epoll, readable when edges wait or the line has a fault.
  virtual int descriptor() const = 0;

  /// Takes waiting edges, oldest first, at most `edges.size()`; returns their number. Never waits.
  virtual LineResult<std::size_t> take(std::span<EdgeEvent> edges) = 0;

  /// True if the line is active now.
  virtual LineResult<bool> level() const = 0;

  /// True if the edges are debounced already, with InputSettings::debounce.
  virtual bool is_debounced() const = 0;
};

/// Digital output: inactive when opened, and set inactive before it is released. When the process
/// dies, the kernel releases it, and the driver determines the level of the wire: most chips keep
/// the level, some turn the line into an input, and then the pull resistor decides. A safe state
/// needs that resistor, or a WatchdogOutput with a time relay.
class DigitalOutput {
 public:
  DigitalOutput() = default;
  DigitalOutput(const DigitalOutput&) = delete;
  DigitalOutput& operator=(const DigitalOutput&) = delete;
  virtual ~DigitalOutput() = default;

  virtual LineResult<> set(bool active) = 0;
};

struct LineInfo {
  unsigned offset = 0;
  std::string name;  ///< board's name of the line; may be empty
  bool is_output = false;
  bool is_used = false;
  std::string consumer;  ///< consumer that the kernel reports
};

struct ChipInfo {
  std::string path;     ///< device node: for messages, never stored
  std::string label{};  ///< driver's label, stable
  std::vector<LineInfo> lines{};
  std::string error{};  ///< reason why it could not be opened; then label and lines are empty
};

/// Back-end of lines: the kernel's or simulated. Thread-safe.
class LineBackEnd {
 public:
  LineBackEnd() = default;
  LineBackEnd(const LineBackEnd&) = delete;
  LineBackEnd& operator=(const LineBackEnd&) = delete;
  virtual ~LineBackEnd() = default;

  /// Chips that are connected now, including those that cannot be opened.
  virtual std::vector<ChipInfo> chips() const = 0;

  /// Errors: no such line (with a list of the existing ones), in use (with the consumer's name), no
  /// permission (with the group that has it), not supported by the chip.
  virtual Result<std::unique_ptr<DigitalInput>> open_input(const InputSettings& settings) = 0;
  virtual Result<std::unique_ptr<DigitalOutput>> open_output(const OutputSettings& settings) = 0;
};

}  // namespace orbwatch::hal
