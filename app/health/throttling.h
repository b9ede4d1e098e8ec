#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace orbwatch::app {

/// What holds the processors back; the low bits of Health::throttling. The bits and their order are
/// those of the Raspberry Pi's firmware (vcgencmd get_throttled). The numbers go to the PLC:
/// append, never renumber.
enum class Throttling : std::uint8_t {
  UnderVoltage = 1,
  FrequencyCapped = 2,
  Throttled = 4,
  SoftTemperatureLimit = 8,
};

/// A bit that many places up says that it was so at some time since power-on, as far as the board
/// or this program noticed.
inline constexpr int kSincePowerOn = 4;

/// Asks everything that can know of throttling: the Raspberry Pi's firmware and its supply monitor,
/// cooling devices that slow the processors down (most arm boards), the counters of x86 processors.
/// Thread-bound.
class ThrottlingMonitor {
 public:
  /// `sys`: where sysfs is mounted.
  explicit ThrottlingMonitor(std::filesystem::path sys) : sys_(std::move(sys)) {}

  /// The bits; nothing when this board tells nothing.
  std::optional<std::uint8_t> read();

 private:
  std::filesystem::path sys_;
  unsigned since_power_on_ = 0;
  std::optional<std::int64_t> events_;  ///< of the x86 counters, at the last reading
};

}  // namespace orbwatch::app
