#pragma once

#include <filesystem>

#include "app/dds/image_message.h"

namespace orbwatch::app {

/// Writes the image as PNG, 16 bit kept, in place of whatever `path` names: readers see the old
/// file or the new one. Errors: folder missing or not writable, disk full.
Result<> save_png(const ReceivedImage& image, const std::filesystem::path& path);

}  // namespace orbwatch::app
