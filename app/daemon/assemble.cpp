#include "app/daemon/assemble.h"

#include <algorithm>
#include <array>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "app/daemon/cameras.h"
#include "app/log.h"
#include "app/pictures/colour_maps.h"

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

/// The file's numbers (degC, or percent of full scale) as the camera's counts.
double counts(double value, const CameraSettings& camera, const hal::StreamFormat& format) {
  const signals::RadiometricScale scale{camera.kelvin_per_count};
  if (scale.is_radiometric()) return scale.counts(value);
  const double full_scale = (1 << info(format.format).bits) - 1;
  return value / 100 * full_scale;
}

remap::ColourMap colour_map(const SourceSettings& source, const CameraSettings& camera,
                            const hal::StreamFormat& format) {
  const auto range = source.range.value_or(std::array<double, 2>{0, 100});
  return {colour_map_table(source.colour_map), counts(range[0], camera, format),
          counts(range[1], camera, format)};
}

/// Of a name that is among them, as the configuration's checks saw to.
template <class Named>
std::size_t index_of(const std::vector<Named>& list, const std::string& name) {
  const auto it =
      std::find_if(list.begin(), list.end(), [&](const Named& item) { return item.name == name; });
  return static_cast<std::size_t>(it - list.begin());
}

const optics::RigCamera& rig_camera(const optics::Rig& rig, const std::string& name) {
  return rig.cameras[index_of(rig.cameras, name)];
}

Result<ViewPlan> plan_view(const Configuration& configuration, std::size_t index,
                           const PipelinePlan& plan) {
  const ViewSettings& view = configuration.views[index];
  std::vector<ViewSource> sources;
  std::optional<std::size_t> measured;
  for (const SourceSettings& source : view.sources) {
    const std::size_t number = index_of(configuration.cameras, source.camera);
    const CameraSettings& camera = configuration.cameras[number];
    const hal::StreamFormat& format = plan.formats[number];
    const optics::Rig& rig = configuration.rig;
    auto ball = optics::ball_projection(rig, rig_camera(rig, camera.name));
    if (!ball) return tl::unexpected(ball.error());
    if (configuration.process && configuration.process->view == view.name &&
        configuration.process->camera == source.camera) {
      measured = sources.size();
    }
    sources.push_back({number, format, *ball, source.weight, colour_map(source, camera, format)});
  }
  auto projection = optics::ViewProjection::make({view.kind,
                                                  {view.yaw, view.pitch, view.roll},
                                                  view.h_fov,
                                                  view.v_fov,
                                                  view.width,
                                                  view.height},
                                                 sources.front().ball);
  if (!projection) return fail("view " + view.name + ": " + projection.error().message);
  return ViewPlan{index,        view.name,          *projection, std::move(sources),
                  view.combine, view.interpolation, measured};
}

Result<> check_size(const hal::StreamFormat& format, const optics::RigCamera& camera) {
  if (format.width == camera.width && format.height == camera.height) return {};
  return fail("camera " + camera.name + ": delivers " + std::to_string(format.width) + "x" +
              std::to_string(format.height) + ", but the rig is for " +
              std::to_string(camera.width) + "x" + std::to_string(camera.height) + " pictures");
}

Result<> open_camera(const CameraSettings& settings, const optics::Rig& rig,
                     const std::shared_ptr<const simulation::Machine>& machine,
                     PipelinePlan& plan) {
  auto camera = make_camera(settings, machine);
  auto format = camera->configure({settings.width, settings.height, settings.frame_rate});
  if (!format) return fail("camera " + settings.name + ": " + format.error().message);
  std::vector<ControlSettings> controls = settings.controls;
  if (settings.trigger_mode == hal::TriggerMode::Software) controls.push_back({"TriggerMode", 1});
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
  if (auto fits = check_size(*format, rig_camera(rig, settings.name)); !fits) return fits;
  plan.cameras.push_back(std::move(camera));
  plan.formats.push_back(*format);
  return {};
}

MeasurementPlan plan_measurement(const Configuration& configuration, const PipelinePlan& plan) {
  const ProcessSettings& process = *configuration.process;
  MeasurementPlan measurement;
  while (configuration.views[measurement.view].name != process.view) ++measurement.view;
  const std::size_t number = index_of(configuration.cameras, process.camera);
  const CameraSettings& camera = configuration.cameras[number];
  measurement.scale = {camera.kelvin_per_count};
  measurement.threshold = counts(process.threshold, camera, plan.formats[number]);
  return measurement;
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
    if (auto opened = open_camera(settings, configuration.rig, *machine, plan); !opened) {
      return tl::unexpected(opened.error());
    }
    plan.triggers.push_back(lines.trigger(settings, *plan.cameras.back()));
  }
  for (std::size_t i = 0; i < configuration.views.size(); ++i) {
    auto view = plan_view(configuration, i, plan);
    if (!view) return tl::unexpected(view.error());
    plan.views.push_back(std::move(*view));
  }
  if (configuration.process) plan.measurement = plan_measurement(configuration, plan);
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
