#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

#include "app/modbus/snapshot.h"
#include "proc/signals/signals.h"

namespace orbwatch::app::modbus {

/// How figures become the contents of registers. All reentrant.

/// What a signal without a value reads.
inline constexpr std::uint32_t kNotValidCode = 0x80000000;

/// A counter's lower half: it goes on at 0 after 2^32 - 1.
std::uint32_t low_word(std::uint64_t count);

/// A figure that is never negative, in 16 bits: round(value / scale), which stays at 65535 instead
/// of wrapping; 0 when it is not a number.
std::uint32_t saturated(double value, double scale);

/// A signal: round(value / scale) as a signed number, or kNotValidCode. Clamped to the signal's
/// range, which rounding noise of the computation must not leave.
std::uint32_t scaled(double value, const signals::SignalInfo& signal);

/// Milliseconds up to 2^31 - 1, no further: a PLC that reads them as a signed double word (DINT)
/// must never see a negative age.
std::uint32_t age_code(std::chrono::milliseconds age);

/// Places in the status bits, and the addresses of the discrete inputs.
enum StatusBit : int {
  kRunning = 0,
  kDegraded = 1,
  kFault = 2,
  kHotSpotPresent = 3,
  kStale = 4,
  kFirstCamera = 8,
  kStatusBits = 16,
};

/// All discrete inputs in one word.
std::uint32_t status_bits(const Snapshot& snapshot);

}  // namespace orbwatch::app::modbus
