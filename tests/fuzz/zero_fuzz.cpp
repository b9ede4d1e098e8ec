// SPDX-License-Identifier: Apache-2.0
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <string>

#include "app/watch/kept_zero.h"
#include "tests/fuzz/stop.h"

/// Any bytes as the file that keeps the zero of a drift: they are refused in one line, or are a
/// possible place and a picture of the camera's size.
///
/// An input is tried as it is, and with a right beginning and checksum, which chance would hardly
/// find.
namespace orbwatch::fuzz {
namespace {

constexpr app::ZeroSubject kSubject{
    .alignment = 1, .width = 16, .height = 12, .format = PixelFormat::Y10};

void try_zero(const std::string& content) {
  const auto read = app::parsed_zero(content, kSubject);
  if (!read) {
    require(!read.error().message.empty(), "no reason");
    require(read.error().message.find('\n') == std::string::npos, "more than one line");
    return;
  }
  if (!*read) return;
  const auto& [zero, luminance] = **read;
  require(std::abs(zero.place.u) < kSubject.width, "a place beside the picture");
  require(std::abs(zero.place.v) < kSubject.height, "a place beside the picture");
  require(std::isfinite(zero.place.growth) && std::isfinite(zero.place.roll), "no number");
  require(zero.sigma >= 0, "an impossible sigma");
  require(luminance.cols == kSubject.width && luminance.rows == kSubject.height &&
              luminance.type() == CV_16U,
          "another picture");
}

/// The same content behind a right beginning: see kept_zero.cpp.
std::string sealed(std::string content) {
  constexpr std::size_t kChecked = 16;
  const std::uint32_t version = 1, alignment = kSubject.alignment;
  if (content.size() < kChecked + sizeof alignment) return content;
  std::memcpy(content.data(), "orbdrift", 8);
  std::memcpy(content.data() + 8, &version, sizeof version);
  std::memcpy(content.data() + kChecked, &alignment, sizeof alignment);
  const auto checksum = static_cast<std::uint32_t>(crc32_z(
      0, reinterpret_cast<const Bytef*>(content.data() + kChecked), content.size() - kChecked));
  std::memcpy(content.data() + 12, &checksum, sizeof checksum);
  return content;
}

}  // namespace
}  // namespace orbwatch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string content(reinterpret_cast<const char*>(data), size);
  orbwatch::fuzz::try_zero(content);
  orbwatch::fuzz::try_zero(orbwatch::fuzz::sealed(content));
  return 0;
}
