// SPDX-License-Identifier: Apache-2.0
#include "hal/genicam/format/unpack.h"

#include <bit>
#include <cstring>

namespace orbwatch::hal {
namespace {

// Layouts: PFNC 2.4, "lsb packed" and "Packed" (GigE Vision 1.x).

constexpr std::uint64_t byte(std::byte value) { return std::to_integer<std::uint64_t>(value); }

/// Reads a stream of bits, lowest first: groups of `samples` in `bytes`.
template <int kBits, int kSamples, int kBytes, class Put>
void read_bits(const std::byte* row, int width, const Put& put) {
  static_assert(kBits * kSamples == 8 * kBytes);
  for (int x = 0; x < width; x += kSamples, row += kBytes) {
    std::uint64_t group = 0;
    for (int i = 0; i < kBytes; ++i) group |= byte(row[i]) << 8 * i;
    for (int i = 0; i < kSamples; ++i) {
      put(x + i, static_cast<std::uint16_t>(group >> kBits * i & ((1U << kBits) - 1)));
    }
  }
}

/// Reads pairs in 3 bytes: the upper 8 bits at the outside, the lower ones in both halves of the
/// middle.
template <int kBits, class Put>
void read_pairs(const std::byte* row, int width, const Put& put) {
  constexpr int kLow = kBits - 8;
  constexpr std::uint64_t kMask = (1U << kLow) - 1;
  for (int x = 0; x < width; x += 2, row += 3) {
    const std::uint64_t low = byte(row[1]);
    put(x, static_cast<std::uint16_t>(byte(row[0]) << kLow | (low & kMask)));
    put(x + 1, static_cast<std::uint16_t>(byte(row[2]) << kLow | (low >> 4 & kMask)));
  }
}

template <class Put>
void read_words(const std::byte* row, int width, const Put& put) {
  for (int x = 0; x < width; ++x) {
    std::uint16_t sample;  // samples of GigE Vision and USB3 Vision are little-endian
    std::memcpy(&sample, row + std::ptrdiff_t{2} * x, sizeof(sample));
    put(x, sample);
  }
}
static_assert(std::endian::native == std::endian::little);

/// Calls `put(x, sample)` for each sample of a row.
template <class Put>
void read_samples(SamplePacking packing, const std::byte* row, int width, const Put& put) {
  switch (packing) {
    case SamplePacking::None:
      return read_words(row, width, put);
    case SamplePacking::Lsb10:
      return read_bits<10, 4, 5>(row, width, put);
    case SamplePacking::Lsb12:
      return read_bits<12, 2, 3>(row, width, put);
    case SamplePacking::Lsb14:
      return read_bits<14, 4, 7>(row, width, put);
    case SamplePacking::Gev10:
      return read_pairs<10>(row, width, put);
    case SamplePacking::Gev12:
      return read_pairs<12>(row, width, put);
  }
}

}  // namespace

void unpack_samples(SamplePacking packing, const std::byte* row, int width,
                    std::uint16_t* samples) {
  read_samples(packing, row, width,
               [samples](int x, std::uint16_t sample) { samples[x] = sample; });
}

void unpack_upper_bits(const GenicamFormat& format, const std::byte* row, int width,
                       std::uint8_t* samples) {
  const int bits = info(format.format).bits;
  if (bits == 8) {
    std::memcpy(samples, row, static_cast<std::size_t>(width));
    return;
  }
  read_samples(format.packing, row, width, [samples, bits](int x, std::uint16_t sample) {
    samples[x] = static_cast<std::uint8_t>(sample >> (bits - 8));
  });
}

}  // namespace orbwatch::hal
