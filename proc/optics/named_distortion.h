// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

#include "proc/optics/lens.h"

namespace orbwatch::optics {

/// A distortion in the terms of ROS and OpenCV: the model's name and the number of
/// Intrinsics::coefficients, from the first on, that it has.
struct NamedDistortion {
  std::string_view model;  ///< string literal
  std::size_t count = 0;
};

/// No distortion is plumb_bob with zeros. Reentrant.
inline NamedDistortion named_distortion(const Intrinsics& intrinsics) {
  const auto& k = intrinsics.coefficients;
  if (intrinsics.distortion == Distortion::Fisheye) return {"equidistant", 4};
  if (k[5] == 0 && k[6] == 0 && k[7] == 0) return {"plumb_bob", 5};
  return {"rational_polynomial", 8};
}

}  // namespace orbwatch::optics
