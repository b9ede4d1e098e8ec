// SPDX-License-Identifier: Apache-2.0
#include "hal/replay/exif_orientation.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>

namespace orbwatch::hal {
namespace {

using Bytes = std::span<const std::byte>;

constexpr int kUpright = 1;

unsigned byte_at(Bytes data, std::size_t at) { return std::to_integer<unsigned>(data[at]); }

/// An unsigned number of `size` bytes; nullopt beyond the end.
std::optional<std::uint32_t> number_at(Bytes data, std::size_t at, std::size_t size,
                                       bool big_endian) {
  if (at > data.size() || data.size() - at < size) return std::nullopt;
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < size; ++i) {
    number = number << 8 | byte_at(data, at + (big_endian ? i : size - 1 - i));
  }
  return number;
}

bool begins_with(Bytes data, std::string_view text) {
  return data.size() >= text.size() &&
         std::ranges::equal(data.first(text.size()), text, {}, {},
                            [](char c) { return static_cast<std::byte>(c); });
}

/// The orientation of a TIFF file's first directory, as it is written there.
std::optional<std::uint32_t> stated_orientation(Bytes tiff) {
  constexpr std::uint32_t kOrientation = 0x0112, kShort = 3;
  constexpr std::size_t kEntryBytes = 12;
  const bool big_endian = begins_with(tiff, "MM");
  if (!big_endian && !begins_with(tiff, "II")) return std::nullopt;
  const auto directory = number_at(tiff, 4, 4, big_endian);
  if (!directory) return std::nullopt;
  const auto count = number_at(tiff, *directory, 2, big_endian);
  for (std::size_t n = 0; n < count.value_or(0); ++n) {
    const std::size_t entry = *directory + 2 + n * kEntryBytes;
    if (number_at(tiff, entry, 2, big_endian) != kOrientation) continue;
    if (number_at(tiff, entry + 2, 2, big_endian) != kShort) return std::nullopt;
    return number_at(tiff, entry + 8, 2, big_endian);
  }
  return std::nullopt;
}

struct Segment {
  unsigned marker = 0;
  Bytes content;
};

/// The next segment before the start of scan; removes it from `rest`. nullopt: there is none, or
/// the data is not a JPEG picture.
std::optional<Segment> take_segment(Bytes& rest) {
  constexpr unsigned kStartOfScan = 0xda, kEnd = 0xd9;
  if (rest.empty() || byte_at(rest, 0) != 0xff) return std::nullopt;
  std::size_t at = 1;
  while (at < rest.size() && byte_at(rest, at) == 0xff) ++at;  // fill bytes
  const auto length = number_at(rest, at + 1, 2, true);
  if (!length || *length < 2 || *length > rest.size() - at - 1) return std::nullopt;
  const Segment segment{byte_at(rest, at), rest.subspan(at + 3, *length - 2)};
  rest = rest.subspan(at + 1 + *length);
  if (segment.marker == kStartOfScan || segment.marker == kEnd) return std::nullopt;
  return segment;
}

}  // namespace

int exif_orientation(std::span<const std::byte> jpeg) {
  constexpr unsigned kApp1 = 0xe1;
  constexpr std::string_view kExif("Exif\0", 5);
  constexpr std::size_t kExifBytes = 6;  // includes a byte of padding, which may have any value
  if (!begins_with(jpeg, "\xff\xd8")) return kUpright;
  Bytes rest = jpeg.subspan(2);
  while (const auto segment = take_segment(rest)) {
    if (segment->marker != kApp1 || !begins_with(segment->content, kExif)) continue;
    if (segment->content.size() < kExifBytes) return kUpright;
    return tiff_orientation(segment->content.subspan(kExifBytes));
  }
  return kUpright;
}

int tiff_orientation(std::span<const std::byte> tiff) {
  const auto stated = stated_orientation(tiff);
  return stated && *stated >= 1 && *stated <= 8 ? static_cast<int>(*stated) : kUpright;
}

}  // namespace orbwatch::hal
