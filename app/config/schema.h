#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/config/configuration.h"
#include "app/config/constraint.h"
#include "app/config/recipe_file.h"
#include "app/config/rig_file.h"
#include "app/config/view_schema.h"
#include "app/modbus/access_list.h"
#include "app/pipeline/status.h"
#include "hal/camera.h"
#include "hal/v4l2/pixel_coding.h"

/// The one declaration of every key of the configuration file: name, where its value lives, what is
/// allowed, what it means. visit() is called with a loader, which reads and checks, or with a
/// writer of the manual. A visitor offers
///   required(key, value, constraint, text), optional(key, value, constraint, text):
///     a number with a Range, a string or a file without constraint, a word out of a list;
///   required_if(applies, when, key, ...), optional_if(applies, when, key, ...): the same for a key
///     that only one case has, and refused in the others;
///   table(key, value, text), tables(key, values, least, most, text): nested keys;
///   require(truth, key, message): a rule between keys; line(number): where the table stands.
namespace orbwatch::app {

inline constexpr std::array kBackEnds{Word{"simulated", BackEnd::Simulated},
                                      Word{"replay", BackEnd::Replay}, Word{"v4l2", BackEnd::V4l2},
                                      Word{"libcamera", BackEnd::Libcamera}};
inline constexpr std::array kSyncPolicies{Word{"hold", hal::SyncPolicy::Hold},
                                          Word{"nearest", hal::SyncPolicy::Nearest}};
inline constexpr std::array kFaults{
    Word{"unplugged", hal::Fault::Unplugged}, Word{"stalled", hal::Fault::Stalled},
    Word{"read_error", hal::Fault::ReadError}, Word{"corrupt_frame", hal::Fault::CorruptFrame},
    Word{"wrong_format", hal::Fault::WrongFormat}};
inline constexpr std::array kSimulatedKinds{Word{"colour", SimulatedCameraPart::Kind::Colour},
                                            Word{"thermal", SimulatedCameraPart::Kind::Thermal}};

inline constexpr std::array kTriggerModes{Word{"off", hal::TriggerMode::Off},
                                          Word{"software", hal::TriggerMode::Software},
                                          Word{"line", hal::TriggerMode::Line}};
inline constexpr std::array kTriggerActivations{
    Word{"rising_edge", hal::TriggerActivation::RisingEdge},
    Word{"falling_edge", hal::TriggerActivation::FallingEdge},
    Word{"any_edge", hal::TriggerActivation::AnyEdge}};
inline constexpr std::array kLineUses{
    Word{"trigger_in", LineUse::TriggerIn},   Word{"process_input", LineUse::ProcessInput},
    Word{"trigger_out", LineUse::TriggerOut}, Word{"strobe", LineUse::Strobe},
    Word{"process_ok", LineUse::ProcessOk},   Word{"alarm", LineUse::Alarm}};
inline constexpr std::array kLineKinds{Word{"gpio", LineKind::Gpio},
                                       Word{"simulated", LineKind::Simulated}};
inline constexpr std::array kLineBiases{
    Word{"as_is", hal::LineBias::AsIs}, Word{"disabled", hal::LineBias::Disabled},
    Word{"pull_up", hal::LineBias::PullUp}, Word{"pull_down", hal::LineBias::PullDown}};

inline constexpr std::array kRosGenerations{Word{"humble", RosGeneration::Humble},
                                            Word{"iron", RosGeneration::Iron}};
inline constexpr std::array kParities{Word{"none", Parity::None}, Word{"even", Parity::Even},
                                      Word{"odd", Parity::Odd}};

template <class Visitor>
void visit(Visitor& v, SimulatedCameraPart& part) {
  v.required("kind", part.kind, kSimulatedKinds, "8-bit RGB, or 16-bit radiometric");
  v.required("position", part.position, kAnyNumber,
             "In the machine frame, mm; it looks at the ball");
  v.required("h_fov", part.h_fov, Range::inside(0, 180), "Horizontal field of view, deg");
  v.optional("noise", part.noise, Range::between(0, 1000), "Standard deviation, counts");
}

template <class Visitor>
void visit(Visitor& v, ReplayPart& part) {
  v.required("source", part.source, "Folder of numbered JPEG or PNG pictures, or a video");
  v.optional("loop", part.loop, "Begin again at the end");
}

template <class Visitor>
void visit(Visitor& v, RadiometrySettings& radiometry) {
  v.optional("wavelength", radiometry.wavelength, Range::between(0.5, 20),
             "Effective wavelength of its band, um");
  v.optional("ball_reflectivity", radiometry.ball_reflectivity, Range::between(0.05, 1),
             "Of the mirror ball at that wavelength; temperatures are apparent unless it and the "
             "region's emissivity are given");
  v.optional("ball_temperature", radiometry.ball_temperature, Range::between(-273, 1000),
             "Of the mirror ball, degC: what it does not reflect it emits");
}

template <class Visitor>
void visit(Visitor& v, ControlSettings& control) {
  v.required("name", control.name,
             "GenICam's, for v4l2 and libcamera: ExposureTime (us), Gain, and ExposureAuto and "
             "BalanceWhiteAuto (0 off, 1 on), for v4l2 GainAuto and TriggerMode, too; or the "
             "camera's own, as `orbwatch list` shows it");
  v.required("value", control.value, kAnyNumber,
             "In the camera's units; for a menu, the entry's number");
}

template <class Visitor>
void visit(Visitor& v, V4l2Part& part) {
  v.required("device", part.device,
             "Device node, or what survives replugging: a link in /dev/v4l/by-id or by-path, or "
             "the place on a bus (usb-0000:00:14.0-1)");
  v.optional("pixel_format", part.pixel_format, hal::kPixelCodingNames,
             "What the camera sends; auto takes the first that it has in the size and at the rate");
  v.optional("colour", part.colour,
             "Make colour of a sensor's mosaic and of MJPEG; else the mosaic stays as it is, and "
             "of MJPEG the luminance");
}

template <class Visitor>
void visit(Visitor& v, LibcameraPart& part) {
  v.required("camera", part.camera,
             "Its id in libcamera, or a part of id or sensor model that only one camera has");
  v.optional("pixel_format", part.pixel_format,
             "auto, or libcamera's name: NV12, YUV420, R10, ...");
  v.optional("sensor_width", part.sensor_width, kSide,
             "Of the sensor mode that is required, px; else libcamera chooses the mode");
  v.optional("sensor_height", part.sensor_height, kSide, "Of the sensor mode, px");
  v.optional("sensor_bit_depth", part.sensor_bit_depth, Range::between(1, 32),
             "Of the sensor mode, bits per sample");
  v.require((part.sensor_width == 0) == (part.sensor_height == 0) &&
                (part.sensor_width == 0) == (part.sensor_bit_depth == 0),
            "sensor_width", "a sensor mode needs sensor_width, sensor_height and sensor_bit_depth");
}

template <class Visitor>
void visit(Visitor& v, hal::ScriptedFault& fault) {
  v.required("fault", fault.fault, kFaults, "What fails");
  v.required("from", fault.from, Range::between(0, 1e15), "First frame that fails");
  v.required("until", fault.until, Range::between(0, 1e15), "First frame that works again");
}

template <class Visitor>
void visit(Visitor& v, CameraSettings& camera) {
  v.line(camera.line);
  v.required("name", camera.name, "Its name in the rig; views and messages use it too");
  v.required("back_end", camera.back_end, kBackEnds, "Where its frames come from");
  v.optional("width", camera.width, kSide,
             "Picture width, px, as in the rig; else the camera's own");
  v.optional("height", camera.height, kSide,
             "Picture height, px, as in the rig; else the camera's own");
  v.optional("frame_rate", camera.frame_rate, Range::between(0.01, hal::kMaxFrameRate),
             "Frames per second; else the camera's own");
  v.optional("kelvin_per_count", camera.kelvin_per_count, Range::above(0, 10),
             "Radiometric scale of a 16-bit thermal camera; else it is none");
  v.table("radiometry", camera.radiometry,
          "Of a radiometric camera: makes true temperatures of apparent ones");
  v.optional(
      "sync", camera.sync, kSyncPolicies,
      "In a set without a frame of it within the window: hold its last one, which is not measured "
      "again, or nearest, which leaves it out");
  v.optional(
      "trigger_mode", camera.trigger_mode, kTriggerModes,
      "off: every frame counts; software: each edge asks the camera for a frame, of a camera with "
      "the controls TriggerMode and TriggerSoftware or a simulated one; line: the frame that "
      "begins "
      "after an edge counts, of a camera that sees the edge or runs freely");
  v.optional(
      "trigger_source", camera.trigger_source,
      "Name of the line, whose use is trigger_in; or software: only the command trigger does");
  v.optional("trigger_activation", camera.trigger_activation, kTriggerActivations,
             "Which of its edges are triggers");
  v.optional("trigger_delay_us", camera.trigger_delay_us, Range::between(0, 1e7),
             "From the edge to the exposure, us");
  v.optional("encoding", camera.encoding, kEncodings,
             "Of its own pictures over DDS; 16-bit ones go out as mono16");
  v.tables("control", camera.controls, 0, 64,
           "What the camera is set to, in this order, for v4l2 and libcamera");
  v.table("simulated", camera.simulated, "For back_end simulated");
  v.table("replay", camera.replay, "For back_end replay");
  v.table("v4l2", camera.v4l2, "For back_end v4l2");
  v.table("libcamera", camera.libcamera, "For back_end libcamera");
  v.tables("fault", camera.faults, 0, 100, "Faults to show, for simulated and replay");
  v.require(!camera.radiometry || camera.kelvin_per_count > 0, "radiometry",
            "only a camera with kelvin_per_count is radiometric");
  v.require(camera.back_end != BackEnd::Simulated || camera.simulated, "back_end",
            "simulated needs a table [camera.simulated]");
  v.require(camera.back_end != BackEnd::Simulated || (camera.width && camera.height), "back_end",
            "simulated needs width and height");
  v.require(camera.back_end != BackEnd::Replay || camera.replay, "back_end",
            "replay needs a table [camera.replay]");
  v.require(camera.back_end != BackEnd::V4l2 || camera.v4l2, "back_end",
            "v4l2 needs a table [camera.v4l2]");
  v.require(camera.back_end != BackEnd::Libcamera || camera.libcamera, "back_end",
            "libcamera needs a table [camera.libcamera]");
  const bool triggered = camera.trigger_mode != hal::TriggerMode::Off;
  v.require(triggered != camera.trigger_source.empty(), "trigger_mode",
            "a triggered camera needs trigger_source, and only that");
}

template <class Visitor>
void visit_pulses(Visitor& v, LineSettings& line) {
  const char* pulses = "trigger_out and strobe";
  v.optional_if(is_pulsed(line.use), pulses, "source", line.source,
                "A trigger_in line whose active edges fire the pulse, for trigger_out and strobe");
  v.optional_if(line.use == LineUse::TriggerOut, "trigger_out", "rate", line.rate,
                Range::between(0, 1000),
                "Pulses per second, for trigger_out; 0: when source or the command pulse says");
  v.optional_if(is_pulsed(line.use), pulses, "width_us", line.width_us, Range::between(10, 1e7),
                "Length of the pulse, us, for trigger_out and strobe");
  v.optional_if(is_pulsed(line.use), pulses, "delay_us", line.delay_us, Range::between(0, 1e7),
                "From the edge to the pulse, us, for trigger_out and strobe");
  v.require(line.use != LineUse::Strobe || !line.source.empty(), "source", "a strobe needs it");
  v.require(line.source.empty() || line.rate <= 0, "rate", "goes without source only");
  v.require(line.rate * line.width_us < 1e6, "width_us",
            "a pulse must be shorter than the period of the rate");
}

template <class Visitor>
void visit(Visitor& v, LineSettings& line) {
  v.line(line.line);
  v.required("name", line.name, "What cameras and other lines call it");
  v.required("use", line.use, kLineUses,
             "trigger_in: its edges trigger cameras and pulses; process_input: what the machine "
             "says; trigger_out, strobe: pulses; process_ok: active while the pipeline works; "
             "alarm: active while there is none. The last two fall when the pipeline stops");
  v.optional("back_end", line.back_end, kLineKinds,
             "The kernel's lines; or simulated, where an input and an output of one line_name are "
             "a wire");
  v.optional("line_name", line.line_name, "The line as the board names it: see gpioinfo");
  v.optional("chip", line.chip, "Instead of line_name: the label of its chip, see gpiodetect");
  v.optional("offset", line.offset, Range::between(0, 65535), "Its number on that chip");
  v.optional("active_low", line.active_low, "Active when the wire is low");
  v.optional("bias", line.bias, kLineBiases,
             "The chip's resistor: what holds the wire when nobody drives it");
  v.optional_if(is_input(line.use), "inputs", "debounce_us", line.debounce_us,
                Range::between(0, 1e7), "Shorter changes do not count, us; for inputs");
  visit_pulses(v, line);
  const char* watchdogs = "process_ok and alarm";
  v.optional_if(is_watchdog(line.use), watchdogs, "timeout_ms", line.timeout_ms,
                Range::between(200, 60000),
                "Falls when the pipeline was silent so long, for process_ok and alarm");
  v.optional_if(is_watchdog(line.use), watchdogs, "toggle_rate", line.toggle_rate,
                Range::between(0, 1000),
                "Toggles so often per second instead of being held, for process_ok and alarm");
  v.require(line.line_name.empty() != line.chip.empty(), "line_name",
            "a line has either line_name, or chip and offset");
}

template <class Visitor>
void visit(Visitor& v, PipelineSettings& pipeline) {
  v.optional("deadline_ms", pipeline.deadline_ms, Range::between(0, 60000),
             "For one frame set; 0: the first camera's frame period");
  v.optional("sync_window_ms", pipeline.sync_window_ms, Range::between(0, 10000),
             "Largest difference of exposure starts in a set");
  v.optional("sync_patience_ms", pipeline.sync_patience_ms, Range::between(0, 10000),
             "Longest wait of the first camera's frame for those of the others");
  v.optional("workers", pipeline.workers, Range::between(-1, 64),
             "Threads besides the pipeline's own; -1: one less than there are cores");
}

template <class Visitor>
void visit(Visitor& v, SimulationSettings& simulation) {
  v.optional("seed", simulation.seed, Range::between(0, 2147483647), "Of sparks and noise");
  v.optional("spark_rate", simulation.spark_rate, Range::between(0, 150), "Per second, mean");
  v.optional("pool_radius", simulation.pool_radius, Range::between(1, 20),
             "Of the molten pool, mm, mean");
  v.optional("pool_temperature", simulation.pool_temperature, Range::between(1500, 2300),
             "In the pool's centre, degC, mean");
}

template <class Visitor>
void visit(Visitor& v, ConsoleSettings& console) {
  v.optional("enabled", console.enabled, "Print a line of figures to standard output");
  v.optional("period", console.period, Range::between(0.1, 3600), "Seconds between lines");
}

template <class Visitor>
void visit(Visitor& v, ModbusSerialSettings& serial) {
  v.required("device", serial.device, "The line, best as in /dev/serial/by-id");
  v.optional("baud_rate", serial.baud_rate, Range::between(1200, 921600), "Bits per second");
  v.require(std::ranges::count(kBaudRates, serial.baud_rate) == 1, "baud_rate",
            "is not a rate of serial lines, as 9600, 19200, 38400, 57600 or 115200");
  v.optional("parity", serial.parity, kParities, "none usually goes with 2 stop bits");
  v.optional("stop_bits", serial.stop_bits, Range::between(1, 2), "At the end of a character");
  v.optional("unit_id", serial.unit_id, Range::between(1, 247),
             "The unit that is served; what is written to all units, 0, counts too");
  v.optional("may_write", serial.may_write, "Masters on this line may write");
}

/// Every text must be an address or a prefix.
template <class Visitor>
void require_networks(Visitor& v, const char* key, const std::vector<std::string>& texts) {
  for (const std::string& text : texts) {
    const auto network = modbus::parse_network(text);
    v.require(network.has_value(), key, network ? "" : network.error().message);
  }
}

template <class Visitor>
void visit(Visitor& v, ModbusSettings& modbus) {
  v.optional("enabled", modbus.enabled, "Serve Modbus");
  v.optional("address", modbus.address, "Numeric address to listen on");
  v.optional("port", modbus.port, Range::between(0, 65535), "0: any free port");
  v.optional("max_connections", modbus.max_connections, Range::between(1, 1000),
             "One more client drops the one that was quiet for longest");
  v.optional("readers", modbus.readers,
             "Numeric addresses or prefixes (10.0.0.0/24) of clients that may read; []: all");
  require_networks(v, "readers", modbus.readers);
  v.optional("writers", modbus.writers,
             "Of clients that may write, and read; []: all that may read");
  require_networks(v, "writers", modbus.writers);
  v.optional("unit_ids", modbus.unit_ids, Range::between(0, 255),
             "Units that are answered; requests for others get exception 11");
  v.require(!modbus.unit_ids.empty(), "unit_ids", "names no unit, so nobody would be answered");
  v.table("serial", modbus.serial, "Modbus RTU on a serial line, beside TCP");
  v.optional("plc_timeout_ms", modbus.plc_timeout_ms, Range::between(0, 60000),
             "For how long the PLC's heartbeat may stand still; 0: it is not watched");
}

template <class Visitor>
void visit(Visitor& v, SecuritySettings& security) {
  v.required("folder", security.folder,
             "Certificate, key and permissions, as made by `orbwatch dds-keys`");
}

template <class Visitor>
void visit(Visitor& v, JpegSettings& jpeg) {
  v.optional("quality", jpeg.quality, Range::between(1, 100), "The best that is used");
  v.optional("target_bytes", jpeg.target_bytes, Range::between(0, 1e8),
             "Of a picture; the quality falls, down to 10, to stay below; 0: no limit");
  v.optional("rate", jpeg.rate, Range::between(0, 1000),
             "Pictures per second and topic at most; 0: all");
}

template <class Visitor>
void visit(Visitor& v, DdsSettings& dds) {
  v.optional("enabled", dds.enabled, "Publish views and process state over DDS");
  v.optional("domain", dds.domain, Range::between(0, 230), "ROS_DOMAIN_ID of ROS 2");
  v.optional("prefix", dds.prefix, "Topics are rt/<prefix>/...");
  v.optional("profile", dds.profile,
             "Settings of the network for Cyclone DDS, as in platform/dds; else those that "
             "CYCLONEDDS_URI names");
  v.optional("ros", dds.ros, kRosGenerations,
             "How ROS 2's graph is told of the node orbwatch: iron is for Iron and later");
  v.optional("commands", dds.commands, "Take commands over DDS, too");
  v.table("security", dds.security,
          "Authentication, access control and encryption: only who has keys sees and commands");
  v.table("jpeg", dds.jpeg, "Of the compressed topics");
}

template <class Visitor>
void visit(Visitor& v, SnapshotSettings& snapshot) {
  v.required("folder", snapshot.folder, "Where the command snapshot writes PNG pictures");
  v.optional("keep", snapshot.keep, Range::between(1, 100000),
             "Snapshots that stay; one more removes the oldest");
}

template <class Visitor>
void visit(Visitor& v, RecipeSettings& settings) {
  v.line(settings.line);
  v.required("number", settings.number, Range::between(1, 65535), "What select_recipe calls it");
  v.required("file", settings.file, "What is measured; see [RECIPE.md](RECIPE.md)");
  if (settings.file.empty()) return;
  auto recipe = load_recipe(settings.file);
  v.require(recipe.has_value(), "file", recipe ? "" : recipe.error().message);
  if (recipe) settings.recipe = std::move(*recipe);
}

template <class Visitor>
void visit(Visitor& v, Configuration& configuration) {
  v.required("rig", configuration.rig_file,
             "Where cameras, ball and machine stand; see [RIG.md](RIG.md)");
  if (!configuration.rig_file.empty()) {
    auto rig = load_rig(configuration.rig_file);
    v.require(rig.has_value(), "rig", rig ? "" : rig.error().message);
    if (rig) configuration.rig = std::move(*rig);
  }
  v.table("pipeline", configuration.pipeline, "Frame budget and threads");
  v.table("simulation", configuration.simulation, "The machine that simulated cameras look into");
  v.tables("camera", configuration.cameras, 1, kMaxCameras,
           "Cameras; the first without a fault sets the pace");
  v.tables("line", configuration.lines, 0, 32, "Digital inputs and outputs");
  v.tables("view", configuration.views, 0, kMaxViews,
           "Virtual cameras in the ball's centre to look at, which can be pointed elsewhere");
  v.tables("recipe", configuration.recipes, 0, kMaxRecipes,
           "What is measured; the first one from the start");
  v.table("snapshot", configuration.snapshot, "Pictures on command");
  v.table("console", configuration.console, "Figures on standard output");
  v.table("modbus", configuration.modbus, "Towards the PLC");
  v.table("dds", configuration.dds, "Towards the machine controller");
}

}  // namespace orbwatch::app
