#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace orbwatch::hal {

/// What is connected to this machine, for people and programs that write a configuration. Texts
/// come from devices and may hold anything.

/// A format and size that a camera offers.
struct CameraMode {
  std::string format;               ///< as the back-end's settings name it, or the driver does
  std::string size;                 ///< "640x480", or "2x2..4096x2160" for all between two
  std::vector<double> frame_rates;  ///< per second: each of them, or least and most; empty: unknown
};

struct CameraControl {
  std::string name;  ///< as Camera::set() takes it
  double minimum = 0;
  double maximum = 0;
  double step = 0;  ///< 0: any value between
  double default_value = 0;
  std::string state;                ///< "read only", "inactive" (an automatism has it), or empty
  std::vector<std::string> values;  ///< "1 = manual mode": of a menu; else empty
};

struct CameraEntry {
  std::string id;        ///< what the configuration takes, the most stable that there is
  std::string back_end;  ///< as in the configuration
  std::string model;
  std::string driver;
  std::string bus;                 ///< where it is plugged in
  std::vector<std::string> paths;  ///< all its device nodes and links
  std::string problem;             ///< why the rest is not known; else empty
  std::vector<CameraMode> modes;
  std::vector<CameraControl> controls;
};

/// A digital line of a GPIO chip.
struct LineEntry {
  std::uint32_t offset = 0;
  std::string name;       ///< empty: the board gives none
  std::string direction;  ///< "input" or "output"
  std::string consumer;   ///< who uses it, as the kernel knows; empty: nobody
};

struct ChipEntry {
  std::string label;    ///< of the driver, stable
  std::string path;     ///< device node: may be another after the next boot
  std::string problem;  ///< why the rest is not known; else empty
  std::vector<LineEntry> lines;
};

struct Inventory {
  std::vector<CameraEntry> cameras;
  std::vector<ChipEntry> chips;
};

}  // namespace orbwatch::hal
