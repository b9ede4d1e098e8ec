// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/simulated_camera.h"

#include <chrono>
#include <string_view>
#include <utility>

#include "app/simulation/scene/hash.h"

namespace orbwatch::app::simulation {
namespace {

constexpr int kMaxSimulatedSide = 8192;  // pixels

std::string_view model_of(CameraKind kind) {
  return kind == CameraKind::Colour ? "ray-traced colour camera" : "ray-traced thermal camera";
}

std::uint64_t seed_of(std::uint64_t machine_seed, std::string_view name) {
  std::uint64_t seed = machine_seed;
  for (const char letter : name) seed = mix(seed ^ static_cast<unsigned char>(letter));
  return seed;
}

hal::TimePoint moment_of(std::uint64_t sequence, hal::TimePoint start, double frame_rate) {
  const std::chrono::duration<double> after(static_cast<double>(sequence) / frame_rate);
  return start + std::chrono::round<hal::Clock::duration>(after);
}

template <class Sample>
void add_to_rows(const SensorNoise& noise, hal::FrameBuffer& buffer) {
  const auto samples = buffer.picture.samples<Sample>();
  const auto per_row = static_cast<std::size_t>(samples.stride);
  auto* const first = reinterpret_cast<Sample*>(buffer.memory);
  for (int row = 0; row < samples.height; ++row) {
    const auto number = static_cast<std::size_t>(row);
    noise.add(std::span(first + number * per_row, per_row), buffer.metadata.sequence, number);
  }
}

}  // namespace

SimulatedCamera::SimulatedCamera(std::shared_ptr<const Machine> machine,
                                 SimulatedCameraSettings settings)
    : Camera({settings.name, std::string(model_of(settings.kind)), "simulated"}),
      machine_(std::move(machine)),
      settings_(std::move(settings)),
      script_(settings_.faults) {}

SimulatedCamera::~SimulatedCamera() { stop(); }

Result<> SimulatedCamera::check(int width, int height, double frame_rate) const {
  const auto refuse = [&](const std::string& what) {
    return fail("camera " + info().id + ": " + what);
  };
  const MachineSettings& machine = machine_->settings();
  if (width < 1 || width > kMaxSimulatedSide || height < 1 || height > kMaxSimulatedSide) {
    return refuse("size " + std::to_string(width) + "x" + std::to_string(height) +
                  "; both must be from 1 to " + std::to_string(kMaxSimulatedSide) + " pixels");
  }
  if (!(frame_rate > 0 && frame_rate <= hal::kMaxFrameRate)) {
    return refuse("frame rate " + std::to_string(frame_rate) + "; it must be above 0 and at most " +
                  std::to_string(hal::kMaxFrameRate) + " per second");
  }
  if (!(settings_.horizontal_fov > 0 && settings_.horizontal_fov < 180)) {
    return refuse("horizontal field of view " + std::to_string(settings_.horizontal_fov) +
                  "; it must be above 0 and below 180 degrees");
  }
  if (!(settings_.noise_sigma >= 0) || !(settings_.kelvin_per_count > 0)) {
    return refuse("the noise must not be below 0 counts, and a count must be above 0 kelvin");
  }
  if (!(norm(settings_.position - machine.ball.centre) > machine.ball.radius) ||
      machine.table.contains(settings_.position) ||
      machine.workpiece.contains(settings_.position)) {
    return refuse("its position is inside ball, table or workpiece; it must be in free space");
  }
  return {};
}

Result<hal::StreamFormat> SimulatedCamera::do_configure(const hal::StreamRequest& request) {
  if (!is_connected(machine_->settings(), info().id)) {
    return fail("camera " + info().id + ": is not connected");
  }
  const int width = request.width != 0 ? request.width : settings_.width;
  const int height = request.height != 0 ? request.height : settings_.height;
  const double rate = request.frame_rate != 0 ? request.frame_rate : settings_.frame_rate;
  if (auto checked = check(width, height, rate); !checked) return tl::unexpected(checked.error());

  if (!renderer_ || pinhole_.width != width || pinhole_.height != height) {
    const MachineSettings& machine = machine_->settings();
    pinhole_ =
        look_at(settings_.position, machine.ball.centre, settings_.horizontal_fov, width, height);
    renderer_ = std::make_unique<const Renderer>(
        machine_, pinhole_,
        Sensor{settings_.kind, settings_.kelvin_per_count, settings_.kelvin_offset});
    const auto row_samples =
        static_cast<std::size_t>(width) *
        static_cast<std::size_t>(orbwatch::info(renderer_->format()).channels());
    noise_.emplace(settings_.noise_sigma, seed_of(machine.seed, settings_.name), row_samples);
    pool_ = hal::make_frame_pool(renderer_->format(), width, height, request.buffers);
  }
  format_ = {renderer_->format(), {}, width, height, rate};
  return format_;
}

Result<> SimulatedCamera::do_set(std::string_view control, double value) {
  if (control != "TriggerMode" || (value != 0 && value != 1)) {
    return fail("control \"" + std::string(control) +
                "\" cannot be set; it takes TriggerMode, 0 or 1");
  }
  trigger_mode_ = value == 1;
  return {};
}

Result<> SimulatedCamera::trigger() {
  if (!trigger_mode_) return fail("camera " + info().id + ": its TriggerMode is off");
  {
    const std::lock_guard lock(trigger_mutex_);
    if (trigger_) return fail("camera " + info().id + ": has not done the exposure before");
    trigger_ = hal::Clock::now();
  }
  wake();
  return {};
}

std::optional<hal::TimePoint> SimulatedCamera::take_trigger() {
  const std::lock_guard lock(trigger_mutex_);
  return std::exchange(trigger_, std::nullopt);
}

/// True if exposure `n` fails; it was then reported.
bool SimulatedCamera::is_missed(std::uint64_t n, hal::TimePoint moment) {
  if (is_connected(machine_->settings(), info().id)) {
    return fails(script_, {.sequence = n, .exposure_start = moment});
  }
  report(hal::Fault::Unplugged, "simulated");
  return true;
}

void SimulatedCamera::run_triggered() {
  std::uint64_t n = 0;
  do {
    const auto moment = take_trigger();
    if (!moment) continue;
    if (!is_missed(n, *moment)) expose(n, *moment);
    ++n;
  } while (wait());
}

void SimulatedCamera::run(const std::stop_token&) {
  if (trigger_mode_) return run_triggered();
  const hal::TimePoint start = hal::Clock::now();
  const auto moment = [&](std::uint64_t n) { return moment_of(n, start, format_.frame_rate); };
  for (std::uint64_t n = 0; wait_until(moment(n)); ++n) {
    // This is checked also when late, so that a fault script is always shown completely.
    if (is_missed(n, moment(n))) continue;
    if (hal::Clock::now() < moment(n + 1)) expose(n, moment(n));
  }
}

void SimulatedCamera::expose(std::uint64_t sequence, hal::TimePoint moment) {
  const auto buffer = pool_->acquire();
  if (!buffer) return;  // lost: all buffers are in use
  buffer->metadata = {.sequence = sequence, .exposure_start = moment};
  renderer_->render(machine_->process_time(moment), buffer->memory);
  add_noise(*buffer);
  deliver(buffer);
}

void SimulatedCamera::add_noise(hal::FrameBuffer& buffer) const {
  if (settings_.kind == CameraKind::Colour) {
    add_to_rows<std::uint8_t>(*noise_, buffer);
  } else {
    add_to_rows<std::uint16_t>(*noise_, buffer);
  }
}

std::unique_ptr<hal::Camera> make_camera(SimulatedCameraSettings settings,
                                         const SimulationContext& context) {
  settings.name = context.name;
  if (context.kelvin_per_count > 0) {
    settings.kelvin_per_count = context.kelvin_per_count;
    settings.kelvin_offset = context.kelvin_offset;
  }
  settings.faults = context.faults;
  return std::make_unique<SimulatedCamera>(context.machine, std::move(settings));
}

}  // namespace orbwatch::app::simulation
