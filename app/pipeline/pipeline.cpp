// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/pipeline.h"

#include <algorithm>
#include <stop_token>
#include <thread>
#include <utility>

#include "app/log.h"

namespace orbwatch::app::pipeline {
namespace {

/// Longest time from one status to the next: the PLC's heartbeat. Ten per second are promised; the
/// rest is for a processor that is busy.
constexpr std::chrono::milliseconds kHeartbeatPeriod{90};
/// Age of the newest status at which another one precedes the next picture, which may take as long
/// again.
constexpr std::chrono::milliseconds kPictureHeartbeat = kHeartbeatPeriod / 2;

/// Number of workers: with the pipeline's own thread they use all reserved cores, or leave one core
/// to sinks, drivers and other programs.
std::size_t worker_count(int asked, std::size_t reserved_cores) {
  if (asked >= 0) return static_cast<std::size_t>(asked);
  if (reserved_cores > 0) return reserved_cores - 1;
  return std::max(2U, std::thread::hardware_concurrency()) - 2;
}

/// Deadline of frame sets while the pacing camera's rate is unknown.
constexpr std::chrono::seconds kUnknownPeriod{1};

/// Sharpenings of all views, without areas.
PictureUses sharpenings_of(const std::vector<ViewPlan>& views) {
  PictureUses uses;
  for (const ViewPlan& view : views) {
    for (const ViewSource& source : view.sources) uses[source.camera].add(source.sharpness, {});
  }
  return uses;
}

/// All views by index.
std::vector<ViewPlan> all_views(const PipelinePlan& plan) {
  std::vector<ViewPlan> views = plan.views;
  for (const auto& recipe : plan.recipes) {
    views.insert(views.end(), recipe->plan().views.begin(), recipe->plan().views.end());
  }
  return views;
}

}  // namespace

Pipeline::Pipeline(PipelinePlan plan)
    : plan_(std::move(plan)),
      formats_(plan_.formats),
      views_(all_views(plan_)),
      cameras_(std::move(plan_.cameras), plan_.camera_names, plan_.formats, plan_.absent,
               plan_.triggers, plan_.sync),
      workers_(worker_count(plan_.workers, plan_.reserved_cores)),
      sharpenings_(sharpenings_of(views_)),
      pyramids_(plan_.formats, sharpenings_),
      exposures_(std::make_unique<ExposureMatch>(views_, plan_.background)),
      displays_(plan_.views.begin(), plan_.views.end()),
      pan_tilt_zoom_(plan_.views, plan_.background),
      colours_(views_, std::move(plan_.colour_maps)),
      budget_(plan_.deadline.count() > 0 ? plan_.deadline : kUnknownPeriod),
      view_meters_(plan_.view_count) {
  status_.camera_count = cameras_.size();
  status_.view_count = plan_.view_count;
  status_.configuration_checksum = plan_.configuration_checksum;
  if (!plan_.recipes.empty()) make_measurement();
  follow_pace();
}

void Pipeline::make_measurement() {
  std::vector<std::pair<std::uint16_t, std::vector<CameraControl>>> settings;  // controls by recipe
  bool sets_cameras = false;
  for (const auto& recipe : plan_.recipes) {
    settings.emplace_back(recipe->plan().number, recipe->plan().controls);
    sets_cameras = sets_cameras || !recipe->plan().controls.empty();
  }
  RecipeSwitch::Apply apply;
  if (sets_cameras) {
    apply = [this, settings](std::size_t n) {
      return cameras_.apply(settings[n].first, settings[n].second);
    };
  }
  measurement_.emplace(std::move(plan_.recipes), plan_.process_inputs, std::move(apply));
}

Pipeline::~Pipeline() { stop(); }

Result<> Pipeline::start(std::vector<Sink*> sinks) {
  sinks_ = std::move(sinks);
  KeptViews kept;
  for (const Sink* sink : sinks_) kept += sink->keeps();
  std::vector<ViewBuffers::Views> measured;
  if (measurement_) measured = measurement_->planned_views();
  buffers_.emplace(plan_.views, measured, kept);
  last_status_ = last_roll_ = hal::Clock::now();
  thread_.start("pipeline", hal::ThreadRole::Pipeline, [this] { run(); });
  auto started = cameras_.start();
  if (!started) {
    stop();
  } else if (measurement_) {
    measurement_->start();
  }
  return started;
}

void Pipeline::stop() {
  cameras_.stop();
  thread_.stop();
  pan_tilt_zoom_.stop();
  if (measurement_) measurement_->stop();
}

void Pipeline::run() {
  const std::stop_callback end_wait(thread_.stop_token(), [this] { cameras_.close(); });
  stages_.begin();
  while (true) {
    const auto set = cameras_.next(last_status_ + kHeartbeatPeriod);
    if (thread_.stop_requested()) return;
    exchange();
    if (set) {
      process(*set);
    } else {
      idle();
    }
    end_exchange();
  }
}

Result<> Pipeline::take_over(Recompiled recompiled) {
  for (auto& [view, sources] : recompiled.sources) {
    views_[view].sources = sources;
    colours_.adopt(view, sources);
    if (auto adopted = pan_tilt_zoom_.adopt(view, std::move(sources)); !adopted) return adopted;
  }
  formats_ = recompiled.formats;
  for (const auto& recipe : recompiled.recipes) {
    if (!recipe) continue;
    for (const ViewPlan& view : recipe->plan().views) {
      views_[view.index] = view;
      colours_.adopt(view.index, view.sources);
    }
  }
  FramePyramids pyramids(recompiled.formats, sharpenings_);
  Exchange exchange{std::move(pyramids), std::make_unique<ExposureMatch>(views_, plan_.background),
                    std::move(recompiled)};  // frees the replaced objects here
  std::unique_lock lock(exchanging_);
  exchange_ = &exchange;
  exchanged_.wait(lock, [this] { return exchange_ == nullptr; });
  return {};
}

/// Swaps in an exchange between two sets; allocates and frees nothing.
void Pipeline::exchange() {
  const std::lock_guard lock(exchanging_);
  if (!exchange_) return;
  std::swap(pyramids_, exchange_->pyramids);
  std::swap(exposures_, exchange_->exposures);
  std::swap(plan_.formats, exchange_->recompiled.formats);
  for (Sink* sink : sinks_) {
    for (std::size_t i = 0; i < plan_.formats.size(); ++i) sink->accept_format(i, plan_.formats[i]);
  }
  if (measurement_) measurement_->exchange(exchange_->recompiled.recipes);
  exchange_->is_in_use = true;
}

/// Ends an exchange: the replaced objects are no longer needed.
void Pipeline::end_exchange() {
  const std::lock_guard lock(exchanging_);
  if (!exchange_ || !exchange_->is_in_use) return;
  exchange_ = nullptr;
  exchanged_.notify_one();
}

/// Processes a frame set. What is measured comes first, and goes out before the pictures that
/// people look at are made; of these, measured views come with every set, display views slow down
/// under overload and give way to the next set.
void Pipeline::process(const hal::FrameSet& set) {
  const auto begin = hal::Clock::now();
  for (Sink* sink : sinks_) sink->accept_frames(set);
  apply_commands(set);
  stages_.end(Stage::Publication);  // includes heartbeats since the previous set

  measure(set);
  begin_status(set);
  publish_status();
  stages_.end(Stage::Publication);

  show(set);
  end_set(hal::Clock::now() - begin);
}

/// Applies commands, which take effect here, between two sets.
void Pipeline::apply_commands(const hal::FrameSet& set) {
  status_.selected_view = selected_view_;
  if (measurement_) measurement_->apply_commands(set.stamp);
  for (std::size_t i = 0; i < displays_.size(); ++i) {
    pan_tilt_zoom_.exchange(i, displays_[i].renderer());
  }
  exchange_colours(measured());
  exchange_colours(displays_);
}

/// Measures in planes without a picture. A camera's picture is halved once for all that sample it.
void Pipeline::measure(const hal::FrameSet& set) {
  PictureUses uses;
  for (const ViewChannel& view : measured()) view.add_measured_use(uses);
  pyramids_.build(set, uses, workers_);
  stages_.end(Stage::Halving, workers_.take_spent());
  if (!measurement_) return;
  measurement_->render(set, pyramids_, *buffers_, workers_);
  stages_.end(Stage::Views, workers_.take_spent());
  measurement_->measure(set);
  stages_.end(Stage::Measurement);
}

/// Makes and publishes the pictures that are read.
void Pipeline::show(const hal::FrameSet& set) {
  const bool is_due = budget_.is_display_due(set.id);
  ask_readers(measured(), set.stamp);
  PictureUses uses;
  for (const ViewChannel& view : measured()) view.add_use(uses);
  if (is_due) {
    ask_readers(displays_, set.stamp);
    for (const ViewChannel& view : displays_) view.add_use(uses);
  }
  pyramids_.extend(uses, workers_);
  match_exposures(set);
  stages_.end(Stage::Halving, workers_.take_spent());
  for (ViewChannel& view : measured()) {
    view.draw(pyramids_, workers_);
    stages_.end(Stage::Views, workers_.take_spent());
    publish(view);
  }
  show_displays(set, is_due);
}

/// Publishes a status between two pictures, if one is due. It is one more of the same set: alarms
/// and figures are the present ones, measurement, recipe and selected view stay.
void Pipeline::keep_heartbeat() {
  if (hal::Clock::now() - last_status_ >= kPictureHeartbeat) publish_status();
}

/// Renders the display views, beginning with the one whose turn it is, until the next set arrives:
/// measurements do not wait for pictures. At least one is rendered, so that every view gets a turn;
/// those left out are the first in the next set.
void Pipeline::show_displays(const hal::FrameSet& set, bool are_due) {
  std::size_t rendered = 0;
  for (std::size_t n = 0; n < displays_.size(); ++n) {
    ViewChannel& view = displays_[(first_display_ + n) % displays_.size()];
    if (are_due && rendered == n && (n == 0 || !cameras_.has_next())) {
      view.render(set, pyramids_, *buffers_, workers_);
      ++rendered;
    }
    stages_.end(Stage::Views, workers_.take_spent());
    publish(view);
  }
  if (rendered > 0) first_display_ = (first_display_ + rendered) % displays_.size();
}

/// Views of the recipe that is measured.
std::span<ViewChannel> Pipeline::measured() {
  return measurement_ ? measurement_->views() : std::span<ViewChannel>();
}

void Pipeline::match_exposures(const hal::FrameSet& set) {
  exposures_->follow(set, pyramids_, workers_);
  for (std::size_t i = 0; i < plan_.formats.size(); ++i) {
    pyramids_.set_match(i, exposures_->table(i));
  }
}

void Pipeline::exchange_colours(std::span<ViewChannel> views) {
  for (ViewChannel& view : views) view.set_colours(colours_.exchange(view.plan().index));
}

/// Queries the readers, so that a view is made in the formats in which it is read.
void Pipeline::ask_readers(std::span<ViewChannel> views, hal::TimePoint stamp) {
  for (ViewChannel& view : views) {
    PictureNeeds needs;
    for (Sink* sink : sinks_) needs |= sink->needs(view.plan().index, stamp);
    const optics::ViewProjection& projection = view.plan().projection;
    view.set_reading(format_for(needs, projection.width(), projection.height()), needs.counts);
  }
}

/// Replaces process() when there is no set.
void Pipeline::idle() {
  status_.selected_view = selected_view_;
  if (measurement_) {
    measurement_->apply_commands(hal::Clock::now());
    measurement_->idle(cameras_.faulty() + cameras_.late() == cameras_.size());
  }
  if (plan_.machine) status_.machine = plan_.machine(hal::Clock::now(), nullptr);
  publish_status();
}

/// Forwards the view that was rendered last; it counts as skipped if there is none, because it was
/// not due, gave way to the next set, or the sinks hold every buffer of its size.
void Pipeline::publish(ViewChannel& channel) {
  const std::size_t index = channel.plan().index;
  const ViewPtr view = channel.take();
  if (view) {
    for (Sink* sink : sinks_) sink->accept(view);
    ++status_.views[index].published;
    view_meters_[index].add(hal::Clock::now() - view->stamp);
  } else {
    ++status_.views[index].skipped;
  }
  keep_heartbeat();
  stages_.end(Stage::Publication);
}

void Pipeline::begin_status(const hal::FrameSet& set) {
  status_.frame_set = set.id;
  status_.stamp = set.stamp;
  status_.trigger = set.trigger.value_or(0);
  status_.unmatched += set.matched ? 0 : 1;
  largest_skew_ = std::max(largest_skew_, set.skew);
  if (plan_.machine) status_.machine = plan_.machine(hal::Clock::now(), &set);
}

void Pipeline::end_set(hal::Clock::duration spent) {
  std::chrono::nanoseconds sinks{0};
  for (const Sink* sink : sinks_) sinks += sink->cpu_time();
  stages_.end_set(cameras_.capture_time(), sinks);
  if (budget_.add(spent) && budget_.overruns() == 1) {
    log_soon(LogLevel::Warning,
             {"a frame set took longer than its deadline; display views slow down"},
             {.trigger = status_.trigger});
  }
}

/// Steps the alarms, whose notices precede the status that shows them, and publishes the status.
void Pipeline::publish_status() {
  const auto now = hal::Clock::now();
  last_status_ = now;
  if (measurement_) {
    measurement_->watch(now, [this](AlarmNotice notice) {
      notice.part = status_.machine.part;
      notice.layer = status_.machine.values.layer;
      for (Sink* sink : sinks_) sink->accept_event(notice);
    });
    measurement_->report(status_);
  }
  ++status_.heartbeat;
  status_.state = state();
  report_process_inputs();
  status_.overruns = budget_.overruns();
  if (plan_.surroundings) {
    const Surroundings surroundings = plan_.surroundings(now);
    status_.health = surroundings.health;
    status_.line_faults = surroundings.line_faults;
    status_.interface_faults = surroundings.interface_faults;
    status_.realtime = surroundings.realtime;
    status_.memory_locked = surroundings.memory_locked;
    status_.configuration_refused = surroundings.configuration_refused;
    status_.trial_left = surroundings.trial_left;
    for (std::size_t i = 0; i < cameras_.size(); ++i) {
      static_cast<CameraWatchStatus&>(status_.cameras[i]) = surroundings.watched[i];
    }
  }
  for (std::size_t i = 0; i < displays_.size(); ++i) {
    status_.views[i].superseded = pan_tilt_zoom_.superseded(i);
  }
  const bool is_second_over = now - last_roll_ >= std::chrono::seconds(1);
  std::optional<hal::Clock::duration> elapsed;
  if (is_second_over) elapsed = now - std::exchange(last_roll_, now);
  cameras_.report(status_, elapsed);
  report_live_views();
  stages_.report(status_);
  if (elapsed) roll_rates(*elapsed);
  for (Sink* sink : sinks_) sink->accept(status_);
}

void Pipeline::roll_rates(hal::Clock::duration elapsed) {
  for (std::size_t i = 0; i < view_meters_.size(); ++i) {
    view_meters_[i].roll(elapsed, status_.views[i]);
  }
  stages_.roll(elapsed, status_);
  status_.load = budget_.roll_load();
  follow_pace();
  const auto skew = std::exchange(largest_skew_, hal::Clock::duration::zero());
  status_.skew_ms = std::chrono::duration<double, std::milli>(skew).count();
}

void Pipeline::report_live_views() {
  for (std::size_t i = 0; i < plan_.view_count; ++i) status_.views[i].live = false;
  const auto report = [this](const ViewChannel& view) {
    status_.views[view.plan().index].live =
        std::ranges::any_of(view.plan().sources, [this](const ViewSource& source) {
          return status_.cameras[source.camera].fault == hal::Fault::None;
        });
  };
  std::ranges::for_each(displays_, report);
  if (measurement_) std::ranges::for_each(measurement_->views(), report);
}

/// Sets the deadline from the pacing camera; a camera that states no rate has the one at which its
/// frames arrive, processed or not.
void Pipeline::follow_pace() {
  if (plan_.deadline.count() > 0) return;
  const std::size_t camera = cameras_.pacing_camera();
  const double stated = plan_.formats[camera].frame_rate;
  const double rate = stated > 0 ? stated : status_.cameras[camera].frames_per_second;
  if (rate > 0) budget_.set_deadline(hal::period_of(rate));
}

void Pipeline::report_process_inputs() {
  status_.process_inputs = 0;
  status_.process_inputs_known = 0;
  for (std::size_t i = 0; i < plan_.process_inputs.size(); ++i) {
    const std::optional<bool> active = plan_.process_inputs[i]->active();
    status_.process_inputs |= (active.value_or(false) ? 1U : 0U) << i;
    status_.process_inputs_known |= (active ? 1U : 0U) << i;
    status_.process_input_edges[i] = plan_.process_inputs[i]->edges();
  }
}

SystemState Pipeline::state() const {
  const std::size_t faulty = cameras_.faulty();
  if (faulty == cameras_.size()) return SystemState::Fault;
  if (status_.frame_set == 0) return SystemState::Starting;
  if (measurement_ && measurement_->is_paused()) return SystemState::Stopped;
  return faulty + cameras_.late() > 0 ? SystemState::Degraded : SystemState::Running;
}

CommandResult Pipeline::select_view(std::size_t view) {
  if (view >= plan_.view_count) return CommandResult::ArgumentOutOfRange;
  selected_view_ = view;
  return CommandResult::Done;
}

/// Refuses the views of recipes, which cannot be pointed, so that no operator changes a
/// measurement.
CommandResult Pipeline::check_display_view(std::size_t view) const {
  if (view >= plan_.view_count) return CommandResult::ArgumentOutOfRange;
  return view < plan_.views.size() ? CommandResult::Done : CommandResult::NotPossible;
}

CommandResult Pipeline::point_view(std::size_t view, double yaw, double pitch, double h_fov) {
  if (const auto checked = check_display_view(view); checked != CommandResult::Done) return checked;
  return pan_tilt_zoom_.turn(view, yaw, pitch, h_fov) ? CommandResult::Done
                                                      : CommandResult::ArgumentOutOfRange;
}

CommandResult Pipeline::mix_sources(std::size_t view, std::size_t source, double weight) {
  if (const auto checked = check_display_view(view); checked != CommandResult::Done) return checked;
  return pan_tilt_zoom_.mix(view, source, weight) ? CommandResult::Done
                                                  : CommandResult::ArgumentOutOfRange;
}

CommandResult Pipeline::start_measuring() {
  return measurement_ ? measurement_->resume() : CommandResult::NotPossible;
}

CommandResult Pipeline::stop_measuring() {
  return measurement_ ? measurement_->pause() : CommandResult::NotPossible;
}

CommandResult Pipeline::select_recipe(std::size_t number) {
  return measurement_ ? measurement_->select_recipe(number) : CommandResult::NotPossible;
}

CommandResult Pipeline::trigger() {
  return measurement_ ? measurement_->trigger() : CommandResult::NotPossible;
}

CommandResult Pipeline::acknowledge_alarm(std::size_t number, const Giver& by) {
  return measurement_ ? measurement_->acknowledge_alarm(number, by) : CommandResult::NotPossible;
}

CommandResult Pipeline::set_process_active(bool active) {
  return measurement_ ? measurement_->set_process_active(active) : CommandResult::NotPossible;
}

}  // namespace orbwatch::app::pipeline
