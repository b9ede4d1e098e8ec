#include "app/daemon/cameras.h"

#include <string>
#include <utility>
#include <variant>

#include "app/pipeline/views/view_renderer.h"

namespace orbwatch::app {
namespace {

/// What the camera is set to when it is opened, in this order.
std::vector<ControlSettings> controls_of(const Resolved& site, std::size_t camera) {
  const CameraSettings& settings = site.site.cameras[camera];
  std::vector<ControlSettings> controls = settings.controls;
  if (settings.trigger.mode == hal::TriggerMode::Software) controls.push_back({"TriggerMode", 1});
  if (site.recipes.empty()) return controls;
  for (const CameraControl& control : site.recipes.front().controls) {
    if (control.camera.index == camera) controls.push_back({control.name, control.value});
  }
  return controls;
}

/// Whether the pipeline can use the format that the camera delivers.
Result<> check_format(const hal::StreamFormat& format, const CameraSettings& settings,
                      const optics::RigCamera& rig) {
  const std::string delivers = "delivers " + std::string(info(format.format).name);
  if (!ViewRenderer::is_supported(format.format)) {
    return fail(delivers + ", of which no view can be made");
  }
  if (settings.radiometry.kelvin_per_count > 0 && format.format != PixelFormat::Y16) {
    return fail("has kelvin_per_count but " + delivers + "; a radiometric camera delivers y16");
  }
  if (format.width == rig.width && format.height == rig.height) return {};
  return fail("delivers " + std::to_string(format.width) + "x" + std::to_string(format.height) +
              ", but the rig is for " + std::to_string(rig.width) + "x" +
              std::to_string(rig.height) + " pictures");
}

Result<OpenCamera> open_camera(const Resolved& site, std::size_t index,
                               const std::shared_ptr<const simulation::Machine>& machine) {
  const CameraSettings& settings = site.site.cameras[index];
  auto camera = make_camera(settings, machine);
  const auto format = camera->configure(settings.stream);
  if (!format) return tl::unexpected(format.error());
  for (const ControlSettings& control : controls_of(site, index)) {
    if (auto done = camera->set(control.name, control.value); !done) {
      return tl::unexpected(done.error());
    }
  }
  return check_format(*format, settings, site.rig_camera(index)).map([&] {
    return OpenCamera{std::move(camera), *format};
  });
}

}  // namespace

std::unique_ptr<hal::Camera> make_camera(
    const CameraSettings& settings, const std::shared_ptr<const simulation::Machine>& machine) {
  const simulation::SimulationContext context{
      {settings.name, settings.stream.frame_rate, settings.radiometry.kelvin_per_count,
       settings.faults},
      machine};
  return std::visit([&context](const auto& back_end) { return make_camera(back_end, context); },
                    settings.back_end);
}

Result<std::vector<OpenCamera>> open_cameras(const Resolved& site) {
  const auto machine = simulation::Machine::make(site.site.simulation, hal::Clock::now());
  if (!machine) return tl::unexpected(machine.error());
  std::vector<OpenCamera> cameras;
  for (std::size_t i = 0; i < site.site.cameras.size(); ++i) {
    auto camera = open_camera(site, i, *machine);
    if (!camera) return fail("camera " + site.site.cameras[i].name + ": " + camera.error().message);
    cameras.push_back(std::move(*camera));
  }
  return cameras;
}

}  // namespace orbwatch::app
