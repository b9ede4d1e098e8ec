#include "app/pipeline/pipeline.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "app/log.h"

namespace orbwatch::app {
namespace {

using std::chrono::milliseconds;

/// Without frames the status still goes out this often: the PLC's heartbeat.
constexpr milliseconds kHeartbeatPeriod{100};

bool is_as_configured(const Picture& picture, const hal::StreamFormat& format) {
  return picture.format == format.format && picture.width == format.width &&
         picture.height == format.height;
}

/// Lets the frames pass that belong to a trigger, and numbers them.
hal::Camera::Gate stamp_with(const std::shared_ptr<hal::FrameTrigger>& trigger) {
  return [trigger](hal::FrameMetadata& metadata) {
    const auto stamp = trigger->claim(metadata.exposure_start);
    if (stamp) metadata.trigger = stamp->id;
    return stamp.has_value();
  };
}

}  // namespace

Pipeline::Pipeline(PipelinePlan plan)
    : plan_(std::move(plan)),
      sync_(plan_.cameras.size(), plan_.sync),
      workers_(plan_.workers),
      pan_tilt_zoom_(plan_.views),
      view_meters_(plan_.view_count) {
  for (const ViewPlan& view : plan_.views) {
    auto renderer = std::make_unique<ViewRenderer>(view);
    std::vector<std::unique_ptr<View>> buffers;
    for (std::size_t i = 0; i < kViewBuffers; ++i) {
      buffers.push_back(std::make_unique<View>(renderer->make_view()));
      buffers.back()->name = view.name;  // the renderer's own copy goes when the view is pointed
    }
    renderers_.push_back({std::move(renderer), 0});
    pools_.emplace_back(std::move(buffers));
  }
  plan_.triggers.resize(plan_.cameras.size());
  for (std::size_t i = 0; i < plan_.cameras.size(); ++i) {
    if (plan_.triggers[i]) plan_.cameras[i]->set_gate(stamp_with(plan_.triggers[i]));
  }
  status_.camera_count = plan_.cameras.size();
  status_.view_count = plan_.view_count;
  status_.configuration_checksum = plan_.configuration_checksum;
  if (!plan_.recipes.empty()) start_measuring();
}

std::size_t Pipeline::pacing_camera() const {
  for (std::size_t camera = 0; camera < plan_.cameras.size(); ++camera) {
    if (faults_[camera] == hal::Fault::None) return camera;
  }
  return 0;
}

void Pipeline::start_measuring() {
  std::vector<RecipeControls> recipes;
  bool any = false;
  for (const auto& recipe : plan_.recipes) {
    recipes.push_back({recipe->plan().number, recipe->plan().controls});
    any = any || !recipes.back().controls.empty();
  }
  RecipeSwitch::Apply apply;
  if (any) apply = [this, recipes](std::size_t recipe) { return set_cameras(recipes[recipe]); };
  measurement_.emplace(std::move(plan_.recipes), plan_.process_inputs, std::move(apply));
}

/// On the recipe switch's thread. One that is refused does not keep the others from being set: on
/// the way back they must be.
Result<> Pipeline::set_cameras(const RecipeControls& recipe) {
  Result<> result;
  for (const CameraControl& control : recipe.controls) {
    hal::Camera& camera = *plan_.cameras[control.camera];
    const auto done = camera.set(control.name, control.value);
    if (done || !result) continue;
    result = fail("recipe " + std::to_string(recipe.number) + ": camera " + camera.info().id +
                  ": " + done.error().message);
  }
  return result;
}

Pipeline::~Pipeline() { stop(); }

Result<> Pipeline::start(std::vector<Sink*> sinks) {
  sinks_ = std::move(sinks);
  last_roll_ = hal::Clock::now();
  thread_ = std::thread([this] { run(); });
  for (std::size_t i = 0; i < plan_.cameras.size(); ++i) {
    auto started =
        plan_.cameras[i]->start([this, i](hal::Frame frame) { on_frame(i, std::move(frame)); },
                                [this, i](const hal::FaultReport& report) { on_fault(i, report); });
    if (!started) {
      stop();
      return started;
    }
  }
  return {};
}

void Pipeline::stop() {
  for (auto& camera : plan_.cameras) camera->stop();
  stopping_ = true;
  sync_.close();
  if (thread_.joinable()) thread_.join();
  pan_tilt_zoom_.stop();
  if (measurement_) measurement_->stop();
}

CommandResult Pipeline::command(const Command& command) {
  switch (command.code) {
    case CommandCode::SelectView:
      if (whole(command, 0) >= plan_.view_count) return CommandResult::ArgumentOutOfRange;
      selected_view_ = whole(command, 0);
      return CommandResult::Done;
    case CommandCode::PointView:
    case CommandCode::MixSources:
      return aim(command);
    default:
      return measurement_ ? measurement_->command(command) : CommandResult::NotPossible;
  }
}

/// A recipe's view keeps what it shows, so that nobody changes a measurement.
CommandResult Pipeline::aim(const Command& command) {
  const std::size_t view = whole(command, 0);
  if (view >= plan_.view_count) return CommandResult::ArgumentOutOfRange;
  if (view >= plan_.views.size()) return CommandResult::NotPossible;
  const auto& arguments = command.arguments;
  const auto done = command.code == CommandCode::MixSources
                        ? pan_tilt_zoom_.mix(view, whole(command, 1), arguments[2])
                        : pan_tilt_zoom_.turn(view, arguments[1], arguments[2], arguments[3]);
  return done ? CommandResult::Done : CommandResult::ArgumentOutOfRange;
}

void Pipeline::on_frame(std::size_t camera, hal::Frame frame) {
  if (!is_as_configured(frame->picture, plan_.formats[camera])) {
    on_fault(camera, {hal::Fault::WrongFormat, {}});
    return;
  }
  if (faults_[camera] != hal::Fault::None) on_fault(camera, {});
  {
    const std::lock_guard lock(camera_meters_[camera].mutex);
    camera_meters_[camera].meter.add(hal::Clock::now() - frame->metadata.exposure_start);
  }
  last_frames_[camera] = hal::Clock::now();
  sync_.put(camera, std::move(frame));
}

void Pipeline::on_fault(std::size_t camera, const hal::FaultReport& report) {
  if (faults_[camera].exchange(report.fault) == report.fault) return;
  if (report.fault != hal::Fault::None) {
    sync_.clear(camera);
    if (plan_.triggers[camera]) plan_.triggers[camera]->abandon();
  }
  log_line(report.fault == hal::Fault::None ? LogLevel::Info : LogLevel::Warning,
           plan_.cameras[camera]->info().id + ": " + std::string(operator_text(report.fault)) +
               (report.detail.empty() ? "" : " (" + report.detail + ")"));
}

void Pipeline::run() {
  while (!stopping_) {
    const auto set = sync_.next(hal::Clock::now() + kHeartbeatPeriod);
    if (stopping_) break;
    if (set) {
      process(*set);
    } else if (measurement_) {
      measurement_->idle(state() == SystemState::Fault);
    }
    publish_status();
  }
}

void Pipeline::process(const hal::FrameSet& set) {
  const auto begin = hal::Clock::now();
  for (Sink* sink : sinks_) sink->accept_frames(set);
  if (measurement_) {
    measurement_->process(set, workers_, [&](std::size_t view, const std::shared_ptr<View>& seen) {
      publish(view, seen);
    });
  }
  pan_tilt_zoom_.exchange(renderers_);
  const bool display_due = throttle_.is_due(set.id);
  for (std::size_t i = 0; i < renderers_.size(); ++i) {
    if (display_due) {
      show(i, set);
    } else {
      ++status_.views[i].skipped;
    }
  }
  status_.frame_set = set.id;
  status_.stamp = set.stamp;
  status_.trigger = set.trigger.value_or(0);
  status_.unmatched += set.matched ? 0 : 1;
  skew_of_second_ = std::max(skew_of_second_, set.skew);
  note_timing(hal::Clock::now() - begin);
}

void Pipeline::show(std::size_t index, const hal::FrameSet& set) {
  const auto view = pools_[index].acquire();
  if (view) {
    const auto& [renderer, pointing] = renderers_[index];
    renderer->render(set, *view, workers_);
    view->pointing = pointing;
  }
  publish(index, view);
}

/// Null: the sinks hold every buffer of it.
void Pipeline::publish(std::size_t index, const std::shared_ptr<View>& view) {
  ViewStatus& figures = status_.views[index];
  if (!view) {
    ++figures.skipped;
    return;
  }
  for (Sink* sink : sinks_) sink->accept(ViewPtr(view));
  ++figures.published;
  view_meters_[index].add(hal::Clock::now() - view->stamp);
}

hal::Clock::duration Pipeline::deadline() const {
  if (plan_.deadline.count() > 0) return plan_.deadline;
  const double rate = plan_.formats.front().frame_rate;
  if (!(rate > 0)) return std::chrono::seconds(1);
  return std::chrono::duration_cast<hal::Clock::duration>(std::chrono::duration<double>(1 / rate));
}

void Pipeline::note_timing(hal::Clock::duration took) {
  const double load =
      std::chrono::duration<double>(took) / std::chrono::duration<double>(deadline());
  load_of_second_ = std::max(load_of_second_, load);
  const bool overran = load > 1;
  if (overran && status_.overruns++ == 0) {
    log_line(LogLevel::Warning,
             "a frame set took longer than its deadline; display views slow down");
  }
  const double sets_per_second = 1 / std::chrono::duration<double>(deadline()).count();
  throttle_.note(overran, load < 0.5, sets_per_second);
}

SystemState Pipeline::state() const {
  std::size_t faulty = 0;
  for (std::size_t i = 0; i < plan_.cameras.size(); ++i) {
    faulty += faults_[i] != hal::Fault::None ? 1 : 0;
  }
  if (faulty == plan_.cameras.size()) return SystemState::Fault;
  if (status_.frame_set == 0) return SystemState::Starting;
  if (measurement_ && measurement_->is_stopped()) return SystemState::Stopped;
  return faulty > 0 ? SystemState::Degraded : SystemState::Running;
}

std::uint32_t Pipeline::process_inputs() const {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < plan_.process_inputs.size(); ++i) {
    bits |= (plan_.process_inputs[i]->state().active ? 1U : 0U) << i;
  }
  return bits;
}

