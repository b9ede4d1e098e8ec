// SPDX-License-Identifier: Apache-2.0
#include "hal/recording/picture_region.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

namespace orbwatch::hal::recording {
namespace {

/// Largest shifts of the format's planes: columns and rows that share chroma, as powers of 2.
struct Sharing {
  int x = 0, y = 0;
};

Sharing sharing_of(PixelFormat format) {
  // Packed 4:2:2 has its chroma in the first plane.
  Sharing sharing{format == PixelFormat::Yuyv || format == PixelFormat::Uyvy ? 1 : 0, 0};
  for (const PlaneInfo& plane : info(format).planes) {
    sharing.x = std::max(sharing.x, plane.shift_x);
    sharing.y = std::max(sharing.y, plane.shift_y);
  }
  return sharing;
}

int rounded_down(int value, int shift) { return value >> shift << shift; }
int rounded_up(int value, int shift) { return rounded_down(value + (1 << shift) - 1, shift); }

std::string sides(std::int64_t width, std::int64_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

bool is_side(std::uint32_t side) { return side >= 1 && side <= std::uint32_t{kMaxSide}; }

/// Bytes of a pixel of the plane.
int pixel_bytes(const PixelFormatInfo& facts, const PlaneInfo& plane) {
  return plane.samples * facts.bytes_per_sample();
}

/// Calls `act` with the first byte of each row of the plane `n`, and its bytes.
template <class Act>
void for_each_row(const MutablePicture& picture, std::size_t n, const Act& act) {
  const PixelFormatInfo& facts = info(picture.format);
  const PlaneInfo& plane = facts.planes[n];
  const int bytes = (picture.width >> plane.shift_x) * pixel_bytes(facts, plane);
  for (int y = 0; y < picture.height >> plane.shift_y; ++y) {
    act(y, picture.planes[n].data + y * picture.planes[n].stride, static_cast<std::size_t>(bytes));
  }
}

}  // namespace

PictureRegion widened(const PictureRegion& region, PixelFormat format) {
  const auto [x, y] = sharing_of(format);
  const int left = rounded_down(region.x, x);
  const int top = rounded_down(region.y, y);
  return {left, top, rounded_up(region.x + region.width, x) - left,
          rounded_up(region.y + region.height, y) - top};
}

CameraInfo camera_info_of(const PicturePlace& place, Header header) {
  CameraInfo message;
  message.header = std::move(header);
  message.width = static_cast<std::uint32_t>(place.width);
  message.height = static_cast<std::uint32_t>(place.height);
  const auto& [x, y, width, height] = place.region;
  if (width == place.width && height == place.height) return message;
  message.roi.x_offset = static_cast<std::uint32_t>(x);
  message.roi.y_offset = static_cast<std::uint32_t>(y);
  message.roi.width = static_cast<std::uint32_t>(width);
  message.roi.height = static_cast<std::uint32_t>(height);
  return message;
}

Result<PicturePlace> place_of(const CameraInfo& message) {
  const auto& [x, y, height, width, rectified] = message.roi;
  if (!is_side(message.width) || !is_side(message.height)) {
    return fail("camera_info: picture of " + sides(message.width, message.height) +
                "; its sides must be 1 to " + std::to_string(kMaxSide));
  }
  if (message.binning_x > 1 || message.binning_y > 1) {
    return fail("camera_info: binning of " + sides(message.binning_x, message.binning_y) +
                "; only whole pixels (0 or 1) are read");
  }
  PicturePlace place{static_cast<int>(message.width), static_cast<int>(message.height), {}};
  place.region = {0, 0, place.width, place.height};
  if (RegionOfInterest whole{.do_rectify = rectified}; message.roi == whole) return place;
  const bool is_inside = width >= 1 && height >= 1 && width <= message.width &&
                         height <= message.height && x <= message.width - width &&
                         y <= message.height - height;
  if (!is_inside) {
    return fail("camera_info: region of " + sides(width, height) + " at " + std::to_string(x) +
                "," + std::to_string(y) + "; it must be inside of the picture of " +
                sides(message.width, message.height));
  }
  place.region = {static_cast<int>(x), static_cast<int>(y), static_cast<int>(width),
                  static_cast<int>(height)};
  return place;
}

Result<> check_fit(PixelFormat format, int width, int height, const PicturePlace& place,
                   PixelFormat whole) {
  const PictureRegion& region = place.region;
  if (width != region.width || height != region.height) {
    return fail("picture of " + sides(width, height) + "; camera_info has a region of " +
                sides(region.width, region.height));
  }
  if (format != whole) {
    return fail("pixel format " + std::string(info(format).name) +
                "; the camera's first picture has " + std::string(info(whole).name));
  }
  const PictureRegion all{0, 0, place.width, place.height};
  if (widened(region, format) != region || widened(all, format) != all) {
    return fail("region at " + std::to_string(region.x) + "," + std::to_string(region.y) + " of " +
                sides(region.width, region.height) + " in pixel format " +
                std::string(info(format).name) +
                "; its edges must be even where pixels share chroma");
  }
  return {};
}

void copy_pixels(const Picture& from, const MutablePicture& to) {
  for (std::size_t n = 0; n < info(to.format).plane_count(); ++n) {
    for_each_row(to, n, [&](int y, std::byte* row, std::size_t bytes) {
      std::memcpy(row, from.planes[n].data + y * from.planes[n].stride, bytes);
    });
  }
}

void blacken(const MutablePicture& picture) {
  constexpr int kNeutralChroma = 128;
  const PixelFormatInfo& facts = info(picture.format);
  for (std::size_t n = 0; n < facts.plane_count(); ++n) {
    const int fill = facts.colour == ColourModel::Yuv && n > 0 ? kNeutralChroma : 0;
    for_each_row(picture, n, [&](int, std::byte* row, std::size_t bytes) {
      std::memset(row, fill, bytes);
      if (facts.colour != ColourModel::Yuv || facts.plane_count() > 1) return;
      for (std::size_t k = picture.format == PixelFormat::Yuyv ? 1 : 0; k < bytes; k += 2) {
        row[k] = std::byte{kNeutralChroma};
      }
    });
  }
}

}  // namespace orbwatch::hal::recording
