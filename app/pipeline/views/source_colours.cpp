// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/views/source_colours.h"

#include "proc/image/celsius.h"

namespace orbwatch::app::pipeline {

double full_scale(const hal::StreamFormat& format) { return (1 << info(format.format).bits) - 1; }

double counts_of(double value, const hal::StreamFormat& format) {
  if (format.kelvin_per_count > 0) {
    return counts_of_kelvin(value + kZeroCelsius, format.kelvin_per_count, format.kelvin_offset);
  }
  return value / 100 * full_scale(format);
}

remap::ColourMap make_colour_map(const remap::ColourMap::Table& table,
                                 const std::array<double, 2>& range,
                                 const hal::StreamFormat& format) {
  return {table, counts_of(range[0], format), counts_of(range[1], format)};
}

}  // namespace orbwatch::app::pipeline
