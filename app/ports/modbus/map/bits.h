// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "app/ports/modbus/map/process_image.h"

namespace orbwatch::app::modbus {

/// One bit of a word; also a discrete input if the word mirrors discrete inputs.
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
/// Present faults; these bits are not discrete inputs.
std::vector<Bit> fault_bits();

/// Bit n of the word has the value of bits[n].
std::uint32_t word_of(const std::vector<Bit>& bits, const ProcessImage& image);

}  // namespace orbwatch::app::modbus
