#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "app/ports/modbus/map/process_image.h"

namespace orbwatch::app::modbus {

/// One bit of a word, and a discrete input where the word consists of those.
struct Bit {
  std::string name;  ///< empty: reserved
  std::string description{};
  std::function<bool(const ProcessImage&)> is_set{};
};

/// The bits of each word, bit 0 (the lowest) first. All reentrant.
std::vector<Bit> status_bits();
std::vector<Bit> measurement_bits();
std::vector<Bit> process_input_bits();
std::vector<Bit> active_bits();
std::vector<Bit> unacknowledged_bits();
/// What is wrong; these are not discrete inputs.
std::vector<Bit> fault_bits();

/// Bit n of the word is that of bits[n].
std::uint32_t word_of(const std::vector<Bit>& bits, const ProcessImage& image);

}  // namespace orbwatch::app::modbus
