// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "hal/v4l2/device/v4l2_controls.h"
#include "hal/v4l2/device/v4l2_list.h"
#include "hal/v4l2/v4l2_settings.h"

/// Camera of the kernel's driver vivid. These tests run in the machine that tests/hil makes.
namespace orbwatch::hal {

/// Place on its bus: unchanged after its driver was unbound.
inline constexpr const char* kVivid = "platform:vivid-000";

/// Request used unless another format, size or rate is tested.
inline constexpr StreamRequest kVividRequest{.width = 320, .height = 180, .frame_rate = 60};
inline V4l2Settings vivid_settings() { return {kVivid, "yuyv", true}; }

/// Opens a separate descriptor for settings that the tested camera does not make.
inline V4l2Device open_vivid() {
  return find_v4l2_device(kVivid).and_then(V4l2Device::open).value();
}

inline void set_vivid(const char* control, double value) {
  V4l2Device device = open_vivid();
  const auto done = set_control(device, control, value);
  ASSERT_TRUE(done) << done.error().message;
}

/// Takes the device from its driver ("unbind") or returns it ("bind"), like plugging does.
inline void plug(const char* action) {
  std::ofstream file(std::string("/sys/bus/platform/drivers/vivid/") + action);
  file << "vivid.0" << std::flush;
  ASSERT_TRUE(file.good()) << action;
}

}  // namespace orbwatch::hal
