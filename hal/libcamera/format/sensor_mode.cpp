#include "hal/libcamera/format/sensor_mode.h"

#include <cctype>
#include <string_view>

namespace orbwatch::hal {

std::string to_text(const SensorMode& mode) {
  return std::to_string(mode.width) + "x" + std::to_string(mode.height) + " " +
         std::to_string(mode.bit_depth) + " bit";
}

int raw_bit_depth(libcamera::PixelFormat format) {
  // SRGGB10, SBGGR12_CSI2P, R10: a Bayer order or R for grey, then the depth.
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
      // Packed and plain formats of the same mode.
      if (modes.find(mode) == std::string::npos) modes += (modes.empty() ? "" : ", ") + mode;
    }
  }
  return modes.empty() ? "none" : modes;
}

}  // namespace orbwatch::hal
