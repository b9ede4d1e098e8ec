#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "hal/v4l2/v4l2_device.h"

namespace orbwatch::hal {

/// A size on offer and the frames per second at it: one by one, or first and last of a range.
struct V4l2SizeInfo {
  FrameSizeOffer size;
  std::vector<double> frame_rates;  ///< empty: the driver does not say; for a range, at its largest
};

struct V4l2FormatInfo {
  std::string fourcc;
  std::string pixel_format;  ///< its name in kPixelCodings; empty: it is not read
  std::vector<V4l2SizeInfo> sizes;
};

struct V4l2ControlInfo {
  std::string name;  ///< as control_variable() writes it
  std::int64_t minimum = 0;
  std::int64_t maximum = 0;
  std::int64_t step = 0;
  std::int64_t default_value = 0;
  bool read_only = false;
  bool inactive = false;                                   ///< an automatism has it
  std::vector<std::pair<std::int64_t, std::string>> menu;  ///< value and text, if it is one
};

/// A V4L2 device that captures pictures.
struct V4l2DeviceInfo {
  std::string path;                       ///< "/dev/video0": may be another after replugging
  std::vector<std::string> stable_paths;  ///< its links in by-id and by-path
  std::string problem;                    ///< why the rest is not known; else empty
  std::string driver;
  std::string card;
  std::string bus;
  std::vector<V4l2FormatInfo> formats;
  std::vector<V4l2ControlInfo> controls;
};

/// What one device says of itself. Disturbs no stream.
V4l2DeviceInfo describe(const V4l2Device& device);

/// All devices in `folder` that capture pictures, in the order of their numbers; those that cannot
/// be opened, too. Reentrant.
std::vector<V4l2DeviceInfo> list_v4l2_devices(const std::filesystem::path& folder = "/dev");

/// The device node that `name` means: a path, which is taken as it is; the name of a link in
/// v4l/by-id or v4l/by-path of `folder`; or a place on a bus as the driver tells it
/// ("usb-0000:00:14.0-1", "platform:vivid-000"). Fault::Unplugged when there is none. Reentrant.
DeviceResult<std::string> find_v4l2_device(const std::string& name,
                                           const std::filesystem::path& folder = "/dev");

}  // namespace orbwatch::hal
