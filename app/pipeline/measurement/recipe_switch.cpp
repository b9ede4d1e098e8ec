// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/measurement/recipe_switch.h"

#include <utility>

#include "app/log.h"

namespace orbwatch::app::pipeline {

RecipeSwitch::RecipeSwitch(std::size_t first, Apply apply)
    : apply_(std::move(apply)), set_to_(first) {
  current_.recipe = first;
}

RecipeSwitch::~RecipeSwitch() { stop(); }

void RecipeSwitch::start() {
  if (apply_) thread_.start("recipe", [this] { run(); });
}

void RecipeSwitch::stop() { thread_.stop(); }

void RecipeSwitch::request(std::size_t recipe) {
  {
    const std::lock_guard lock(mutex_);
    const auto now = hal::Clock::now();
    if (!changing_) changing_ = now;
    refusal_.reset();
    pending_.reset();
    if (apply_) {
      requested_ = recipe;
    } else {
      pending_ = Pending{{recipe}, now};
    }
  }
  thread_.wake();
}

std::optional<RecipeSwitch::Selection> RecipeSwitch::selection_at(hal::TimePoint stamp) {
  const std::lock_guard lock(mutex_);
  if (pending_ && stamp >= pending_->from) {
    current_ = pending_->selection;
    current_from_ = pending_->from;
    pending_.reset();
    changing_.reset();
  }
  const bool is_between = changing_ && stamp >= *changing_;
  return is_between || stamp < current_from_ ? std::nullopt : std::optional(current_);
}

std::optional<RecipeSwitch::Refusal> RecipeSwitch::refusal() const {
  const std::lock_guard lock(mutex_);
  return refusal_;
}

void RecipeSwitch::run() {
  while (thread_.wait()) {
    std::optional<std::size_t> wanted;
    {
      const std::lock_guard lock(mutex_);
      wanted = std::exchange(requested_, std::nullopt);
    }
    if (wanted) change(*wanted);
  }
}

void RecipeSwitch::change(std::size_t wanted) {
  const auto done = apply_(wanted);
  if (done) {
    set_to_ = wanted;
  } else {
    log_line(LogLevel::Error, done.error().message + "; the previous recipe stays selected");
    if (const auto back = apply_(set_to_); !back) log_line(LogLevel::Error, back.error().message);
  }
  const auto from = hal::Clock::now();
  const std::lock_guard lock(mutex_);
  ++changes_;
  if (requested_) return;  // the next change decides
  if (!done) refusal_ = Refusal{wanted, set_to_};
  pending_ = Pending{{set_to_, from, changes_}, from};
}

}  // namespace orbwatch::app::pipeline
