// SPDX-License-Identifier: Apache-2.0
#include "hal/genicam/format/negotiation.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>

#include "hal/genicam/device/features.h"

namespace orbwatch::hal {
namespace {

/// Negotiates the settings on which the camera and the site must agree.
class Negotiation {
 public:
  Negotiation(ArvCamera* camera, const GenicamSettings& settings)
      : camera_(camera), device_(arv_camera_get_device(camera)), settings_(settings) {}

  DeviceResult<GenicamStreamFormat> run(std::string_view pixel_format,
                                        const StreamRequest& request) {
    GenicamStreamFormat format;
    auto chosen = choose(pixel_format);
    if (!chosen) return tl::unexpected(chosen.error());
    format.pixels = *chosen;
    auto set = set_format(*format.pixels)
                   .and_then([&] { return set_region(request); })
                   .and_then([&] { return set_rate(request.frame_rate); })
                   .and_then([&] { return set_packet_size(); })
                   .and_then([&] { return read(format); });
    if (!set) return tl::unexpected(set.error());
    return format;
  }

 private:
  tl::unexpected<FaultReport> refused(const std::string& reason) const {
    return fail(Fault::WrongFormat, "genicam: camera " + settings_.camera + ": " + reason);
  }
  DeviceResult<> done(const std::string& what, const AravisError& error) const {
    if (!error) return {};
    return refused(what + " cannot be set: " + error.message());
  }

  DeviceResult<const GenicamFormat*> choose(std::string_view wanted) const {
    const auto offered = offered_formats(camera_);
    for (const GenicamFormat& format : kGenicamFormats) {
      const bool is_wanted = wanted == "auto" || wanted == format.name;
      if (is_wanted && std::ranges::find(offered, format.code) != offered.end()) return &format;
    }
    std::string offers;
    for (const std::uint32_t code : offered) {
      offers += (offers.empty() ? "" : ", ") + format_name(code);
    }
    return refused("cannot send " + std::string(wanted) + "; it offers " +
                   (offers.empty() ? "nothing" : offers));
  }

  DeviceResult<> set_format(const GenicamFormat& format) {
    AravisError error;
    arv_camera_set_pixel_format(camera_, format.code, error.out());
    return done("pixel format " + std::string(format.name), error);
  }

  bool has(const char* feature) const {
    return arv_device_is_feature_available(device_, feature, nullptr);
  }

  DeviceResult<> set(const char* feature, int value) {
    const auto done = set_feature(camera_, feature, value, "");
    if (!done) return refused(done.error().message);
    return {};
  }

  /// Sets a feature that the camera has; without the feature, only the value `neutral` is accepted.
  DeviceResult<> set_if_there(const char* feature, int value, int neutral) {
    if (value == neutral && !has(feature)) return {};
    return set(feature, value);
  }

  /// The binning limits the size, and the offset on the sensor limits it too.
  DeviceResult<> set_region(const StreamRequest& request) {
    return set_if_there("BinningHorizontal", settings_.binning, 1)
        .and_then([&] { return set_if_there("BinningVertical", settings_.binning, 1); })
        .and_then([&] { return set_if_there("OffsetX", 0, 0); })
        .and_then([&] { return set_if_there("OffsetY", 0, 0); })
        .and_then([&]() -> DeviceResult<> {
          if (request.width == 0) return {};
          return set("Width", request.width);
        })
        .and_then([&]() -> DeviceResult<> {
          if (request.height == 0) return {};
          return set("Height", request.height);
        })
        .and_then([&] { return set_if_there("OffsetX", settings_.offset_x, 0); })
        .and_then([&] { return set_if_there("OffsetY", settings_.offset_y, 0); });
  }

  DeviceResult<> set_rate(double frame_rate) {
    AravisError error;
    arv_camera_set_acquisition_mode(camera_, ARV_ACQUISITION_MODE_CONTINUOUS, error.out());
    if (auto set = done("AcquisitionMode", error); !set) return set;
    // Cameras with a fixed rate have no such feature.
    const bool has_rate = arv_camera_is_frame_rate_available(camera_, nullptr);
    if (has_rate && frame_rate > 0) {
      arv_camera_set_frame_rate(camera_, frame_rate, error.out());  // clears the triggers as well
      return done("AcquisitionFrameRate", error);
    }
    if (!has_rate && !waits_for_trigger(camera_)) return {};
    arv_camera_clear_triggers(camera_, error.out());
    return done("TriggerMode", error);
  }

