#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "app/cli/dds/received_image.h"

namespace orbwatch::app {

/// Writes the image as PNG, 16 bit kept, in place of whatever `path` names: readers see the old
/// file or the new one. Errors: folder missing or not writable, disk full.
Result<> save_png(const ReceivedImage& image, const std::filesystem::path& path);

/// The same for the picture in a JPEG file. Error: also data that is damaged.
Result<> save_jpeg_as_png(std::span<const std::uint8_t> jpeg, const std::filesystem::path& path);

}  // namespace orbwatch::app
