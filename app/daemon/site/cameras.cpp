// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/site/cameras.h"

#include <cmath>
#include <sstream>
#include <string>
#include <utility>
#include <variant>

#include "app/daemon/site/build.h"
#include "app/pipeline/views/view_renderer.h"
#include "hal/device_camera.h"

namespace orbwatch::app::daemon {
namespace {

/// What the camera is set to when it is opened, in this order.
std::vector<files::ControlSettings> controls_of(const files::Resolved& site, std::size_t camera) {
  const files::CameraSettings& settings = site.site.cameras[camera];
  std::vector<files::ControlSettings> controls = settings.controls;
  if (settings.trigger.mode == hal::TriggerMode::Software) controls.push_back({"TriggerMode", 1});
  if (site.recipes.empty()) return controls;
  for (const pipeline::CameraControl& control : site.recipes.front().controls) {
    if (control.camera.index == camera) controls.push_back({control.name, control.value});
  }
  return controls;
}

/// True: a sink records pictures of the camera.
bool is_recorded(const files::Resolved& site, const files::CameraSettings& camera) {
  bool is_recorded = false;
  files::for_each_sink(site.site.sinks, [&](const auto& settings) {
    if constexpr (requires { records_pictures(settings, camera.name); }) {
      is_recorded = is_recorded || records_pictures(settings, camera.name);
    }
  });
  return is_recorded;
}

/// A triggered camera's frames queue. Of several sizes, such as the picture with lines of
/// telemetry, only the rig's can be used.
hal::StreamRequest stream_of(const files::Resolved& site, std::size_t camera) {
  const files::CameraSettings& settings = site.site.cameras[camera];
  const optics::RigCamera& rig = site.rig_camera(camera);
  hal::StreamRequest stream = settings.stream;
  stream.keeps_jpeg = is_recorded(site, settings);
  if (files::facts_of(settings.back_end).takes_size_of_rig) {
    if (stream.width == 0) stream.width = rig.width;
    if (stream.height == 0) stream.height = rig.height;
  }
  const bool triggered = settings.trigger.mode != hal::TriggerMode::Off;
  stream.is_triggered = triggered;
  stream.buffers = triggered ? hal::kTriggeredBuffers : hal::kFreeRunningBuffers;
  return stream;
}

/// Whether the pipeline can use the format that the camera delivers.
Result<> check_format(const hal::StreamFormat& format, const files::CameraSettings& settings,
                      const optics::RigCamera& rig) {
  const std::string delivers = "delivers " + std::string(info(format.format).name);
  if (!pipeline::ViewRenderer::is_supported(format.format)) {
    return fail(delivers + ", of which no view can be made");
  }
  if (settings.radiometry.is_radiometric() && format.format != PixelFormat::Y16) {
    const std::string advice(files::facts_of(settings.back_end).radiometric_advice);
    return fail("is radiometric but " + delivers + "; a radiometric camera delivers y16" +
                (advice.empty() ? "" : ": " + advice));
  }
  if (format.width == rig.width && format.height == rig.height) return {};
  return fail("delivers " + std::to_string(format.width) + "x" + std::to_string(format.height) +
              ", but the rig is for " + std::to_string(rig.width) + "x" +
              std::to_string(rig.height) + " pictures");
}

std::string kelvin_text(double kelvin) {
  std::ostringstream text;
  text << kelvin;
  return text.str();
}

/// Kelvin per count as the files or the camera itself say; 0: it is not radiometric. Error: they
/// contradict each other, or neither says.
Result<double> scale_of_counts(const hal::Camera& camera, const files::CameraSettings& settings) {
  const double stated = settings.radiometry.kelvin_per_count;
  if (!settings.radiometry.is_radiometric()) return 0;
  const auto said = camera.count_scale();
  if (!said && stated > 0) return stated;
  if (!said) {
    return fail("is radiometric but does not say its scale; state kelvin_per_count");
  }
  if (said->kelvin_per_count <= 0) {
    return fail("is radiometric but, as it is set, its counts are not temperatures: " +
                said->stated_by + "; set it with [[camera.control]]");
  }
  // A file has few digits.
  constexpr double kSame = 1e-6;
  if (stated > 0 && std::abs(stated / said->kelvin_per_count - 1) > kSame) {
    return fail("has kelvin_per_count " + kelvin_text(stated) + ", but says " +
                kelvin_text(said->kelvin_per_count) + ": " + said->stated_by);
  }
  if (settings.radiometry.kelvin_offset != 0) {
    return fail("has kelvin_offset " + kelvin_text(settings.radiometry.kelvin_offset) +
                ", but says counts that begin at 0 K: " + said->stated_by);
  }
  return said->kelvin_per_count;
}

}  // namespace

std::unique_ptr<hal::Camera> make_camera(
    const files::CameraSettings& settings,
    const std::shared_ptr<const simulation::Machine>& machine) {
  const simulation::SimulationContext context{
      {settings.name, settings.stream.frame_rate, settings.radiometry.kelvin_per_count,
       settings.faults, settings.radiometry.kelvin_offset},
      machine};
  auto camera =
      std::visit([&context](const auto& back_end) { return make_camera(back_end, context); },
                 settings.back_end);
  camera->set_stamps(settings.stamps);
  return camera;
}

hal::DeviceResult<hal::StreamFormat> open_camera(hal::Camera& camera, const files::Resolved& site,
                                                 std::size_t index) {
  const files::CameraSettings& settings = site.site.cameras[index];
  auto format = camera.configure(stream_of(site, index));
  if (!format) return hal::fail(hal::Fault::Unplugged, format.error().message);
  for (const files::ControlSettings& control : controls_of(site, index)) {
    if (const auto done = camera.set(control.name, control.value); !done) {
      return hal::fail(hal::Fault::Refused, done.error().message);
    }
  }
  if (const auto usable = check_format(*format, settings, site.rig_camera(index)); !usable) {
    return hal::fail(hal::Fault::WrongFormat, usable.error().message + camera.format_note());
  }
  const auto scale = scale_of_counts(camera, settings);
  if (!scale) return hal::fail(hal::Fault::WrongFormat, scale.error().message);
  format->kelvin_per_count = *scale;
  format->kelvin_offset = settings.radiometry.kelvin_offset;
  return *format;
}

OpenedCameras open_cameras(const files::Resolved& site,
                           const std::shared_ptr<const simulation::Machine>& machine) {
  OpenedCameras opened;
  for (std::size_t i = 0; i < site.site.cameras.size(); ++i) {
    opened.cameras.push_back(make_camera(site.site.cameras[i], machine));
    const auto format = open_camera(*opened.cameras[i], site, i);
    opened.absent[i] = !format;
    opened.formats.push_back(format.value_or(expected_format(site, i)));
  }
  return opened;
}

void add_cameras(pipeline::PipelinePlan& plan, OpenedCameras opened, const files::Resolved& site,
                 Lines& lines) {
  for (std::size_t i = 0; i < opened.cameras.size(); ++i) {
    const files::CameraSettings& settings = site.site.cameras[i];
    hal::TriggerSettings trigger = settings.trigger;
    if (trigger.mode == hal::TriggerMode::Line) {
      // A camera that runs freely may expose a period after the edge.
      trigger.timeout = hal::stall_timeout(opened.formats[i].frame_rate);
    }
    plan.triggers.push_back(lines.trigger(trigger, settings.trigger_source, *opened.cameras[i]));
  }
  plan.cameras = std::move(opened.cameras);
  plan.absent = opened.absent;
  plan.process_inputs = lines.process_inputs();
}

hal::DeviceResult<> reconnect(const files::Resolved& site, std::size_t index, hal::Camera& camera,
                              pipeline::Pipeline& pipeline) {
  const auto missing = [&](const hal::FaultReport& fault) {
    pipeline.miss(index, fault.fault);
    return hal::fail(fault.fault, "camera " + site.site.cameras[index].name + ": " + fault.detail);
  };
  const auto format = open_camera(camera, site, index);
  if (!format) return missing(format.error());
  const hal::StreamFormat& planned = pipeline.formats()[index];
  if (format->format != planned.format || format->kelvin_per_count != planned.kelvin_per_count) {
    std::vector<hal::StreamFormat> formats = pipeline.formats();
    formats[index] = *format;
    auto recompiled = rebuild(site, std::move(formats), index);
    if (!recompiled) return missing({hal::Fault::WrongFormat, recompiled.error().message});
    if (const auto taken = pipeline.take_over(std::move(*recompiled)); !taken) {
      return missing({hal::Fault::Refused, taken.error().message});
    }
  }
  if (const auto admitted = pipeline.admit(index, *format); !admitted) {
    return missing({hal::Fault::Refused, admitted.error().message});
  }
  return {};
}

}  // namespace orbwatch::app::daemon
