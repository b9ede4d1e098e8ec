// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "hal/camera.h"
#include "proc/remap/remap.h"

namespace orbwatch::app::pipeline {

/// The greatest value of a format's samples.
double full_scale(const hal::StreamFormat& format);

/// A number as files and commands state it, degC of a radiometric camera, else percent of full
/// scale, in counts of a camera. Reentrant.
double counts_of(double value, const hal::StreamFormat& format);

/// A camera's counts in colour, from the first value of `range`, as counts_of() takes it, to the
/// last. Reentrant; not for the frame path.
remap::ColourMap make_colour_map(const remap::ColourMap::Table& table,
                                 const std::array<double, 2>& range,
                                 const hal::StreamFormat& format);

}  // namespace orbwatch::app::pipeline
