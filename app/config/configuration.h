#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/config/recipe.h"
#include "app/config/view_settings.h"
#include "app/dds/dds_sink.h"
#include "app/modbus/modbus_settings.h"
#include "app/snapshot/snapshot_sink.h"
#include "hal/fault_script.h"
#include "hal/frame_matcher.h"
#include "hal/lines/frame_trigger.h"
#include "hal/lines/line_back_end.h"
#include "proc/optics/rig.h"
#include "proc/optics/vec.h"

namespace orbwatch::app {

/// What the file of `orbwatchd --config` says, checked. Which keys there are, what they may be and
/// what they mean stands in schema.h; this is where their values live and what they are by default.

struct SimulatedCameraPart {
  enum class Kind { Colour, Thermal };
  Kind kind = Kind::Colour;
  optics::Vec3 position;
  double h_fov = 0;
  double noise = 1;
};

struct ReplayPart {
  std::filesystem::path source;
  bool loop = true;
};

struct V4l2Part {
  std::string device;
  std::string pixel_format = "auto";
  bool colour = true;
};

struct LibcameraPart {
  std::string camera;
  std::string pixel_format = "auto";
  int sensor_width = 0;
  int sensor_height = 0;
  int sensor_bit_depth = 0;
};

/// What a radiometric camera sees the machine by.
struct RadiometrySettings {
  double wavelength = 10;
  std::optional<double> ball_reflectivity{};  ///< none: not known
  double ball_temperature = 20;
};

struct ControlSettings {
  std::string name;
  double value = 0;
};

enum class BackEnd { Simulated, Replay, V4l2, Libcamera };

/// The trigger_source of a camera that only commands trigger; no line has this name.
inline constexpr const char* kSoftwareSource = "software";

struct CameraSettings {
  int line = 0;  ///< in the file, for messages
  std::string name;
  BackEnd back_end = BackEnd::Simulated;
  int width = 0;
  int height = 0;
  double frame_rate = 0;
  double kelvin_per_count = 0;
  std::optional<RadiometrySettings> radiometry;
  hal::SyncPolicy sync = hal::SyncPolicy::Hold;
  hal::TriggerMode trigger_mode = hal::TriggerMode::Off;
  std::string trigger_source;
  hal::TriggerActivation trigger_activation = hal::TriggerActivation::RisingEdge;
  double trigger_delay_us = 0;
  PixelFormat encoding = PixelFormat::Rgb;
  std::vector<ControlSettings> controls;
  std::optional<SimulatedCameraPart> simulated;
  std::optional<ReplayPart> replay;
  std::optional<V4l2Part> v4l2;
  std::optional<LibcameraPart> libcamera;
  std::vector<hal::ScriptedFault> faults;
};

/// What a line is for.
enum class LineUse { TriggerIn, ProcessInput, TriggerOut, Strobe, ProcessOk, Alarm };

constexpr bool is_input(LineUse use) {
  return use == LineUse::TriggerIn || use == LineUse::ProcessInput;
}
constexpr bool is_pulsed(LineUse use) {
  return use == LineUse::TriggerOut || use == LineUse::Strobe;
}
constexpr bool is_watchdog(LineUse use) {
  return use == LineUse::ProcessOk || use == LineUse::Alarm;
}

enum class LineKind { Gpio, Simulated };

struct LineSettings {
  int line = 0;  ///< in the file, for messages
  std::string name;
  LineUse use = LineUse::TriggerIn;
  LineKind back_end = LineKind::Gpio;
  std::string line_name;
  std::string chip;
  int offset = 0;
  bool active_low = false;
  hal::LineBias bias = hal::LineBias::AsIs;
  double debounce_us = 0;
  double rate = 0;
  std::string source;
  double width_us = 1000;
  double delay_us = 0;
  double timeout_ms = 1000;
  double toggle_rate = 0;
};

struct PipelineSettings {
  double deadline_ms = 0;
  double sync_window_ms = 10;
  double sync_patience_ms = 10;
  int workers = -1;
};

struct SimulationSettings {
  int seed = 1;
  double spark_rate = 60;
  double pool_radius = 10;
  double pool_temperature = 2000;
};

struct ConsoleSettings {
  bool enabled = false;
  double period = 1;
};

/// A recipe and the number by which it is selected.
struct RecipeSettings {
  int line = 0;
  int number = 0;
  std::filesystem::path file;
  Recipe recipe;
};

struct Configuration {
  /// CRC-32 of this file, the rig's, the calibrations' that it names, and the recipes'.
  std::uint32_t checksum = 0;
  std::filesystem::path rig_file;
  optics::Rig rig;  ///< has every camera of `cameras`, by name
  PipelineSettings pipeline;
  SimulationSettings simulation;
  std::vector<CameraSettings> cameras;
  std::vector<LineSettings> lines;
  std::vector<ViewSettings> views;
  std::vector<RecipeSettings> recipes;  ///< the first one is measured from the start
  std::optional<SnapshotSettings> snapshot;
  ConsoleSettings console;
  ModbusSettings modbus;
  DdsSettings dds;
};

/// Reads and checks a configuration file and the rig file that it names. Relative paths in it count
/// from the file's folder. The error says file, line, key, what is wrong and what is allowed.
Result<Configuration> load_configuration(const std::filesystem::path& file);

/// The same for text that stands in for a file named `name`, with paths relative to `folder`.
Result<Configuration> parse_configuration(const std::string& text, const std::string& name,
                                          const std::filesystem::path& folder);

/// The name of every view by its index: those to look at, then those of the recipes, where views of
/// one name in several recipes are one.
std::vector<std::string> view_names(const Configuration& configuration);

/// The manual of all keys in Markdown, generated from the same declaration that the loader checks.
std::string configuration_manual();

}  // namespace orbwatch::app
