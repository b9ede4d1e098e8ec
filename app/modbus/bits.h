#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "app/modbus/snapshot.h"

namespace orbwatch::app::modbus {

/// One bit of a word, and one discrete input where the word is one of those.
struct Bit {
  std::string name;  ///< empty: reserved
  std::string description{};
  std::function<bool(const Snapshot&)> is_set{};
};

/// Where the words stand among the discrete inputs.
inline constexpr int kStatusBits = 0;
inline constexpr int kMeasurementBits = 16;
inline constexpr int kProcessInputBits = 32;
inline constexpr int kActiveBits = 64;
inline constexpr int kUnacknowledgedBits = 96;
inline constexpr int kDiscreteInputs = 128;

/// The bits of each word, bit 0 (the lowest) first. All reentrant.
const std::vector<Bit>& status_bits();
const std::vector<Bit>& measurement_bits();
const std::vector<Bit>& process_input_bits();
const std::vector<Bit>& active_bits();
const std::vector<Bit>& unacknowledged_bits();
/// What is wrong; these are no discrete inputs.
const std::vector<Bit>& fault_bits();

/// Bit n of the word is that of bits[n].
std::uint32_t word_of(const std::vector<Bit>& bits, const Snapshot& snapshot);

}  // namespace orbwatch::app::modbus
