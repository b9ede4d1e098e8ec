#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace orbwatch::app {

/// Causes of throttling, the low bits of Health::throttling. The bits are those of the Raspberry
/// Pi's firmware (vcgencmd get_throttled). The PLC reads the numbers: append, never renumber.
enum class Throttling : std::uint8_t {
  UnderVoltage = 1,
  FrequencyCapped = 2,
  Throttled = 4,
  SoftTemperatureLimit = 8,
};

/// Shifted up by so many places, a bit states that the cause occurred since power-on, as far as the
/// board or this program detected it.
inline constexpr int kSincePowerOn = 4;

/// Reads every source of throttling: the Raspberry Pi's firmware and supply monitor, cooling
/// devices that slow processors down (most arm boards), the counters of x86 processors.
/// Thread-bound.
class ThrottlingMonitor {
 public:
  /// `sys`: where sysfs is mounted.
  explicit ThrottlingMonitor(std::filesystem::path sys) : sys_(std::move(sys)) {}

  /// The bits; nullopt when the board has no source.
  std::optional<std::uint8_t> read();

 private:
  std::filesystem::path sys_;
  unsigned since_power_on_ = 0;
  std::optional<std::int64_t> events_;  ///< of the x86 counters, at the last reading
};

}  // namespace orbwatch::app
