// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "hal/back_end.h"
#include "hal/camera.h"
#include "hal/frame/frame.h"
#include "hal/inventory.h"
#include "proc/image/picture.h"
#include "proc/settings/settings.h"

namespace orbwatch::hal {

/// Selection and settings of a GigE Vision or USB3 Vision camera. Needs no header of Aravis.
struct GenicamSettings {
  static constexpr std::string_view kName = "genicam";
  static constexpr BackEndFacts kFacts{.origin = CameraOrigin::Module, .address_key = "camera"};
  static constexpr int kAutomatic = 0;  ///< automatic packet_size

  /// Serial number, user-defined name, address, or the id that `orbwatch list` shows.
  std::string camera;
  std::string pixel_format = "auto";  ///< "auto" or a name of kGenicamFormats
  bool colour = true;                 ///< see frame_format()
  int binning = 1;                    ///< pixels of the sensor per pixel, in both directions
  int offset_x = 0;                   ///< left edge of the picture on the sensor, binned px
  int offset_y = 0;
  std::string trigger_source = "Software";
  /// Event that the camera's stamps mark, from its data sheet.
  StampSource stamps_mark = StampSource::ExposureStart;
  /// Packet size of GigE Vision, bytes including the IP and UDP headers.
  int packet_size = kAutomatic;

  static GenicamSettings at(std::string address) {
    GenicamSettings settings;
    settings.camera = std::move(address);
    return settings;
  }
  std::string address() const { return camera; }
  /// A camera that orbwatchd controls answers, but cannot be opened: it is accepted.
  bool accepts(const CameraEntry& entry) const {
    return std::ranges::find(entry.paths, camera) != entry.paths.end();
  }
  static std::optional<PixelFormat> stated_format() { return std::nullopt; }
};

inline constexpr std::array kStampMarks{Word{"exposure_start", StampSource::ExposureStart},
                                        Word{"readout_start", StampSource::ReadoutStart},
                                        Word{"frame_end", StampSource::FrameEnd}};

template <class Visitor>
void visit(Visitor& v, GenicamSettings& settings) {
  v.required("camera", settings.camera,
             "Serial number, user-defined name, IP address, or the id that `orbwatch list` shows");
  v.optional("pixel_format", settings.pixel_format,
             "auto, or a GenICam name: Mono16, BayerRG8, ...; Mono14 counts are not rescaled");
  v.optional("colour", settings.colour, "Demosaic to colour; false: the mosaic stays as it is");
  v.optional("binning", settings.binning, Range::between(1, 16),
             "Sensor pixels that are combined into one, in both directions; width and height count "
             "binned pixels");
  v.optional("offset_x", settings.offset_x, Range::between(0, kMaxSide),
             "Left edge of the region read from the sensor, px; only the ball needs to be sent");
  v.optional("offset_y", settings.offset_y, Range::between(0, kMaxSide),
             "Top edge of the region read from the sensor, px");
  v.optional("trigger_source", settings.trigger_source,
             "Trigger source of the camera while its control TriggerMode is 1, by the camera's own "
             "name, such as Software or Line1");
  v.optional(
      "stamps_mark", settings.stamps_mark, kStampMarks,
      "Event that the camera's time stamps mark, from its data sheet; for cameras whose clock can "
      "be read (TimestampLatch). Other cameras are assumed to stamp the start of the readout");
  v.optional("packet_size", settings.packet_size, Range::between(0, 16384),
             "GigE Vision packet size, bytes; 0: the largest that the network carries");
}

std::unique_ptr<Camera> make_camera(const GenicamSettings& settings, const CameraContext& context);

}  // namespace orbwatch::hal
