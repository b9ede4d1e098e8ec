// SPDX-License-Identifier: Apache-2.0
#include "app/cli/bench/bench_site.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>
#include <variant>

#include "app/daemon/site/cameras.h"
#include "app/daemon/site/site_plan.h"

namespace orbwatch::app::cli {
namespace {

/// Format assumed for cameras that state none and are not connected: the most common one.
constexpr PixelFormat kAssumed = PixelFormat::Nv12;

/// Format that the camera itself states; nullopt: it is not connected. A simulated one is not
/// queried, since it would draw its machine first.
std::optional<hal::StreamFormat> asked_format(const files::Resolved& site, std::size_t index) {
  const files::CameraSettings& settings = site.site.cameras[index];
  if (std::holds_alternative<simulation::SimulatedCameraSettings>(settings.back_end)) return {};
  const auto camera = daemon::make_camera(settings, nullptr);
  const auto format = daemon::open_camera(*camera, site, index);
  return format ? std::optional(*format) : std::nullopt;
}

/// Format of the camera, and its source.
std::pair<hal::StreamFormat, std::string> format_of(const files::Resolved& site,
                                                    std::size_t index) {
  const files::CameraSettings& settings = site.site.cameras[index];
  if (const auto asked = asked_format(site, index)) return {*asked, "as the camera says"};
  hal::StreamFormat format = daemon::expected_format(site, index);
  const auto stated =
      std::visit([](const auto& camera) { return camera.stated_format(); }, settings.back_end);
  if (settings.radiometry.is_radiometric()) return {format, "as a radiometric camera"};
  format.format = stated.value_or(kAssumed);
  return {format, stated ? "as configured" : "assumed: it is not connected and states none"};
}

}  // namespace

void silence_console(files::Resolved& site) {
  std::get<ConsoleSettings>(site.site.sinks).enabled = false;
}

std::vector<std::string> simulate_cameras(files::Resolved& site) {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < site.site.cameras.size(); ++i) {
    auto [format, how] = format_of(site, i);
    files::CameraSettings& camera = site.site.cameras[i];
    camera.back_end = hal::TestPatternSettings{.name = {}, .pixel_format = format.format};
    camera.stream.width = format.width;
    camera.stream.height = format.height;
    camera.stream.frame_rate = format.frame_rate;
    camera.radiometry.kelvin_per_count = format.kelvin_per_count;
    camera.trigger = {.mode = hal::TriggerMode::Off};
    camera.trigger_source.clear();
    camera.controls.clear();
    camera.faults.clear();
    known.push_back(std::move(how));
  }
  for (pipeline::Recipe& recipe : site.recipes) recipe.controls.clear();
  for (LineSettings& line : site.site.lines) line.back_end = LineKind::Simulated;
  std::get<ModbusSettings>(site.site.sinks).enabled = false;
  std::get<WebSettings>(site.site.sinks).enabled = false;
  std::get<DdsSettings>(site.site.sinks).prefix += "_bench";
  return known;
}

}  // namespace orbwatch::app::cli
