// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/export/pictures/picture_stack.h"

#include <nlohmann/json.hpp>

#include "app/ports/recorder/export/pictures/camera_pictures.h"
#include "app/ports/recorder/export/pictures/tiff_writer.h"
#include "app/ports/recorder/recorded_utc.h"
#include "proc/image/celsius.h"

namespace orbwatch::app::recorder {
namespace {

using Description = nlohmann::ordered_json;

/// Facts about a picture, ASCII.
std::string description_of(const CameraPictures& pictures, const ExportedPicture& picture) {
  const hal::StreamFormat& format = pictures.index().format;
  Description facts{{"utc", utc_text_at(picture.exposure.start)}, {"camera", pictures.camera()}};
  if (picture.state != nullptr) facts["frame_set"] = picture.state->frame_set;
  facts["x"] = picture.exposure.region.x;
  facts["y"] = picture.exposure.region.y;
  facts["width"] = format.width;
  facts["height"] = format.height;
  if (format.kelvin_per_count > 0 && info(format.format).bytes_per_sample() > 1) {
    facts["celsius_per_count"] = format.kelvin_per_count;
    facts["celsius_at_zero"] = format.kelvin_offset - kZeroCelsius;
  }
  return facts.dump(-1, ' ', true, Description::error_handler_t::replace);
}

}  // namespace

Result<> write_picture_stack(const std::filesystem::path& recording, const std::string& camera,
                             const StampRange& range, const std::filesystem::path& output,
                             const ExportSteps& steps) {
  auto pictures = CameraPictures::open(recording, camera, range);
  if (!pictures) return tl::unexpected(pictures.error());
  const PixelFormat format = pictures->index().format.format;
  if (!TiffWriter::can_write(format)) {
    return fail("the pictures of " + pictures->camera() + " are " + std::string(info(format).name) +
                "; .tif is for grey and RGB, .avi for any camera");
  }
  auto tiff = TiffWriter::create(output);
  if (!tiff) return tl::unexpected(tiff.error());
  for (std::size_t done = 0; !pictures->is_done(); ++done) {
    if (!steps(done, pictures->count(), "pictures")) return cancelled_export();
    const auto picture = pictures->next();
    if (!picture) return tl::unexpected(picture.error());
    const auto pixels = pictures->pixels(*picture);
    if (!pixels) return tl::unexpected(pixels.error());
    auto added = tiff->add(*pixels, description_of(*pictures, *picture));
    if (!added) return added;
  }
  return tiff->finish();
}

}  // namespace orbwatch::app::recorder
