// SPDX-License-Identifier: Apache-2.0
#include "hal/replay/png_check.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <string>

namespace orbwatch::hal {
namespace {

constexpr std::array kSignature{std::byte{0x89}, std::byte{'P'},  std::byte{'N'},  std::byte{'G'},
                                std::byte{'\r'}, std::byte{'\n'}, std::byte{0x1a}, std::byte{'\n'}};

/// CRC of ISO/IEC 15948, annex D.
std::uint32_t crc(std::span<const std::byte> data) {
  const auto* const bytes = reinterpret_cast<const Bytef*>(data.data());
  return static_cast<std::uint32_t>(::crc32(0, bytes, static_cast<uInt>(data.size())));
}

std::uint32_t big_endian(std::span<const std::byte> data, std::size_t offset) {
  std::uint32_t value = 0;
  for (const std::byte byte : data.subspan(offset, 4)) {
    value = (value << 8) | std::to_integer<std::uint32_t>(byte);
  }
  return value;
}

constexpr std::uint32_t chunk_type(const char (&name)[5]) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = (value << 8) | static_cast<unsigned char>(name[i]);
  return value;
}

constexpr std::size_t kFrameOfChunk = 12;  // length, type and sum around the data
constexpr std::size_t kHeaderBytes = 13;

}  // namespace

bool is_png(std::span<const std::byte> file) {
  return file.size() >= kSignature.size() &&
         std::equal(kSignature.begin(), kSignature.end(), file.begin());
}

Result<PngSize> check_png(std::span<const std::byte> file) {
  if (!is_png(file)) return fail("not a PNG picture: wrong signature");
  PngSize size;
  bool pixels = false;
  for (auto rest = file.subspan(kSignature.size());;) {
    if (rest.size() < kFrameOfChunk || big_endian(rest, 0) > rest.size() - kFrameOfChunk) {
      return fail("damaged PNG picture: ends early");
    }
    const std::size_t length = big_endian(rest, 0);
    const std::uint32_t type = big_endian(rest, 4);
    if (crc(rest.subspan(4, length + 4)) != big_endian(rest, length + 8)) {
      return fail("damaged PNG picture: wrong check sum at byte " +
                  std::to_string(file.size() - rest.size()));
    }
    const bool first = size.width == 0;
    if (first != (type == chunk_type("IHDR")) || (first && length != kHeaderBytes)) {
      return fail("damaged PNG picture: does not start with one header");
    }
    if (first) {
      size = {big_endian(rest, 8), big_endian(rest, 12)};
      if (size.width == 0 || size.height == 0) return fail("damaged PNG picture: has no pixels");
    }
    pixels = pixels || type == chunk_type("IDAT");
    if (type == chunk_type("IEND")) break;
    rest = rest.subspan(length + kFrameOfChunk);
  }
  if (!pixels) return fail("damaged PNG picture: has no pixels");
  return size;
}

}  // namespace orbwatch::hal
