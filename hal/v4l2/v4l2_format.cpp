#include "hal/v4l2/v4l2_format.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace orbwatch::hal {
namespace {

/// Drivers count time in whole ticks, so 30 frames per second may be 29.97.
constexpr double kRateTolerance = 0.98;

/// "YUYV 640x480, 1280x720; MJPG 1920x1080; not read: H264": sizes only where they can be used.
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
  if (offers.empty()) offers = "no format that is read";
  return others.empty() ? offers : offers + "; not read: " + others;
}

/// Whether the driver's answer can be used at all, whatever it was asked.
bool is_usable(const DriverFormat& got, const PixelCoding& coding, bool colour) {
  const auto side = std::max(got.width, got.height);
  if (got.fourcc != coding.fourcc || got.field != V4L2_FIELD_NONE || side > kMaxSide) return false;
  if (got.memory_count != coding.memory_count) return false;
  // Samples of 16 bit are read where they lie.
  const auto sample_bytes = static_cast<std::uint32_t>(info(coding.format).bytes_per_sample());
  if (coding.packing == Packing::None && got.memory[0].stride % sample_bytes != 0) return false;
  return is_whole(coding, colour, static_cast<int>(got.width), static_cast<int>(got.height));
}

ColourSpace colour_space(const PixelCoding& coding, const DriverFormat& format) {
  // JFIF's; what drivers say of the YCbCr inside a JPEG picture is often of no use.
  if (coding.packing == Packing::Jpeg) return {ColourMatrix::Bt601, ColourRange::Full};
  return colour_space_of(format);
}

/// What the driver made of one candidate; nothing when that is of no use here.
DeviceResult<std::optional<V4l2Agreement>> try_format(V4l2Device& device, const PixelCoding& coding,
                                                      const FormatWish& wish) {
  const auto current = device.format();
  if (!current) return tl::unexpected(current.error());
  const StreamRequest& request = wish.stream;
  DriverFormat ask;
  ask.width = request.width != 0 ? static_cast<std::uint32_t>(request.width) : current->width;
  ask.height = request.height != 0 ? static_cast<std::uint32_t>(request.height) : current->height;
  ask.fourcc = coding.fourcc;
  ask.field = V4L2_FIELD_NONE;
  const auto got = device.set_format(ask);
  if (!got) return tl::unexpected(got.error());
  if (!is_usable(*got, coding, wish.colour) || (request.width != 0 && got->width != ask.width) ||
      (request.height != 0 && got->height != ask.height)) {
    return std::nullopt;
  }
  const auto rate = device.set_frame_rate(request.frame_rate);
  if (!rate) return tl::unexpected(rate.error());
  return V4l2Agreement{coding,
                       driver_layout(coding, *got),
                       {frame_format(coding, wish.colour), colour_space(coding, *got),
                        static_cast<int>(got->width), static_cast<int>(got->height), *rate}};
}

std::vector<PixelCoding> candidates(const V4l2Device& device, std::string_view wanted) {
  const auto offered = device.formats();
  std::vector<PixelCoding> found;
  for (const PixelCoding& coding : kPixelCodings) {
    const bool is_wanted = wanted == "auto" || wanted == coding.name;
    const bool has = std::find(offered.begin(), offered.end(), coding.fourcc) != offered.end();
    if (is_wanted && has) found.push_back(coding);
  }
  return found;
}

FaultReport refusal(const V4l2Device& device, const FormatWish& wish) {
  std::string asked(wish.pixel_format);
  const auto side = [](int pixels) { return pixels == 0 ? "any" : std::to_string(pixels); };
  if (wish.stream.width != 0 || wish.stream.height != 0) {
    asked += " " + side(wish.stream.width) + "x" + side(wish.stream.height);
  }
  return {Fault::WrongFormat, device.path() + ": cannot deliver " + asked +
                                  " as whole progressive pictures; it offers " + offers_of(device)};
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

DeviceResult<V4l2Agreement> agree_on_format(V4l2Device& device, const FormatWish& wish) {
  std::optional<PixelCoding> slower;
  for (const PixelCoding& coding : candidates(device, wish.pixel_format)) {
    const auto agreement = try_format(device, coding, wish);
    if (!agreement) return tl::unexpected(agreement.error());
    if (!*agreement) continue;
    const double rate = (*agreement)->stream.frame_rate;
    if (rate == 0 || rate >= wish.stream.frame_rate * kRateTolerance) return **agreement;
    if (!slower) slower = coding;
  }
  if (slower) {
    const auto agreement = try_format(device, *slower, wish);
    if (!agreement) return tl::unexpected(agreement.error());
    if (*agreement) return **agreement;
  }
  return tl::unexpected(refusal(device, wish));
}

}  // namespace orbwatch::hal
