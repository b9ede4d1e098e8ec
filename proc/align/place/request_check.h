#pragma once

#include <string>

#include "proc/align/place/placement.h"
#include "proc/image/result.h"

namespace orbwatch::align {

/// What a request for placement must keep to before anything is solved; place() lists the errors.
Result<> check_request(const PlaceRequest& request);

/// The request with a lens for cameras whose focal length is unknown: a start, as long as the
/// picture's longer side, and the principal point in the picture's middle.
PlaceRequest with_lenses(const PlaceRequest& request);

/// For messages: "point 3 (X, Y, Z mm)", counted from 1.
std::string point_text(const PlaceRequest& request, std::size_t point);

/// For messages: "camera A: point 3 (X, Y, Z mm), marked at (U, V)".
std::string mark_text(const PlaceRequest& request, std::size_t camera, std::size_t mark);

/// A number for messages: three digits that count.
std::string short_number(double value);

}  // namespace orbwatch::align
