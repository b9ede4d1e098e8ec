// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "hal/lines/line.h"

namespace orbwatch::hal {

/// Devices connected to this machine, for writing a configuration. Texts come from devices and may
/// contain anything.

/// A format and size that a camera offers.
struct CameraMode {
  std::string format;               ///< name in the back-end's settings, or the driver's
  std::string size;                 ///< "640x480", or a range "2x2..4096x2160"
  std::vector<double> frame_rates;  ///< per second: each, or minimum and maximum; empty: unknown
};

struct CameraControl {
  std::string name;  ///< name that Camera::set() accepts
  double minimum = 0;
  double maximum = 0;
  double step = 0;  ///< 0: any value between
  double default_value = 0;
  std::string state;                ///< "read only", "inactive" (under automatic control), or empty
  std::vector<std::string> values;  ///< entries of a menu, such as "1 = manual mode"; else empty
};

struct CameraEntry {
  std::string id;        ///< for the configuration, the most stable name that exists
  std::string back_end;  ///< name in the configuration
  std::string model;
  std::string driver;
  std::string bus;                 ///< the port that it is connected to
  std::vector<std::string> paths;  ///< all its device nodes and links, or its other names
  std::string problem;             ///< reason why the rest is unknown; else empty
  std::string advice;              ///< advice for its configuration; mostly empty
  std::vector<CameraMode> modes;
  std::vector<CameraControl> controls;
};

struct Inventory {
  std::vector<CameraEntry> cameras;
  std::vector<ChipInfo> chips;
};

}  // namespace orbwatch::hal
