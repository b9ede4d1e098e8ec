// SPDX-License-Identifier: Apache-2.0
#include "hal/genicam/device/open_camera.h"

namespace orbwatch::hal {

DeviceResult<OwnedObject<ArvCamera>> open_camera(const FoundCamera& found) {
  const auto failed = [&found](const std::string& reason) {
    return fail(Fault::Unplugged, "genicam: camera " + found.id + ": " + reason);
  };
  AravisError error;
  // A GigE Vision camera is opened by its address, without another search.
  const std::string& where = found.is_gige() ? found.address : found.id;
  const OwnedObject<ArvDevice> device(arv_open_device(where.c_str(), error.out()));
  if (error || !device) return failed("cannot be opened: " + error.message());
  if (ARV_IS_GV_DEVICE(device.get())) {
    ArvGvDevice* const gige = ARV_GV_DEVICE(device.get());
    if (!arv_gv_device_is_controller(gige)) {
      return failed("is under the control of another host or program");
    }
    // Packets come through a UDP socket, which needs no administrator rights.
    arv_gv_device_set_stream_options(gige, ARV_GV_STREAM_OPTION_PACKET_SOCKET_DISABLED);
  }
  OwnedObject<ArvCamera> camera(arv_camera_new_with_device(device.get(), error.out()));
  if (error || !camera) return failed(error.message());
  return camera;
}

}  // namespace orbwatch::hal
