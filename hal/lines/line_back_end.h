#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/lines/line.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// What other programs see as the user of our lines.
inline constexpr const char* kLineConsumer = "orbwatch";

struct InputSettings {
  LineAddress address{};
  bool active_low = false;  ///< GenICam LineInverter
  LineBias bias = LineBias::AsIs;
  Clock::duration debounce{0};  ///< GenICam LineDebouncerTime: shorter pulses are no edges
};

struct OutputSettings {
  LineAddress address{};
  bool active_low = false;
  LineBias bias = LineBias::AsIs;  ///< what holds the wire when nobody drives it
};

/// A line that is read. Both edges are watched from the moment it is opened.
/// Thread-bound, apart from level().
class DigitalInput {
 public:
  DigitalInput() = default;
  DigitalInput(const DigitalInput&) = delete;
  DigitalInput& operator=(const DigitalInput&) = delete;
  virtual ~DigitalInput() = default;

  /// A file that is readable, for epoll, when edges wait or the line has a fault.
  virtual int descriptor() const = 0;

  /// Takes edges that wait, oldest first, at most `edges.size()`; says how many. Never waits.
  virtual LineResult<std::size_t> take(std::span<EdgeEvent> edges) = 0;

  /// Whether the line is active at this moment.
  virtual LineResult<bool> level() const = 0;

  /// Edges that were dropped because nobody took them in time, where edges are numbered; else
  /// nothing, and only EdgeFilter can tell.
  virtual std::optional<std::uint64_t> lost() const = 0;

  /// Whether the edges are debounced already as InputSettings::debounce asks.
  virtual bool is_debounced() const = 0;
};

/// A line that is driven: inactive from the moment it is opened, and made inactive before it is
/// given back. When the process dies, the kernel gives it back at once, and what the wire then does
/// is the driver's choice: most chips keep the level, some turn the line into an input, where the
/// pull resistor decides. A safe state needs that resistor, or a WatchdogOutput behind a time
/// relay.
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
  std::string name;  ///< empty: the board gives none
  bool is_output = false;
  bool is_used = false;
  std::string consumer;  ///< who uses it, as the kernel knows
};

struct ChipInfo {
  std::string path;     ///< device node: for messages, never stored
  std::string label{};  ///< of the driver, stable
  std::vector<LineInfo> lines{};
  std::string error{};  ///< why it could not be opened; then it has no label and no lines
};

/// A kind of lines: the kernel's or simulated ones. Thread-safe.
class LineBackEnd {
 public:
  LineBackEnd() = default;
  LineBackEnd(const LineBackEnd&) = delete;
  LineBackEnd& operator=(const LineBackEnd&) = delete;
  virtual ~LineBackEnd() = default;

  /// All chips of this moment, also those that cannot be opened.
  virtual std::vector<ChipInfo> chips() const = 0;

  /// Errors: no such line (with those there are), used by another (with its name), no permission
  /// (with the group that has it), not possible on this chip.
  virtual Result<std::unique_ptr<DigitalInput>> open_input(const InputSettings& settings) = 0;
  virtual Result<std::unique_ptr<DigitalOutput>> open_output(const OutputSettings& settings) = 0;
};

}  // namespace orbwatch::hal
