// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "proc/image/picture.h"

namespace orbwatch::app {

/// Size in bytes of a single-plane picture whose rows have no padding.
std::size_t packed_bytes(PixelFormat format, int width, int height);

/// Writes `picture` as Rgb, Bgr, Grey or Y16, rows without padding, to `out`, which has
/// packed_bytes(to, width, height). Luminance becomes grey. Y16 has the counts unchanged, Grey the
/// upper 8 of their bits, or Y' in the camera's own range. Supports every pair of formats except
/// colour to Y16: see converts(). Allocates nothing; reentrant.
void convert(const Picture& picture, PixelFormat to, std::byte* out);

/// True if convert() supports this pair of formats.
bool converts(PixelFormat from, PixelFormat to);

}  // namespace orbwatch::app
