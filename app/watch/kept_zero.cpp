// SPDX-License-Identifier: Apache-2.0
#include "app/watch/kept_zero.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>
#include <system_error>

#include "hal/atomic_file.h"
#include "hal/regular_file.h"

namespace orbwatch::app {
namespace {

static_assert(std::endian::native == std::endian::little, "a file moves between our targets");

constexpr std::array<char, 8> kZeroMagic{'o', 'r', 'b', 'd', 'r', 'i', 'f', 't'};
constexpr std::uint32_t kZeroVersion = 1;

/// The file's beginning; the pixels follow, deflated.
struct ZeroHeader {
  std::array<char, 8> magic = kZeroMagic;
  std::uint32_t version = kZeroVersion;
  std::uint32_t checksum = 0;  ///< CRC-32 of everything behind this member
  std::uint32_t alignment = 0;
  std::uint32_t format = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::array<double, 4> place{};  ///< u, v, growth, roll
  double sigma = 0;
};
constexpr std::size_t kChecked = offsetof(ZeroHeader, alignment);
static_assert(sizeof(ZeroHeader) == 72, "without padding");

/// Largest growth and roll of a zero; the learning ends with the first jump, long before.
constexpr double kMostTurn = 0.5;

std::uint32_t checksum_of(std::string_view file) {
  const std::string_view checked = file.substr(kChecked);
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(checked.data()), checked.size()));
}

cv::Mat pixels_for(const ZeroSubject& subject) {
  const bool is_wide = info(subject.format).bytes_per_sample() == 2;
  return cv::Mat(subject.height, subject.width, is_wide ? CV_16U : CV_8U);
}

std::size_t bytes_of(const cv::Mat& pixels) { return pixels.total() * pixels.elemSize(); }

/// Finite, and within the picture.
bool is_possible(const align::DriftZero& zero, const ZeroSubject& subject) {
  const auto& [u, v, growth, roll] = zero.place;
  // False for NaN.
  return std::abs(u) < subject.width && std::abs(v) < subject.height &&
         std::abs(growth) < kMostTurn && std::abs(roll) < kMostTurn && zero.sigma >= 0 &&
         zero.sigma < 180;
}

std::string size_text(std::uint32_t width, std::uint32_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

}  // namespace

PixelFormat luminance_format(PixelFormat format) {
  const PixelFormatInfo& facts = info(format);
  if (facts.colour == ColourModel::Luminance) return format;
  return facts.bytes_per_sample() == 2 ? PixelFormat::Y16 : PixelFormat::Grey;
}

Picture luminance_picture(const cv::Mat& luminance, PixelFormat format) {
  return Picture::contiguous(format, luminance.cols, luminance.rows,
                             reinterpret_cast<const std::byte*>(luminance.data),
                             static_cast<std::ptrdiff_t>(luminance.step));
}

std::filesystem::path zero_file(const std::filesystem::path& folder, const std::string& camera) {
  return folder.empty() ? folder : folder / ("drift-zero-" + camera);
}

Result<> keep_zero(const std::filesystem::path& file, const ZeroSubject& subject,
                   const KeptZero& kept) {
  if (file.empty()) return fail("there is no state folder");
  const cv::Mat pixels = kept.luminance.isContinuous() ? kept.luminance : kept.luminance.clone();
  const auto& [u, v, growth, roll] = kept.zero.place;
  ZeroHeader header{.alignment = subject.alignment,
                    .format = static_cast<std::uint32_t>(subject.format),
                    .width = static_cast<std::uint32_t>(subject.width),
                    .height = static_cast<std::uint32_t>(subject.height),
                    .place = {u, v, growth, roll},
                    .sigma = kept.zero.sigma};
  uLongf size = compressBound(bytes_of(pixels));
  std::string content(sizeof header + size, '\0');
  const int done = compress2(reinterpret_cast<Bytef*>(content.data() + sizeof header), &size,
                             pixels.data, bytes_of(pixels), Z_BEST_SPEED);
  if (done != Z_OK) return fail(file.string() + ": cannot be written: out of memory");
  content.resize(sizeof header + size);
  std::memcpy(content.data(), &header, sizeof header);
  header.checksum = checksum_of(content);
  std::memcpy(content.data(), &header, sizeof header);
  std::error_code error;  // write_file() has the reason
  std::filesystem::create_directories(file.parent_path(), error);
  return hal::write_file(file, content, hal::FileAccess::Owner);
}

Result<std::optional<KeptZero>> kept_zero(const std::filesystem::path& file,
                                          const ZeroSubject& subject) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return std::nullopt;
  const std::size_t most = sizeof(ZeroHeader) + compressBound(bytes_of(pixels_for(subject)));
  const auto content = hal::read_regular_file(file, most);
  if (!content) return tl::unexpected(content.error());
  return parsed_zero(*content, subject).map_error([&](const Error& refused) {
    return Error{file.string() + ": " + refused.message};
  });
}

Result<std::optional<KeptZero>> parsed_zero(std::string_view content, const ZeroSubject& subject) {
  ZeroHeader header;
  if (content.size() < sizeof header) return fail("is too short");
  std::memcpy(&header, content.data(), sizeof header);
  if (header.magic != kZeroMagic) return fail("is not a zero of a drift");
  if (header.version != kZeroVersion) {
    return fail("has version " + std::to_string(header.version) + ", not " +
                std::to_string(kZeroVersion));
  }
  if (header.checksum != checksum_of(content)) return fail("is damaged: its checksum is wrong");
  if (header.alignment != subject.alignment) return std::nullopt;
  if (header.width != static_cast<std::uint32_t>(subject.width) ||
      header.height != static_cast<std::uint32_t>(subject.height)) {
    return fail("is for pictures of " + size_text(header.width, header.height) +
                ", the camera's are " +
                size_text(static_cast<std::uint32_t>(subject.width),
                          static_cast<std::uint32_t>(subject.height)));
  }
  if (header.format != static_cast<std::uint32_t>(subject.format)) {
    return fail("is for pictures of another format than " + std::string(info(subject.format).name));
  }
  const auto& [u, v, growth, roll] = header.place;
  KeptZero kept{{{u, v, growth, roll}, header.sigma}, pixels_for(subject)};
  if (!is_possible(kept.zero, subject)) return fail("states an impossible place");
  const std::string_view deflated = content.substr(sizeof header);
  uLongf size = bytes_of(kept.luminance);
  const int done = uncompress(kept.luminance.data, &size,
                              reinterpret_cast<const Bytef*>(deflated.data()), deflated.size());
  if (done != Z_OK || size != bytes_of(kept.luminance)) return fail("its picture is damaged");
  return kept;
}

}  // namespace orbwatch::app
