#include "app/pipeline/recipe_switch.h"

#include <utility>

#include "app/log.h"

namespace orbwatch::app {

RecipeSwitch::RecipeSwitch(std::size_t first, Apply apply) : apply_(std::move(apply)) {
  current_.recipe = first;
  if (apply_) thread_ = std::thread([this, first] { run(first); });
}

RecipeSwitch::~RecipeSwitch() { stop(); }

void RecipeSwitch::request(std::size_t recipe) {
  {
    const std::lock_guard lock(mutex_);
    const auto now = hal::Clock::now();
    if (!changing_) changing_ = now;
    failed_ = false;
    due_.reset();
    if (apply_) {
      requested_ = recipe;
    } else {
      due_ = Due{{recipe}, now};
    }
  }
  work_.notify_one();
}

std::optional<RecipeSwitch::Selection> RecipeSwitch::of(hal::TimePoint stamp) {
  const std::lock_guard lock(mutex_);
  if (due_ && stamp >= due_->from) {
    current_ = due_->selection;
    current_from_ = due_->from;
    due_.reset();
    changing_.reset();
  }
  const bool between = changing_ && stamp >= *changing_;
  return between || stamp < current_from_ ? std::nullopt : std::optional(current_);
}

bool RecipeSwitch::has_failed() const {
  const std::lock_guard lock(mutex_);
  return failed_;
}

void RecipeSwitch::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  work_.notify_one();
  if (thread_.joinable()) thread_.join();
}

/// `set_to`: the recipe that the cameras are set to.
void RecipeSwitch::run(std::size_t set_to) {
  std::unique_lock lock(mutex_);
  while (true) {
    work_.wait(lock, [this] { return stopping_ || requested_; });
    if (stopping_) return;
    set_to = change(lock, set_to);
  }
}

/// The recipe that the cameras are set to then.
std::size_t RecipeSwitch::change(std::unique_lock<std::mutex>& lock, std::size_t set_to) {
  const std::size_t wanted = *std::exchange(requested_, std::nullopt);
  lock.unlock();
  const auto done = apply_(wanted);
  if (!done) {
    log_line(LogLevel::Error, done.error().message + "; the recipe before goes on");
    if (const auto back = apply_(set_to); !back) log_line(LogLevel::Error, back.error().message);
  }
  const std::size_t now_set_to = done ? wanted : set_to;
  const auto from = hal::Clock::now();
  lock.lock();
  ++changes_;
  if (!requested_) {
    failed_ = !done;
    due_ = Due{{now_set_to, from, changes_}, from};
  }
  return now_set_to;
}

}  // namespace orbwatch::app
