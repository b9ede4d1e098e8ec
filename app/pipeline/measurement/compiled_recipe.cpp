// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/measurement/compiled_recipe.h"

#include <algorithm>
#include <utility>

namespace orbwatch::app::pipeline {
namespace {

Quality quality_of(const signals::Radiometry& radiometry) {
  const bool apparent = radiometry.is_radiometric() && radiometry.is_apparent();
  return apparent ? Quality::Apparent : Quality::Good;
}

/// True if the direction is outside the blind cone and inside the picture.
bool sees(const ViewSource& source, const optics::Vec3& direction) {
  const auto pixel = source.ball.pixel(direction);
  return pixel && pixel->u >= 0 && pixel->u <= source.format.width - 1 && pixel->v >= 0 &&
         pixel->v <= source.format.height - 1;
}

/// True if the set has the frame, and it does not belong to another trigger, which would show
/// another part.
bool is_of_trigger(const hal::FrameSet& set, const hal::Frame& frame) {
  if (!frame) return false;
  const auto& trigger = frame->metadata.trigger;
  return !set.trigger || !trigger || *trigger == *set.trigger;
}

/// Calls RegionMeter::make or RegionMeter::check for a region: `call` with the arguments that both
/// have, and `further` ones.
template <class T, class... Further>
Result<T> for_region(const RecipePlan& plan, const RegionPlan& region,
                     const signals::RegionScene& scene,
                     Result<T> (*call)(const optics::ViewProjection&, const signals::RegionScene&,
                                       const signals::RegionSettings&,
                                       const signals::RegionMask::Sees&, Further...),
                     const Further&... further) {
  const ViewPlan& view = plan.views[region.view];
  const ViewSource& measured = view.sources[*view.measured];
  auto result = call(
      view.projection, scene, region.settings,
      [&measured](const auto& to) { return sees(measured, to); }, further...);
  if (!result) return fail("region " + region.name + ": " + result.error().message);
  return result;
}

Result<signals::AlarmBoard> make_board(const RecipePlan& plan) {
  return signals::AlarmBoard::make(plan.alarms, plan.regions.size());
}

}  // namespace

Result<std::unique_ptr<CompiledRecipe>> CompiledRecipe::make(RecipePlan plan,
                                                             const signals::RegionScene& scene) {
  std::unique_ptr<CompiledRecipe> recipe(new CompiledRecipe(std::move(plan)));
  // Regions are measured one after another.
  const auto memory = std::make_shared<signals::SearchMemory>();
  for (const RegionPlan& region : recipe->plan_.regions) {
    auto meter = for_region(recipe->plan_, region, scene, signals::RegionMeter::make, memory);
    if (!meter) return tl::unexpected(meter.error());
    const Quality quality = quality_of(meter->radiometry());
    recipe->meters_.push_back({std::move(*meter), region.view, quality});
  }
  auto board = make_board(recipe->plan_);
  if (!board) return tl::unexpected(board.error());
  recipe->fresh_board_ = *board;
  for (const ViewPlan& view : recipe->plan_.views) recipe->views_.emplace_back(view);
  recipe->frames_.resize(recipe->views_.size());
  recipe->begin();
  return recipe;
}

Result<> CompiledRecipe::check(const RecipePlan& plan, const signals::RegionScene& scene) {
  for (const RegionPlan& region : plan.regions) {
    if (const auto checked = for_region(plan, region, scene, signals::RegionMeter::check);
        !checked) {
      return checked;
    }
  }
  return make_board(plan).map([](const signals::AlarmBoard&) {});
}

void CompiledRecipe::begin() {
  for (Region& region : meters_) region.meter.reset();
  skip();
  board_ = fresh_board_;
  for (std::size_t i = 0; i < board_.size(); ++i) {
    const signals::AlarmLimits& limits = board_.limits(i);
    alarms_[i] = {{},
                  static_cast<std::uint16_t>(limits.region),
                  static_cast<SignalNumber>(limits.signal),
                  signals::kNotValid,
                  {}};
  }
}

void CompiledRecipe::continue_alarms(const CompiledRecipe& other) {
  board_ = other.board_;
  alarms_ = other.alarms_;
}

void CompiledRecipe::render(const hal::FrameSet& set, const FramePyramids& pyramids,
                            ViewBuffers& buffers, WorkerPool& workers) {
  for (std::size_t n = 0; n < views_.size(); ++n) {
    const View& view = views_[n].measure(set, pyramids, buffers, workers);
    const ViewPlan& plan = plan_.views[n];
    const std::size_t camera = plan.sources[*plan.measured].camera;
    const bool is_measurable = is_of_trigger(set, set.frames[camera]);
    frames_[n].view = is_measurable ? &view : nullptr;
    if (is_measurable) {
      frames_[n].exposed = set.frames[camera]->metadata.exposure_start;
      frames_[n].controls_as_of = set.frames[camera]->metadata.controls_as_of;
    }
    frames_[n].held = set.held[camera];
  }
}

void CompiledRecipe::measure(hal::TimePoint set_since) {
  for (std::size_t i = 0; i < meters_.size(); ++i) {
    auto& [meter, n, quality] = meters_[i];
    const auto& [view, exposed, controls_as_of, held] = frames_[n];
    const bool is_measurable = view && controls_as_of >= set_since;
    if (is_measurable && held && regions_[i].quality != Quality::NotMeasured) continue;
    stale_[i] = false;
    regions_[i] = {};
    if (!is_measurable) continue;
    const double seconds = std::chrono::duration<double>(exposed.time_since_epoch()).count();
    regions_[i].quality = quality;
    regions_[i].signals = view->radiometric.empty()
                              ? meter.measure(view->luminance, view->validity, seconds)
                              : meter.measure(view->radiometric, view->validity, seconds);
  }
}

bool CompiledRecipe::is_set(hal::TimePoint set_since) const {
  return std::ranges::all_of(frames_, [set_since](const MeasuredFrame& frame) {
    return !frame.view || frame.controls_as_of >= set_since;
  });
}

bool CompiledRecipe::is_exposed_since(hal::TimePoint moment) const {
  return std::ranges::all_of(frames_, [moment](const MeasuredFrame& frame) {
    return !frame.view || frame.exposed >= moment;
  });
}

void CompiledRecipe::skip_exposed_before(hal::TimePoint moment) {
  for (std::size_t i = 0; i < meters_.size(); ++i) {
    if (frames_[meters_[i].view].exposed < moment) regions_[i] = {};
  }
}

void CompiledRecipe::skip() { regions_.fill({}); }

std::optional<bool> CompiledRecipe::has_hot_spot() const {
  const auto shows = [](const RegionStatus& region) { return region.signals.hot_spot_present > 0; };
  if (std::ranges::any_of(regions(), shows)) return true;
  if (std::ranges::count(regions(), Quality::NotMeasured, &RegionStatus::quality) > 0) return {};
  return false;
}

std::span<const signals::AlarmEvent> CompiledRecipe::watch(hal::TimePoint now, bool process_active,
                                                           const signals::AlarmSet& acknowledged) {
  for (std::size_t i = 0; i < meters_.size(); ++i) signals_[i] = regions_[i].signals;
  const auto events = board_.step({now.time_since_epoch(),
                                   {signals_.data(), meters_.size()},
                                   process_active,
                                   acknowledged,
                                   stale_});
  stale_.set();
  for (std::size_t i = 0; i < board_.size(); ++i) {
    AlarmStatus& alarm = alarms_[i];
    if (alarm.alarm.state != board_.alarm(i).state) alarm.since = now;
    alarm.alarm = board_.alarm(i);
    alarm.value =
        signals_[alarm.region].*signals::kSignals[static_cast<std::size_t>(alarm.signal)].member;
  }
  return events;
}

}  // namespace orbwatch::app::pipeline
