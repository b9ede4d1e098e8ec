// SPDX-License-Identifier: Apache-2.0
#include "app/watch/kept_file.h"

#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <system_error>

#include "app/pictures/picture_file.h"

namespace orbwatch::app {
namespace {

/// CRC-32 of the outline's numbers as a TOML list with 10 digits: earlier versions' files stay
/// valid.
std::uint32_t checksum(const optics::Outline& outline) {
  std::string text;
  for (const double value :
       {outline.centre.u, outline.centre.v, outline.rx, outline.ry, outline.angle}) {
    char number[32];
    std::snprintf(number, sizeof number, "%s%.10g", text.empty() ? "[" : ", ",
                  value == 0 ? 0 : value);  // no -0
    text += number;
  }
  text += "]";
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(text.data()), text.size()));
}

/// The folder, without the files of other alignments of the camera; as far as that is possible.
void make_room(const std::filesystem::path& kept) {
  const std::string name = kept.filename().string();
  const std::string prefix = name.substr(0, name.rfind('-') + 1);
  // A camera whose name begins alike has longer names of files.
  const auto is_of_camera = [&](const std::string& other) {
    return other.starts_with(prefix) && other.size() == name.size();
  };
  std::error_code error;
  std::filesystem::create_directories(kept.parent_path(), error);
  for (std::filesystem::directory_iterator it(kept.parent_path(), error), end; !error && it != end;
       it.increment(error)) {
    if (it->path() != kept && is_of_camera(it->path().filename().string())) {
      std::filesystem::remove(it->path(), error);
    }
  }
}

}  // namespace

std::filesystem::path kept_file(const std::filesystem::path& folder, const std::string& what,
                                const std::string& camera, const optics::Outline& outline) {
  char number[16];
  std::snprintf(number, sizeof number, "%08x", checksum(outline));
  return folder / (what + "-" + camera + "-" + number + ".png");
}

Result<> keep_file(const std::filesystem::path& kept, const cv::Mat& pixels) {
  make_room(kept);
  const PixelFormat format = pixels.depth() == CV_16U ? PixelFormat::Y16 : PixelFormat::Grey;
  return write_picture(kept, Picture::contiguous(format, pixels.cols, pixels.rows,
                                                 reinterpret_cast<const std::byte*>(pixels.data),
                                                 static_cast<std::ptrdiff_t>(pixels.step)));
}

}  // namespace orbwatch::app