  /// Sets the packet size of GigE Vision; determined with the camera's test packets if it can send
  /// them.
  DeviceResult<> set_packet_size() {
    if (!arv_camera_is_gv_device(camera_)) return {};
    arv_camera_gv_set_packet_size_adjustment(camera_, ARV_GV_PACKET_SIZE_ADJUSTMENT_NEVER);
    AravisError error;
    if (settings_.packet_size == GenicamSettings::kAutomatic) {
      arv_camera_gv_auto_packet_size(camera_, error.out());
    } else {
      arv_camera_gv_set_packet_size(camera_, settings_.packet_size, error.out());
    }
    return done("packet_size", error);
  }

  /// Reads back the format that the camera set.
  DeviceResult<> read(GenicamStreamFormat& format) {
    AravisError error;
    int x = 0, y = 0, width = 0, height = 0;
    arv_camera_get_region(camera_, &x, &y, &width, &height, error.out());
    if (error) return refused(error.message());
    format.payload = arv_camera_get_payload(camera_, error.out());
    if (error) return refused(error.message());
    const std::string sends = std::string(format.pixels->name) + " of " + std::to_string(width) +
                              "x" + std::to_string(height) + " pixels";
    if (std::max(width, height) > kMaxSide || !is_whole(*format.pixels, width, height)) {
      return refused("sends " + sends + ", which are not whole groups of pixels");
    }
    const std::size_t needed =
        sent_row_bytes(*format.pixels, width) * static_cast<std::size_t>(height);
    if (format.payload < needed || format.payload > needed + kMostExtra) {
      return refused("states a payload of " + std::to_string(format.payload) + " bytes; " + sends +
                     " take " + std::to_string(needed));
    }
    double rate = 0;
    if (arv_camera_is_frame_rate_available(camera_, nullptr)) {
      rate = arv_camera_get_frame_rate(camera_, error.out());
      if (error || !(rate > 0 && rate <= kMaxFrameRate)) rate = 0;
    }
    format.stream = {frame_format(*format.pixels, settings_.colour), colours_of(*format.pixels),
                     width, height, rate};
    return {};
  }

  /// Colour space of GenICam's YUV422_8 and YCbCr422_8, which use the whole range.
  static ColourSpace colours_of(const GenicamFormat& format) {
    const bool is_yuv = info(format.format).colour == ColourModel::Yuv;
    return is_yuv ? ColourSpace{ColourMatrix::Bt601, ColourRange::Full} : ColourSpace{};
  }

  /// Largest size of chunks and padding behind a picture.
  static constexpr std::size_t kMostExtra = std::size_t{1} << 20;

  ArvCamera* camera_;
  ArvDevice* device_;
  const GenicamSettings& settings_;
};

}  // namespace

DeviceResult<GenicamStreamFormat> negotiate(ArvCamera* camera, const GenicamSettings& settings,
                                            std::string_view pixel_format,
                                            const StreamRequest& request) {
  return Negotiation(camera, settings).run(pixel_format, request);
}

std::vector<std::uint32_t> offered_formats(ArvCamera* camera) {
  guint count = 0;
  const OwnedMemory<gint64> codes(arv_camera_dup_available_pixel_formats(camera, &count, nullptr));
  std::vector<std::uint32_t> offered;
  for (guint i = 0; codes && i < count; ++i) {
    offered.push_back(static_cast<std::uint32_t>(codes.get()[i]));
  }
  return offered;
}

std::string format_name(std::uint32_t code) {
  if (const GenicamFormat* const format = find_genicam_format(code)) {
    return std::string(format->name);
  }
  char text[16];
  std::snprintf(text, sizeof(text), "0x%08x", code);
  return text;
}

}  // namespace orbwatch::hal
