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
      view_meters_(plan_.views.size()) {
  for (const ViewPlan& view : plan_.views) {
    auto renderer = std::make_unique<ViewRenderer>(view);
    std::vector<std::unique_ptr<View>> buffers;
    for (std::size_t i = 0; i < plan_.view_buffers; ++i) {
      buffers.push_back(std::make_unique<View>(renderer->make_view()));
      buffers.back()->name = view.name;  // the renderer's own copy goes when the view is pointed
    }
    renderers_.push_back({std::move(renderer), 0});
    pools_.emplace_back(std::move(buffers));
  }
  for (std::size_t i = 0; i < renderers_.size(); ++i) order_.push_back(i);
  if (plan_.measurement) {
    detector_.emplace(plan_.views[plan_.measurement->view].projection);
    unshared_ = renderers_[plan_.measurement->view].renderer->make_view();
    std::swap(order_[0], order_[plan_.measurement->view]);
  }
  plan_.triggers.resize(plan_.cameras.size());
  for (std::size_t i = 0; i < plan_.cameras.size(); ++i) {
    if (plan_.triggers[i]) plan_.cameras[i]->set_gate(stamp_with(plan_.triggers[i]));
  }
  status_.camera_count = plan_.cameras.size();
  status_.view_count = plan_.views.size();
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
}

CommandResult Pipeline::command(const Command& command) {
  if (command.code != CommandCode::SelectView) return CommandResult::UnknownCommand;
  if (command.argument < 0 || command.argument >= static_cast<int>(plan_.views.size())) {
    return CommandResult::ArgumentOutOfRange;
  }
  selected_view_ = static_cast<std::size_t>(command.argument);
  return CommandResult::Done;
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
    if (set) process(*set);
    publish_status();
  }
}

void Pipeline::process(const hal::FrameSet& set) {
  const auto begin = hal::Clock::now();
  const bool display_due = throttle_.is_due(set.id);
  pan_tilt_zoom_.exchange(renderers_);
  for (const std::size_t i : order_) {
    if (!is_measured(i) && !display_due) {
      ++status_.views[i].skipped;
    } else {
      make_view(i, set);
    }
  }
  status_.frame_set = set.id;
  status_.stamp = set.stamp;
  status_.trigger = set.trigger.value_or(0);
  status_.unmatched += set.matched ? 0 : 1;
  skew_of_second_ = std::max(skew_of_second_, set.skew);
  note_timing(hal::Clock::now() - begin);
}

void Pipeline::make_view(std::size_t index, const hal::FrameSet& set) {
  ViewStatus& figures = status_.views[index];
  const auto shared = pools_[index].acquire();
  if (!shared) {
    ++figures.skipped;
    if (!is_measured(index)) return;
  }
  View& view = shared ? *shared : *unshared_;
  const auto& [renderer, pointing] = renderers_[index];
  renderer->render(set, view, workers_);
  view.pointing = pointing;
  if (is_measured(index)) measure(view, renderer->is_measured());
  if (!shared) return;
  for (Sink* sink : sinks_) sink->accept(ViewPtr(shared));
  ++figures.published;
  view_meters_[index].add(hal::Clock::now() - set.stamp);
}

void Pipeline::measure(const View& view, bool delivered) {
  if (!delivered) {
    status_.signals = {};
    return;
  }
  const MeasurementPlan& plan = *plan_.measurement;
  const bool wide = !view.radiometric.empty();
  const signals::HotSpot spot =
      wide ? detector_->measure(view.radiometric, view.validity, plan.threshold)
           : detector_->measure(view.luminance, view.validity, plan.threshold);
  const double full_scale =
      wide ? std::numeric_limits<std::uint16_t>::max() : std::numeric_limits<std::uint8_t>::max();
  status_.signals = signals::hot_spot_signals(spot, plan.scale, full_scale);
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
  for (std::size_t i = 0; i < plan_.views.size(); ++i) {
    status_.views[i].superseded = pan_tilt_zoom_.superseded(i);
  }
  for (std::size_t i = 0; i < plan_.cameras.size(); ++i) {
    const hal::FrameCounts counts = sync_.counts(i);
    CameraStatus& camera = status_.cameras[i];
    camera.fault = faults_[i];
    camera.frames = counts.frames;
    camera.lost = counts.lost;
    camera.dropped = counts.dropped();
    camera.unmatched = counts.unmatched;
    if (!plan_.triggers[i]) continue;
    const hal::TriggerCounts triggers = plan_.triggers[i]->counts();
    camera.triggers = triggers.triggers;
    camera.missed = triggers.missed;
  }
  if (status_.state == SystemState::Fault) status_.signals = {};
  if (now - last_roll_ >= std::chrono::seconds(1)) roll_figures(now);
  for (Sink* sink : sinks_) sink->accept(status_);
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
