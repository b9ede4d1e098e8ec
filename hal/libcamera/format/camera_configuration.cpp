// SPDX-License-Identifier: Apache-2.0
#include "hal/libcamera/format/camera_configuration.h"

#include <libcamera/control_ids.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <system_error>
#include <vector>

namespace orbwatch::hal {
namespace {

namespace controls = libcamera::controls;
using libcamera::CameraConfiguration;

constexpr double kMicroseconds = 1e6;

std::string to_text(const libcamera::StreamConfiguration& stream) {
  return stream.pixelFormat.toString() + " " + stream.size.toString();
}

/// Text such as "NV12 32x32..3280x2464; not supported: SRGGB10".
std::string offers_of(const libcamera::StreamConfiguration& stream) {
  std::string offers;
  std::string others;
  for (const auto& code : stream.formats().pixelformats()) {
    std::string& text = find_format(code) != nullptr ? offers : others;
    text += (text.empty() ? "" : "; ") + code.toString();
    if (find_format(code) == nullptr) continue;
    const libcamera::SizeRange range = stream.formats().range(code);
    text += " " + range.min.toString() +
            (range.min == range.max ? std::string() : ".." + range.max.toString());
  }
  if (offers.empty()) offers = "no supported format";
  return others.empty() ? offers : offers + "; not supported: " + others;
}

bool has_sound_size(const libcamera::StreamConfiguration& stream, PixelFormat format) {
  const auto [shorter, longer] = std::minmax(stream.size.width, stream.size.height);
  if (shorter == 0 || longer > static_cast<unsigned>(kMaxSide)) return false;
  const bool pairs_of_columns = info(format).colour == ColourModel::Yuv;
  const bool pairs_of_rows = info(format).planes[1].shift_y != 0;
  return !(pairs_of_columns && stream.size.width % 2 != 0) &&
         !(pairs_of_rows && stream.size.height % 2 != 0);
}

/// Requests one pixel format; returns the validated configuration.
Result<NegotiatedConfiguration> validate(libcamera::Camera& camera, const LibcameraFormat& pixels,
                                         const SensorMode& mode, const StreamRequest& request) {
  auto begun = begin_configuration(camera, mode);
  if (!begun) return tl::unexpected(begun.error());
  NegotiatedConfiguration negotiated;
  negotiated.configuration = std::move(*begun);
  negotiated.pixels = &pixels;
  negotiated.requested_buffers = request.buffers;
  libcamera::StreamConfiguration& stream = negotiated.configuration->at(0);
  stream.pixelFormat = pixels.code;
  if (request.width != 0) stream.size.width = static_cast<unsigned>(request.width);
  if (request.height != 0) stream.size.height = static_cast<unsigned>(request.height);
  stream.bufferCount = static_cast<unsigned>(request.buffers);
  libcamera::StreamConfiguration asked = stream;
  if (negotiated.configuration->validate() == CameraConfiguration::Invalid) {
    return fail("refuses " + to_text(asked) + (mode.is_set() ? " from " + to_text(mode) : ""));
  }
  if (!colour_space_of(stream.colorSpace, pixels.format)) {
    stream.colorSpace = libcamera::ColorSpace::Rec709;
    if (negotiated.configuration->validate() == CameraConfiguration::Invalid) {
      return fail("refuses " + to_text(asked) + " with colours of BT.709");
    }
  }
  if (request.width == 0) asked.size.width = stream.size.width;
  if (request.height == 0) asked.size.height = stream.size.height;
  if (const auto other = difference(asked, stream)) return fail(*other);
  if (!has_sensor_mode(*negotiated.configuration, mode)) {
    return fail("would not read its sensor out as " + to_text(mode));
  }
  return negotiated;
}

/// Settable rate nearest to `wanted`; 0 if the camera has no such control or `wanted` is 0.
double possible_rate(const libcamera::ControlInfoMap& offered, double wanted) {
  const auto limits = offered.find(controls::FrameDurationLimits.id());
  if (limits == offered.end() || wanted == 0) return 0;
  const libcamera::ControlValue& least = limits->second.min();
  const libcamera::ControlValue& most = limits->second.max();
  const auto is_duration = [](const libcamera::ControlValue& value) {
    return value.type() == libcamera::ControlTypeInteger64 && !value.isArray();
  };
  double duration = kMicroseconds / wanted;
  if (is_duration(most)) {
    duration = std::min(duration, static_cast<double>(most.get<std::int64_t>()));
  }
  if (is_duration(least)) {
    duration = std::max(duration, static_cast<double>(least.get<std::int64_t>()));
  }
  return duration > 0 ? kMicroseconds / duration : 0;
}

Result<NegotiatedConfiguration> configure(libcamera::Camera& camera,
                                          NegotiatedConfiguration negotiated, double frame_rate) {
  const PixelFormat format = negotiated.pixels->format;
  const libcamera::StreamConfiguration& stream = negotiated.picture();
  const auto colours = colour_space_of(stream.colorSpace, format);
  if (!colours) return fail(to_text(stream) + " has colours of BT.2020, which are not supported");
  if (!has_sound_size(stream, format)) return fail(to_text(stream) + " is not a supported size");
  if (const int error = camera.configure(negotiated.configuration.get()); error < 0) {
    return fail("cannot be configured as " + to_text(stream) + ": " +
                std::generic_category().message(-error));
  }
  const auto width = static_cast<int>(stream.size.width);
  const std::size_t packed = static_cast<std::size_t>(row_bytes(format, width));
  negotiated.stride = stream.stride != 0 ? stream.stride : packed;
  if (negotiated.stride < packed) {
    return fail(to_text(stream) + " has rows of " + std::to_string(stream.stride) +
                " bytes; they take " + std::to_string(packed));
  }
  negotiated.stream = {format, *colours, width, static_cast<int>(stream.size.height),
                       possible_rate(camera.controls(), frame_rate)};
  return negotiated;
}

}  // namespace

std::string to_text(const SensorMode& mode) {
  return std::to_string(mode.width) + "x" + std::to_string(mode.height) + " " +
         std::to_string(mode.bit_depth) + " bit";
}

int raw_bit_depth(libcamera::PixelFormat format) {
  // Names such as SRGGB10, SBGGR12_CSI2P, R10: a Bayer order or R for grey, then the depth.
  const std::string name = format.toString();
  std::size_t at = 0;
  if (name.size() > 5 && name[0] == 'S' && name.find_first_not_of("RGB", 1) == 5) {
    at = 5;
  } else if (!name.empty() && name[0] == 'R') {
    at = 1;
  }
  int depth = 0;
  if (at == 0) return depth;
  for (; at < name.size() && std::isdigit(static_cast<unsigned char>(name[at])) != 0; ++at) {
    depth = 10 * depth + (name[at] - '0');
  }
  return at == name.size() || name[at] == '_' ? depth : 0;
}

std::string sensor_modes_of(libcamera::Camera& camera) {
  const auto raw = camera.generateConfiguration({libcamera::StreamRole::Raw});
  std::string modes;
  if (!raw || raw->empty()) return "none";
  for (const auto& format : raw->at(0).formats().pixelformats()) {
    const int depth = raw_bit_depth(format);
    if (depth == 0) continue;
    for (const auto& size : raw->at(0).formats().sizes(format)) {
      const std::string mode =
          to_text({static_cast<int>(size.width), static_cast<int>(size.height), depth});
      // Packed and plain formats share a mode.
      if (modes.find(mode) == std::string::npos) modes += (modes.empty() ? "" : ", ") + mode;
    }
  }
  return modes.empty() ? "none" : modes;
}

DeviceResult<AcquiredCamera> AcquiredCamera::acquire(std::shared_ptr<libcamera::Camera> camera) {
  if (const int error = camera->acquire(); error < 0) {
    const Fault fault = error == -ENODEV ? Fault::Unplugged : Fault::ReadError;
    return fail(fault, camera->id() + ": " + std::generic_category().message(-error));
  }
  return AcquiredCamera(std::move(camera));
}

AcquiredCamera::~AcquiredCamera() {
  if (camera_) camera_->release();
}

std::optional<std::string> difference(const libcamera::StreamConfiguration& asked,
                                      const libcamera::StreamConfiguration& given) {
  if (asked.pixelFormat == given.pixelFormat && asked.size == given.size) return std::nullopt;
  return to_text(asked) + " would become " + to_text(given);
}

Result<NegotiatedConfiguration> negotiate_configuration(libcamera::Camera& camera,
                                                        std::string_view preference,
                                                        const SensorMode& mode,
                                                        const StreamRequest& request) {
  const auto named = [&camera](const std::string& message) {
    return fail(camera.id() + ": " + message);
  };
  const auto begun = begin_configuration(camera, mode);
  if (!begun) return named(begun.error().message);
  const libcamera::StreamConfiguration& offered = (*begun)->at(0);
  const std::vector<libcamera::PixelFormat> codes = offered.formats().pixelformats();
  std::string refusals;
  for (const LibcameraFormat& pixels : kLibcameraFormats) {
    const bool wanted = preference == "auto" || preference == pixels.name;
    // Some pipelines list no formats.
    const bool has = codes.empty() || std::count(codes.begin(), codes.end(), pixels.code) != 0;
    if (!wanted || !has) continue;
    auto negotiated = validate(camera, pixels, mode, request);
    if (negotiated) negotiated = configure(camera, std::move(*negotiated), request.frame_rate);
    if (negotiated) return negotiated;
    refusals += negotiated.error().message + "; ";
  }
  if (refusals.empty()) refusals = "does not offer " + std::string(preference) + "; ";
  const std::string modes = mode.is_set() ? "; sensor modes: " + sensor_modes_of(camera) : "";
  return named(refusals + "it offers " + offers_of(offered) + modes);
}

void put_frame_rate(double frame_rate, libcamera::ControlList& list) {
  if (frame_rate == 0) return;
  const auto duration = static_cast<std::int64_t>(std::llround(kMicroseconds / frame_rate));
  const std::int64_t limits[] = {duration, duration};
  list.set(controls::FrameDurationLimits, libcamera::Span<const std::int64_t, 2>(limits));
}

}  // namespace orbwatch::hal
