// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "proc/align/place/placement.h"
#include "proc/image/result.h"

namespace orbwatch::align {

/// Checks a request for placement before anything is solved; place() lists the errors.
Result<> check_request(const PlaceRequest& request);

/// The request with a lens for cameras whose focal length is unknown: an initial focal length equal
/// to the picture's longer side, and the principal point in the picture's middle.
PlaceRequest with_lenses(const PlaceRequest& request);

/// Text for messages: "point 3 (X, Y, Z mm)", counted from 1.
std::string point_text(const PlaceRequest& request, std::size_t point);

/// Text for messages: "camera A: point 3 (X, Y, Z mm), marked at (U, V)".
std::string mark_text(const PlaceRequest& request, std::size_t camera, std::size_t mark);

/// A number for messages with three significant digits.
std::string short_number(double value);

}  // namespace orbwatch::align
