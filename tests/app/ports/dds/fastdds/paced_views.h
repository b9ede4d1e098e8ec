// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "app/model/sink/sink.h"
#include "tests/app/hand_over.h"
#include "tests/app/ports/dds/fastdds/pace.h"

namespace orbwatch::app::tests {

/// Passes views in turn, each with the status of its frame set.
class PacedViews final : public Pace {
 public:
  PacedViews(Sink& sink, std::vector<std::shared_ptr<View>> views)
      : sink_(sink), views_(std::move(views)) {}

  /// Returns whether the sink has released all views, so that its counts are complete.
  bool all_returned() const {
    return std::ranges::all_of(views_, [](const auto& view) { return view.use_count() == 1; });
  }

 private:
  void hand_over_now(std::uint64_t number) override {
    const auto& view = views_[number % views_.size()];
    view->stamp = hal::Clock::now();
    tests::hand_over(sink_, view);
    status_.frame_set = number;
    status_.stamp = view->stamp;
    sink_.accept(status_);
  }

  Sink& sink_;
  const std::vector<std::shared_ptr<View>> views_;
  Status status_;
};

}  // namespace orbwatch::app::tests
