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

/// The consumer's name of our lines in the kernel.
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
  LineBias bias = LineBias::AsIs;  ///< holds the wire when it is not driven
};

/// An input. Both edges are recorded once it is open.
/// Thread-bound, apart from level().
class DigitalInput {
 public:
  DigitalInput() = default;
  DigitalInput(const DigitalInput&) = delete;
  DigitalInput& operator=(const DigitalInput&) = delete;
  virtual ~DigitalInput() = default;

  /// A file descriptor for epoll, readable when edges wait or the line has a fault.
  virtual int descriptor() const = 0;

  /// Takes waiting edges, oldest first, at most `edges.size()`; returns how many. Never waits.
  virtual LineResult<std::size_t> take(std::span<EdgeEvent> edges) = 0;

  /// Whether the line is active now.
  virtual LineResult<bool> level() const = 0;

  /// Edges dropped by a full queue, where edges are numbered; else nullopt, and EdgeFilter
  /// estimates.
  virtual std::optional<std::uint64_t> lost() const = 0;

  /// Whether the edges are debounced already, with InputSettings::debounce.
  virtual bool is_debounced() const = 0;
};

/// An output: inactive when opened, and set inactive before it is released. When the process dies,
/// the kernel releases it, and the driver decides on the wire: most chips keep the level, some turn
/// the line into an input, where the pull resistor decides. A safe state needs that resistor, or a
/// WatchdogOutput with a time relay.
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
  std::string name;  ///< the board's; may be empty
  bool is_output = false;
  bool is_used = false;
  std::string consumer;  ///< according to the kernel
};

struct ChipInfo {
  std::string path;     ///< device node: for messages, never stored
  std::string label{};  ///< of the driver, stable
  std::vector<LineInfo> lines{};
  std::string error{};  ///< why it could not be opened; then label and lines are empty
};

/// A back-end of lines: the kernel's or simulated. Thread-safe.
class LineBackEnd {
 public:
  LineBackEnd() = default;
  LineBackEnd(const LineBackEnd&) = delete;
  LineBackEnd& operator=(const LineBackEnd&) = delete;
  virtual ~LineBackEnd() = default;

  /// The chips that are connected now, including those that cannot be opened.
  virtual std::vector<ChipInfo> chips() const = 0;

  /// Errors: no such line (with a list of the existing ones), in use (with the consumer's name), no
  /// permission (with the group that has it), not supported by the chip.
  virtual Result<std::unique_ptr<DigitalInput>> open_input(const InputSettings& settings) = 0;
  virtual Result<std::unique_ptr<DigitalOutput>> open_output(const OutputSettings& settings) = 0;
};

}  // namespace orbwatch::hal
