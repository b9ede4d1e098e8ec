#pragma once

#include <cstddef>
#include <span>

namespace orbwatch::hal {

/// The orientation (CIPA DC-008, tag 0x0112) of a JPEG picture: 1 as it lies, 2 to 8 turned or
/// mirrored. The first APP1 segment that begins with "Exif" counts, wherever it stands before the
/// start of scan: XMP, which is APP1 as well, may stand in front of it. 1 for data without a valid
/// orientation. Reentrant.
int exif_orientation(std::span<const std::byte> jpeg);

}  // namespace orbwatch::hal
