#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "app/pipeline/sink.h"

namespace orbwatch::app::tests {

/// Stands where the pipeline stands: hands views over at a camera's pace and counts how often the
/// sink made it wait. A thread that waits for a lock, a socket or anything else gives its processor
/// up of its own accord; the system counts that per thread, and here nothing else does it.
class PacedViews {
 public:
  static constexpr auto kPeriod = std::chrono::milliseconds(33);

  PacedViews(Sink& sink, std::vector<std::shared_ptr<View>> views)
      : sink_(sink), views_(std::move(views)), due_(std::chrono::steady_clock::now()) {}

  /// Waits until the next view is due, then hands it and the status of its frame set over.
  void hand_over() {
    std::this_thread::sleep_until(due_);
    due_ += kPeriod;
    const auto& view = views_[accepted_++ % views_.size()];
    view->stamp = hal::Clock::now();
    const auto before = given_up();
    const auto begin = std::chrono::steady_clock::now();
    sink_.accept(view);
    status_.frame_set = accepted_;
    status_.stamp = view->stamp;
    sink_.accept(status_);
    if (given_up() == before) return;
    ++waits_;
    longest_wait_ = std::max<std::chrono::duration<double, std::milli>>(
        longest_wait_, std::chrono::steady_clock::now() - begin);
  }
  void hand_over(int count) {
    for (int i = 0; i < count; ++i) hand_over();
  }

  /// Begins a new pace now, instead of catching up.
  void restart() { due_ = std::chrono::steady_clock::now(); }

  std::uint64_t accepted() const { return accepted_; }
  /// Of all hand-overs, those that waited.
  std::uint64_t waits() const { return waits_; }
  double longest_wait_ms() const { return longest_wait_.count(); }

  /// Whether the sink has let go of all views, so that its counts are complete.
  bool all_returned() const {
    return std::ranges::all_of(views_, [](const auto& view) { return view.use_count() == 1; });
  }

 private:
  static std::uint64_t given_up() {
    rusage usage{};
    getrusage(RUSAGE_THREAD, &usage);
    return static_cast<std::uint64_t>(usage.ru_nvcsw);
  }

  Sink& sink_;
  std::vector<std::shared_ptr<View>> views_;
  Status status_;
  std::chrono::steady_clock::time_point due_;
  std::uint64_t accepted_ = 0;
  std::uint64_t waits_ = 0;
  std::chrono::duration<double, std::milli> longest_wait_{0};
};

}  // namespace orbwatch::app::tests
