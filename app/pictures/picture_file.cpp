// SPDX-License-Identifier: Apache-2.0
#include "app/pictures/picture_file.h"

#include <algorithm>
#include <cctype>
#include <string>

#include "app/pictures/jpeg_encoder.h"
#include "app/pictures/png_encoder.h"
#include "hal/atomic_file.h"
#include "proc/image/image_view.h"

namespace orbwatch::app {
namespace {

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace

Result<> check_picture_name(const std::filesystem::path& path, PixelFormat format,
                            bool transparency) {
  const std::string extension = lower_extension(path);
  if (extension == ".png") return {};
  if (extension != ".jpg" && extension != ".jpeg") {
    return fail(path.string() +
                ": unknown kind of picture; its name must end in .png, .jpg or .jpeg");
  }
  if (transparency) return fail(path.string() + ": JPEG has no transparency; write a .png");
  if (info(format).bytes_per_sample() == 2) {
    return fail(path.string() + ": JPEG has 8 bits, the picture has 16; write a .png");
  }
  return {};
}

Result<> write_picture(const std::filesystem::path& path, const Picture& picture,
                       const ImageView<const std::uint8_t>& validity) {
  if (auto named = check_picture_name(path, picture.format, !validity.empty()); !named)
    return named;
  const auto named = [&path](const Error& error) {
    return fail(path.string() + ": the picture cannot be encoded: " + error.message);
  };
  if (lower_extension(path) == ".png") {
    const auto png = encode_png(picture, validity);
    if (!png) return named(png.error());
    return hal::write_file(path, *png);
  }
  constexpr int kQuality = 95;
  JpegEncoder encoder;
  const auto jpeg = encoder.encode(picture, kQuality);
  if (!jpeg) return named(jpeg.error());
  return hal::write_file(path, *jpeg);
}

}  // namespace orbwatch::app
