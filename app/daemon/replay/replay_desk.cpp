// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/replay/replay_desk.h"

#include <new>
#include <utility>

#include "app/daemon/replay/replay_findings.h"
#include "app/daemon/site/view_memory.h"
#include "app/health/system_file.h"
#include "app/log.h"
#include "app/ports/recorder/recorded_utc.h"

namespace orbwatch::app::daemon {
namespace {

/// Views need grids, too: a multiple of their buffers must be free.
constexpr std::uint64_t kMemoryFactor = 4;
constexpr std::uint64_t kReplayMebibyte = std::uint64_t{1} << 20;

tl::unexpected<Error> cancelled_replay() { return fail("cancelled"); }

std::string numbers_of(const RecipeTexts& recipes) {
  std::string text = "0";
  for (const auto& [number, recipe] : recipes) text += ", " + std::to_string(number);
  return text;
}

}  // namespace

std::uint64_t free_memory() { return memory_line("/proc/meminfo", "MemAvailable:").value_or(0); }

ReplayDesk::ReplayDesk(std::shared_ptr<RecordedEvents> events, RecipeTexts recipes,
                       ReplayLimits limits)
    : events_(std::move(events)), recipes_(std::move(recipes)), limits_(std::move(limits)) {}

void ReplayDesk::start() {
  if (thread_.is_running()) return;
  {
    const std::lock_guard lock(mutex_);
    is_started_ = true;
  }
  thread_.start("replays", hal::ThreadRole::Background, [this] { run(); });
}

void ReplayDesk::stop() {
  {
    const std::lock_guard lock(mutex_);
    is_started_ = false;
  }
  thread_.stop();
  const std::lock_guard lock(mutex_);
  job_.reset();
  finished_.reset();
  status_.state = ReplayState::None;
}

/// The recipe takes the place of all recorded ones, so that it measures every frame set.
Result<RecipeChoice> ReplayDesk::choice_of(std::uint16_t recipe) const {
  const auto chosen = recipes_.find(recipe);
  if (recipe != 0 && chosen == recipes_.end()) {
    return fail("recipe is " + std::to_string(recipe) + "; use one of: " + numbers_of(recipes_) +
                " (0: those in the recording)");
  }
  const std::string* const text = recipe == 0 ? nullptr : &chosen->second;
  return RecipeChoice([this, text](const files::Resolved& site) -> Result<OtherRecipes> {
    if (const auto fits = check_memory(site); !fits) return tl::unexpected(fits.error());
    OtherRecipes others;
    if (text == nullptr) return others;
    for (const files::RecipeFile& file : site.site.recipes) others[file.number] = *text;
    return others;
  });
}

Result<> ReplayDesk::check_memory(const files::Resolved& site) const {
  const std::uint64_t free = limits_.free_memory ? limits_.free_memory() : 0;
  const std::uint64_t needed = kMemoryFactor * view_memory(site);
  if (free == 0 || needed <= free) return {};
  return fail("the recording's views need " + std::to_string(needed / kReplayMebibyte) +
              " MiB of memory, " + std::to_string(free / kReplayMebibyte) +
              " MiB are free; replay it on another computer: orbwatch replay");
}

Result<std::uint64_t> ReplayDesk::begin(const ReplayRequest& request) {
  auto recording = events_->recording(request.event);
  if (!recording) return tl::unexpected(recording.error());
  auto choose = choice_of(request.recipe);
  if (!choose) return tl::unexpected(choose.error());
  const std::lock_guard lock(mutex_);
  if (!is_started_) return fail("nothing is replayed: the appliance is stopping");
  if (status_.state == ReplayState::Measuring) {
    return fail((status_.user.empty() ? "another replay" : "a replay of " + status_.user) +
                " is running; wait for it, or cancel it");
  }
  status_ = {status_.number + 1,
             ReplayState::Measuring,
             request.event,
             request.user,
             request.recipe,
             0,
             0,
             {}};
  job_ = Job{status_.number, request, std::move(*recording), std::move(*choose)};
  is_cancelled_ = false;
  finished_.reset();
  thread_.wake();
  return status_.number;
}

void ReplayDesk::run() {
  while (thread_.wait()) {
    if (const auto job = take_job()) end(measure(*job));
  }
}

std::optional<ReplayDesk::Job> ReplayDesk::take_job() {
  const std::lock_guard lock(mutex_);
  return std::exchange(job_, std::nullopt);
}

Result<std::shared_ptr<ReplayDesk::Finished>> ReplayDesk::measure(const Job& job) try {
  if (auto wanted = advance(0, 0); !wanted) return tl::unexpected(wanted.error());
  auto replay = Replay::open(job.recording, job.choose, 0);
  if (!replay) return tl::unexpected(replay.error());
  auto finished = std::make_shared<Finished>();
  finished->result.number = job.number;
  finished->result.event = job.request.event;
  finished->result.recipe = job.request.recipe;
  if (auto done = measure_sets(*replay, *finished); !done) return tl::unexpected(done.error());
  return finished;
} catch (const std::bad_alloc&) {
  return fail("not enough memory; replay the recording on another computer: orbwatch replay");
}

Result<> ReplayDesk::measure_sets(Replay& replay, Finished& finished) {
  const hal::TimePoint deadline = hal::Clock::now() + limits_.time;
  ReplayFindings findings(replay.jpeg_regions());
  ReplayResult& result = finished.result;
  std::uint64_t compared_from = 0;
  while (true) {
    if (auto wanted = advance(replay.done(), replay.of()); !wanted) return wanted;
    if (hal::Clock::now() >= deadline) {
      return fail("the replay takes too long; run orbwatch replay on another computer");
    }
    const auto set = replay.next();
    if (!set) return tl::unexpected(set.error());
    if (!*set) break;
    if (result.sets++ == 0) {
      compared_from = comparison_begin(**set, {});
      result.is_settled = replay.end() >= compared_from + (compared_from - (*set)->utc);
      if (!result.is_settled) compared_from = (*set)->utc;
    }
    if (auto added = finished.steps.add({(*set)->utc, (*set)->utc, (*set)->computed}); !added) {
      return added;
    }
    findings.add(**set, (*set)->utc >= compared_from);
  }
  findings.finish(result);
  result.without_pictures = replay.without_pictures();
  result.compared_from = recorder::utc_text_at(compared_from);
  if (result.sets > 0) return {};
  return fail("no frame set with pictures; " + std::to_string(result.without_pictures) +
              " without");
}

Result<> ReplayDesk::advance(std::uint64_t done, std::uint64_t of) {
  const std::lock_guard lock(mutex_);
  status_.done = done;
  status_.of = of;
  if (is_cancelled_ || thread_.stop_requested()) return cancelled_replay();
  return {};
}

void ReplayDesk::end(Result<std::shared_ptr<Finished>> finished) {
  std::string failure;
  {
    const std::lock_guard lock(mutex_);
    if (is_cancelled_ || !is_started_) {
      status_.state = ReplayState::None;
    } else if (finished) {
      finished_ = std::move(*finished);
      status_.state = ReplayState::Done;
    } else {
      status_.state = ReplayState::Failed;
      status_.error = finished.error().message;
      failure = status_.event + " is not replayed: " + status_.error;
    }
  }
  if (!failure.empty()) log_line(LogLevel::Warning, failure);
}

ReplayStatus ReplayDesk::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

Result<std::shared_ptr<const ReplayDesk::Finished>> ReplayDesk::finished(
    std::uint64_t number) const {
  const std::lock_guard lock(mutex_);
  if (finished_ && finished_->result.number == number) return finished_;
  return fail("there is no result of replay " + std::to_string(number) +
              "; it was cancelled, is not finished, or another one was begun");
}

Result<std::shared_ptr<const ReplayResult>> ReplayDesk::result(std::uint64_t number) const {
  return finished(number).map([](std::shared_ptr<const Finished> all) {
    const ReplayResult* const result = &all->result;
    return std::shared_ptr<const ReplayResult>(std::move(all), result);
  });
}

Result<RecordedCourse> ReplayDesk::course(std::uint64_t number, const std::string& region,
                                          const std::string& figure) const {
  const auto all = finished(number);
  if (!all) return tl::unexpected(all.error());
  return recorder::course_in((*all)->steps, region, figure);
}

Result<> ReplayDesk::cancel(std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  const bool is_measuring = status_.state == ReplayState::Measuring;
  if (number != status_.number || (!is_measuring && status_.state != ReplayState::Done)) {
    return fail("replay " + std::to_string(number) + " has ended");
  }
  is_cancelled_ = true;
  if (is_measuring) return {};
  finished_.reset();
  status_.state = ReplayState::None;
  return {};
}

}  // namespace orbwatch::app::daemon
