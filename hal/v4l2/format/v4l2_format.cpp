// SPDX-License-Identifier: Apache-2.0
#include "hal/v4l2/format/v4l2_format.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace orbwatch::hal {
namespace {

/// Drivers count time in integer ticks: 30 frames per second may be 29.97.
constexpr double kRateTolerance = 0.98;

/// Text such as "YUYV 640x480, 1280x720; MJPG 1920x1080; not supported: H264".
std::string offers_of(const V4l2Device& device) {
  std::string offers;
  std::string others;
  for (const std::uint32_t fourcc : device.formats()) {
    const bool is_read = find_coding(fourcc) != nullptr;
    std::string& text = is_read ? offers : others;
    text += (text.empty() ? "" : "; ") + fourcc_text(fourcc);
    if (!is_read) continue;
    std::string_view separator = " ";
    for (const FrameSizeOffer& size : device.sizes(fourcc)) {
      text.append(separator).append(size_text(size));
      separator = ", ";
    }
  }
  if (offers.empty()) offers = "no supported format";
  return others.empty() ? offers : offers + "; not supported: " + others;
}

/// True if the driver's answer is usable, regardless of the request.
bool is_usable(const DriverFormat& got, const PixelCoding& coding, bool colour) {
  const auto side = std::max(got.width, got.height);
  if (got.fourcc != coding.fourcc || got.field != V4L2_FIELD_NONE || side > kMaxSide) return false;
  if (got.memory_count != coding.memory_count) return false;
  // Samples of 16 bit are read in place and must be aligned.
  const auto sample_bytes = static_cast<std::uint32_t>(info(coding.format).bytes_per_sample());
  if (coding.packing == Packing::None && got.memory[0].stride % sample_bytes != 0) return false;
  return is_whole(coding, colour, static_cast<int>(got.width), static_cast<int>(got.height));
}

ColourSpace colour_space(const PixelCoding& coding, const DriverFormat& format) {
  // JFIF's colour space; drivers often declare a wrong one for JPEG pictures.
  if (coding.packing == Packing::Jpeg) return {ColourMatrix::Bt601, ColourRange::Full};
  return colour_space_of(format);
}

/// Crops the picture out of the device's frames. False: it does not lie within them, or shares
/// pixel groups with the cropped part.
bool cut(NegotiatedFormat& format, const FormatRequest& wanted) {
  if (wanted.frame_height == 0) return true;
  const int first = wanted.first_row;
  const int height = wanted.stream.height != 0 ? wanted.stream.height : wanted.frame_height - first;
  const PixelCoding& coding = format.coding;
  const auto is_whole_to = [&](int row) {
    return is_whole(coding, wanted.colour, format.stream.width, row);
  };
  if (coding.packing == Packing::Jpeg || height > wanted.frame_height - first) return false;
  if (!is_whole_to(height) || (first != 0 && !is_whole_to(first))) return false;
  const PixelFormatInfo& facts = info(coding.format);
  for (std::size_t n = 0; n < format.layout.plane_count; ++n) {
    DriverLayout::Plane& plane = format.layout.planes[n];
    plane.offset += plane.stride * static_cast<std::size_t>(first >> facts.planes[n].shift_y);
  }
  format.stream.height = height;
  return true;
}

/// The driver's answer to one candidate; nullopt when it is not usable.
DeviceResult<std::optional<NegotiatedFormat>> try_format(V4l2Device& device,
                                                         const PixelCoding& coding,
                                                         const FormatRequest& wanted) {
  const auto current = device.format();
  if (!current) return tl::unexpected(current.error());
  StreamRequest request = wanted.stream;
  if (wanted.frame_height != 0) request.height = wanted.frame_height;
  DriverFormat ask;
  ask.width = request.width != 0 ? static_cast<std::uint32_t>(request.width) : current->width;
  ask.height = request.height != 0 ? static_cast<std::uint32_t>(request.height) : current->height;
  ask.fourcc = coding.fourcc;
  ask.field = V4L2_FIELD_NONE;
  const auto got = device.set_format(ask);
  if (!got) return tl::unexpected(got.error());
  if (!is_usable(*got, coding, wanted.colour) || (request.width != 0 && got->width != ask.width) ||
      (request.height != 0 && got->height != ask.height)) {
    return std::nullopt;
  }
  const auto rate = device.set_frame_rate(request.frame_rate);
  if (!rate) return tl::unexpected(rate.error());
  NegotiatedFormat format{coding,
                          driver_layout(coding, *got),
                          {frame_format(coding, wanted.colour), colour_space(coding, *got),
                           static_cast<int>(got->width), static_cast<int>(got->height), *rate}};
  if (!cut(format, wanted)) return std::nullopt;
  return format;
}

bool offers(const V4l2Device& device, std::uint32_t fourcc) {
  const auto offered = device.formats();
  return std::ranges::find(offered, fourcc) != offered.end();
}

std::vector<PixelCoding> candidates(const V4l2Device& device, const FormatRequest& wanted) {
  std::vector<PixelCoding> found;
  for (const PixelCoding& coding : kPixelCodings) {
    const bool is_wanted = wanted.pixel_format == "auto" || wanted.pixel_format == coding.name;
    if (is_wanted && offers(device, coding.fourcc)) found.push_back(coding);
  }
  if (found.empty() && wanted.is_radiometric && wanted.pixel_format == kWordsAsYuyv.name &&
      offers(device, kWordsAsYuyv.fourcc)) {
    found.push_back(kWordsAsYuyv);
  }
  return found;
}

/// Advice if a thermal camera's frames differ from their declared format.
std::string advice(const V4l2Device& device, const FormatRequest& wanted) {
  std::string text;
  if (wanted.pixel_format == kWordsAsYuyv.name && !wanted.is_radiometric &&
      offers(device, kWordsAsYuyv.fourcc)) {
    text += "; 16 bit words that a thermal camera calls YUYV are read with kelvin_per_count";
  }
  const StreamRequest& picture = wanted.stream;
  if (wanted.frame_height != 0 || picture.height == 0) return text;
  for (const std::uint32_t fourcc : device.formats()) {
    const PixelCoding* const coding = find_coding(fourcc);
    if (!coding || coding->packing == Packing::Jpeg) continue;
    for (const FrameSizeOffer& size : device.sizes(fourcc)) {
      const bool is_higher = size.min_width == static_cast<std::uint32_t>(picture.width) &&
                             size.min_height == size.max_height &&
                             size.min_height > static_cast<std::uint32_t>(picture.height);
      if (is_higher) {
        return text + "; frame_height and first_row cut a picture out of higher frames";
      }
    }
  }
  return text;
}

FaultReport refusal(const V4l2Device& device, const FormatRequest& wanted) {
  std::string asked(wanted.pixel_format);
  const auto side = [](int pixels) { return pixels == 0 ? "any" : std::to_string(pixels); };
  if (wanted.stream.width != 0 || wanted.stream.height != 0) {
    asked += " " + side(wanted.stream.width) + "x" + side(wanted.stream.height);
  }
  if (wanted.frame_height != 0) {
    asked += " from row " + std::to_string(wanted.first_row) + " of " +
             std::to_string(wanted.frame_height);
  }
  return {Fault::WrongFormat, device.path() + ": cannot deliver " + asked +
                                  " as whole progressive pictures; it offers " + offers_of(device) +
                                  advice(device, wanted)};
}

}  // namespace

