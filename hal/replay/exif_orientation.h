// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace orbwatch::hal {

/// Orientation (CIPA DC-008, tag 0x0112) of a JPEG picture: 1 upright, 2 to 8 turned or mirrored.
/// The first APP1 segment that begins with "Exif" counts, wherever it is before the start of scan:
/// XMP, also in an APP1 segment, may precede it. 1 for data without a valid orientation. Reentrant.
int exif_orientation(std::span<const std::byte> jpeg);

/// The same of EXIF data alone, which begins with a TIFF header.
int tiff_orientation(std::span<const std::byte> tiff);

}  // namespace orbwatch::hal