void Pipeline::publish_status() {
  const auto now = hal::Clock::now();
  ++status_.heartbeat;
  status_.state = state();
  status_.selected_view = selected_view_;
  status_.process_inputs = process_inputs();
  if (plan_.health) status_.health = plan_.health(now);
  for (std::size_t i = 0; i < plan_.views.size(); ++i) {
    status_.views[i].superseded = pan_tilt_zoom_.superseded(i);
  }
  count_cameras();
  if (measurement_) {
    measurement_->watch(now, [this](const AlarmNotice& notice) { note(notice); });
    measurement_->report(status_);
  }
  if (now - last_roll_ >= std::chrono::seconds(1)) roll_figures(now);
  for (Sink* sink : sinks_) sink->accept(status_);
}

void Pipeline::note(const AlarmNotice& notice) {
  for (Sink* sink : sinks_) sink->note(notice);
}

void Pipeline::count_cameras() {
  for (std::size_t i = 0; i < plan_.cameras.size(); ++i) {
    const hal::FrameCounts counts = sync_.counts(i);
    CameraStatus& camera = status_.cameras[i];
    camera.fault = faults_[i];
    camera.frames = counts.frames;
    camera.lost = counts.lost;
    camera.dropped = counts.dropped();
    camera.unmatched = counts.unmatched;
    camera.last_frame = last_frames_[i];
    if (!plan_.triggers[i]) continue;
    const hal::TriggerCounts triggers = plan_.triggers[i]->counts();
    camera.triggers = triggers.triggers;
    camera.missed = triggers.missed;
  }
}

void Pipeline::roll_figures(hal::TimePoint now) {
  const auto elapsed = now - std::exchange(last_roll_, now);
  for (std::size_t i = 0; i < plan_.cameras.size(); ++i) {
    const std::lock_guard lock(camera_meters_[i].mutex);
    const auto figures = camera_meters_[i].meter.roll(elapsed);
    status_.cameras[i].frames_per_second = figures.per_second;
    status_.cameras[i].latency_p50_ms = figures.p50_ms;
    status_.cameras[i].latency_p99_ms = figures.p99_ms;
  }
  for (std::size_t i = 0; i < view_meters_.size(); ++i) {
    const auto figures = view_meters_[i].roll(elapsed);
    status_.views[i].frames_per_second = figures.per_second;
    status_.views[i].latency_p50_ms = figures.p50_ms;
    status_.views[i].latency_p99_ms = figures.p99_ms;
  }
  status_.load = std::exchange(load_of_second_, 0);
  status_.skew_ms = std::chrono::duration<double, std::milli>(
                        std::exchange(skew_of_second_, hal::Clock::duration::zero()))
                        .count();
}

}  // namespace orbwatch::app
