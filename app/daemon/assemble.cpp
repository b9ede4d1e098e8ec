#include "app/daemon/assemble.h"

#include <algorithm>
#include <thread>
#include <utility>
#include <vector>

#include "app/daemon/by_name.h"
#include "app/daemon/cameras.h"
#include "app/daemon/recipes.h"
#include "app/daemon/view_plans.h"

namespace orbwatch::app {
namespace {

Result<std::shared_ptr<const simulation::Machine>> make_machine(
    const SimulationSettings& simulation) {
  simulation::MachineSettings settings;
  settings.seed = static_cast<std::uint64_t>(simulation.seed);
  settings.sparks.rate = simulation.spark_rate;
  settings.pool.radius = simulation.pool_radius;
  settings.pool.peak = simulation.pool_temperature;
  return simulation::Machine::make(settings, hal::Clock::now());
}

Result<> check_size(const hal::StreamFormat& format, const optics::RigCamera& camera) {
  if (format.width == camera.width && format.height == camera.height) return {};
  return fail("camera " + camera.name + ": delivers " + std::to_string(format.width) + "x" +
              std::to_string(format.height) + ", but the rig is for " +
              std::to_string(camera.width) + "x" + std::to_string(camera.height) + " pictures");
}

/// What the recipe that is measured from the start sets cameras to.
std::vector<CameraControlSettings> first_controls(const Configuration& configuration) {
  if (configuration.recipes.empty()) return {};
  return configuration.recipes.front().recipe.controls;
}

Result<> open_camera(const CameraSettings& settings, const Configuration& configuration,
                     const std::shared_ptr<const simulation::Machine>& machine,
                     PipelinePlan& plan) {
  auto camera = make_camera(settings, machine);
  auto format = camera->configure({settings.width, settings.height, settings.frame_rate});
  if (!format) return fail("camera " + settings.name + ": " + format.error().message);
  std::vector<ControlSettings> controls = settings.controls;
  if (settings.trigger_mode == hal::TriggerMode::Software) controls.push_back({"TriggerMode", 1});
  for (const CameraControlSettings& control : first_controls(configuration)) {
    if (control.camera == settings.name) controls.push_back({control.name, control.value});
  }
  for (const ControlSettings& control : controls) {
    if (auto done = camera->set(control.name, control.value); !done) {
      return fail("camera " + settings.name + ": " + done.error().message);
    }
  }
  if (!ViewRenderer::is_supported(format->format)) {
    return fail("camera " + settings.name + ": delivers " + std::string(info(format->format).name) +
                ", of which no view can be made");
  }
  if (settings.kelvin_per_count > 0 && format->format != PixelFormat::Y16) {
    return fail("camera " + settings.name + ": has kelvin_per_count but delivers " +
                std::string(info(format->format).name) + "; a radiometric camera delivers y16");
  }
  if (auto fits = check_size(*format, by_name(configuration.rig.cameras, settings.name)); !fits)
    return fits;
  plan.cameras.push_back(std::move(camera));
  plan.formats.push_back(*format);
  return {};
}

std::size_t worker_count(int asked) {
  if (asked >= 0) return static_cast<std::size_t>(asked);
  return std::max(1U, std::thread::hardware_concurrency()) - 1;
}

hal::Clock::duration milliseconds(double value) {
  return std::chrono::duration_cast<hal::Clock::duration>(
      std::chrono::duration<double, std::milli>(value));
}

}  // namespace

Result<PipelinePlan> assemble(const Configuration& configuration, Lines& lines) {
  auto machine = make_machine(configuration.simulation);
  if (!machine) return tl::unexpected(machine.error());
  PipelinePlan plan;
  for (const CameraSettings& settings : configuration.cameras) {
    if (auto opened = open_camera(settings, configuration, *machine, plan); !opened) {
      return tl::unexpected(opened.error());
    }
    plan.triggers.push_back(lines.trigger(settings, *plan.cameras.back()));
  }
  for (const ViewSettings& settings : configuration.views) {
    auto view = plan_view(configuration, settings, plan.views.size(), plan.formats);
    if (!view) return tl::unexpected(view.error());
    plan.views.push_back(std::move(*view));
  }
  auto recipes = compile_recipes(configuration, plan.formats);
  if (!recipes) return tl::unexpected(recipes.error());
  plan.recipes = std::move(*recipes);
  plan.view_count = view_names(configuration).size();
  plan.configuration_checksum = configuration.checksum;
  plan.process_inputs = lines.process_inputs();
  plan.deadline = milliseconds(configuration.pipeline.deadline_ms);
  plan.sync.window = milliseconds(configuration.pipeline.sync_window_ms);
  plan.sync.patience = milliseconds(configuration.pipeline.sync_patience_ms);
  for (std::size_t i = 0; i < configuration.cameras.size(); ++i) {
    plan.sync.policies[i] = configuration.cameras[i].sync;
  }
  plan.workers = worker_count(configuration.pipeline.workers);
  return plan;
}

}  // namespace orbwatch::app