std::string fourcc_text(std::uint32_t fourcc) {
  std::string text;
  for (int shift = 0; shift < 32; shift += 8) {
    const char c = static_cast<char>((fourcc >> shift) & 0x7fU);
    text += c >= ' ' && c != 0x7f ? c : '?';
  }
  text.erase(text.find_last_not_of(' ') + 1);
  constexpr std::uint32_t kBigEndian = 1U << 31;
  return (fourcc & kBigEndian) != 0 ? text + "-BE" : text;
}

std::string size_text(const FrameSizeOffer& size) {
  const std::string least = std::to_string(size.min_width) + "x" + std::to_string(size.min_height);
  const std::string most = std::to_string(size.max_width) + "x" + std::to_string(size.max_height);
  return least == most ? least : least + ".." + most;
}

DeviceResult<NegotiatedFormat> negotiate_format(V4l2Device& device, const FormatRequest& wanted) {
  std::optional<PixelCoding> slower;
  for (const PixelCoding& coding : candidates(device, wanted)) {
    const auto negotiated = try_format(device, coding, wanted);
    if (!negotiated) return tl::unexpected(negotiated.error());
    if (!*negotiated) continue;
    const double rate = (*negotiated)->stream.frame_rate;
    if (rate == 0 || rate >= wanted.stream.frame_rate * kRateTolerance) return **negotiated;
    if (!slower) slower = coding;
  }
  if (slower) {
    const auto negotiated = try_format(device, *slower, wanted);
    if (!negotiated) return tl::unexpected(negotiated.error());
    if (*negotiated) return **negotiated;
  }
  return tl::unexpected(refusal(device, wanted));
}

}  // namespace orbwatch::hal
