#include "hal/v4l2/v4l2_format.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace orbwatch::hal {
namespace {

/// Drivers count time in whole ticks, so 30 frames per second may be 29.97.
constexpr double kRateTolerance = 0.98;

std::string fourcc_text(std::uint32_t code) {
  std::string text;
  for (int shift = 0; shift < 32; shift += 8) {
    const char c = static_cast<char>((code >> shift) & 0x7fU);
    text += c >= ' ' && c != 0x7f ? c : '?';
  }
  return text;
}

bool is_read(std::uint32_t fourcc) {
  return std::any_of(kV4l2Formats.begin(), kV4l2Formats.end(),
                     [fourcc](const V4l2Format& format) { return format.fourcc == fourcc; });
}

/// "YUYV 640x480, 1280x720; MJPG 1920x1080; not read: H264": sizes only where they can be used.
std::string offers_of(const V4l2Device& device) {
  std::string offers;
  std::string others;
  for (const std::uint32_t fourcc : device.formats()) {
    std::string& text = is_read(fourcc) ? offers : others;
    text += (text.empty() ? "" : "; ") + fourcc_text(fourcc);
    if (!is_read(fourcc)) continue;
    std::string_view separator = " ";
    for (const std::string& size : device.sizes(fourcc)) {
      text.append(separator).append(size);
      separator = ", ";
    }
  }
  if (offers.empty()) offers = "no format that is read";
  return others.empty() ? offers : offers + "; not read: " + others;
}

bool has_sound_size(const v4l2_pix_format& format) {
  const auto [shorter, longer] = std::minmax(format.width, format.height);
  const bool whole_pairs = format.pixelformat != V4L2_PIX_FMT_YUYV || format.width % 2 == 0;
  return shorter > 0 && longer <= kMaxV4l2Side && whole_pairs;
}

/// What the driver made of one candidate; nothing when that is of no use here.
DeviceResult<std::optional<V4l2Agreement>> try_format(V4l2Device& device, const V4l2Format& pixels,
                                                      const StreamRequest& request) {
  const auto current = device.format();
  if (!current) return tl::unexpected(current.error());
  v4l2_pix_format ask{};
  ask.width = request.width != 0 ? static_cast<std::uint32_t>(request.width) : current->width;
  ask.height = request.height != 0 ? static_cast<std::uint32_t>(request.height) : current->height;
  ask.pixelformat = pixels.fourcc;
  ask.field = V4L2_FIELD_NONE;
  const auto got = device.set_format(ask);
  if (!got) return tl::unexpected(got.error());
  if (got->pixelformat != pixels.fourcc || got->field != V4L2_FIELD_NONE || !has_sound_size(*got) ||
      (request.width != 0 && got->width != ask.width) ||
      (request.height != 0 && got->height != ask.height)) {
    return std::nullopt;
  }
  const auto rate = device.set_frame_rate(request.frame_rate);
  if (!rate) return tl::unexpected(rate.error());
  V4l2Agreement agreement;
  agreement.pixels = pixels;
  // MJPEG becomes R G B here, and what the driver says of the YCbCr inside is then of no use.
  const ColourSpace colours = pixels.format == PixelFormat::Rgb
                                  ? ColourSpace{ColourMatrix::Bt601, ColourRange::Full}
                                  : colour_space_of(*got);
  agreement.stream = {pixels.format, colours, static_cast<int>(got->width),
                      static_cast<int>(got->height), *rate};
  const auto packed = static_cast<std::size_t>(row_bytes(pixels.format, agreement.stream.width));
  agreement.stride = std::max<std::size_t>(got->bytesperline, packed);
  return agreement;
}

std::vector<V4l2Format> candidates(const V4l2Device& device, std::string_view preference) {
  const auto offered = device.formats();
  std::vector<V4l2Format> found;
  for (const V4l2Format& format : kV4l2Formats) {
    const bool wanted = preference == "auto" || preference == format.name;
    const bool has = std::find(offered.begin(), offered.end(), format.fourcc) != offered.end();
    if (wanted && has) found.push_back(format);
  }
  return found;
}

}  // namespace

ColourSpace colour_space_of(const v4l2_pix_format& format) {
  std::uint32_t encoding = format.ycbcr_enc;
  if (encoding == V4L2_YCBCR_ENC_DEFAULT) {
    encoding = V4L2_MAP_YCBCR_ENC_DEFAULT(format.colorspace);
  }
  std::uint32_t range = format.quantization;
  if (range == V4L2_QUANTIZATION_DEFAULT) {
    range = format.colorspace == V4L2_COLORSPACE_JPEG ? V4L2_QUANTIZATION_FULL_RANGE
                                                      : V4L2_QUANTIZATION_LIM_RANGE;
  }
  const bool bt601 = encoding == V4L2_YCBCR_ENC_601 || encoding == V4L2_YCBCR_ENC_XV601;
  return {bt601 ? ColourMatrix::Bt601 : ColourMatrix::Bt709,
          range == V4L2_QUANTIZATION_FULL_RANGE ? ColourRange::Full : ColourRange::Limited};
}

DeviceResult<V4l2Agreement> agree_on_format(V4l2Device& device, std::string_view preference,
                                            const StreamRequest& request) {
  std::optional<V4l2Format> slower;
  for (const V4l2Format& pixels : candidates(device, preference)) {
    const auto agreement = try_format(device, pixels, request);
    if (!agreement) return tl::unexpected(agreement.error());
    if (!*agreement) continue;
    const double rate = (*agreement)->stream.frame_rate;
    if (rate == 0 || rate >= request.frame_rate * kRateTolerance) return **agreement;
    if (!slower) slower = pixels;
  }
  if (slower) {
    const auto agreement = try_format(device, *slower, request);
    if (!agreement) return tl::unexpected(agreement.error());
    if (*agreement) return **agreement;
  }
  std::string asked(preference);
  if (request.width != 0 || request.height != 0) {
    asked += " " + std::to_string(request.width) + "x" + std::to_string(request.height);
  }
  return tl::unexpected(FaultReport{
      Fault::WrongFormat, device.path() + ": cannot deliver " + asked +
                              " as whole progressive pictures; it offers " + offers_of(device)});
}

}  // namespace orbwatch::hal
