#pragma once

#include <cstddef>

#include "proc/image/picture.h"

namespace orbwatch::app {

/// Bytes of a picture of one plane whose rows have no padding.
std::size_t packed_bytes(PixelFormat format, int width, int height);

/// Writes `picture` as Rgb, Bgr, Grey or Y16, rows without padding, to `out`, which holds
/// packed_bytes(to, width, height). Luminance becomes grey; Y16 takes counts as they are, Grey the
/// upper 8 of their bits, and Y' as the camera gave it, not stretched. From any format but colour
/// to Y16. Allocates nothing; reentrant.
void convert(const Picture& picture, PixelFormat to, std::byte* out);

/// Whether convert() does it.
bool converts(PixelFormat from, PixelFormat to);

}  // namespace orbwatch::app
