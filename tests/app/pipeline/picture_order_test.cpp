// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/pipeline/pipeline.h"
#include "tests/app/pipeline/hand_camera.h"
#include "tests/app/pipeline/measurement/measured_recipe.h"
#include "tests/app/pipeline/views/thermal_view.h"

namespace orbwatch::app::pipeline {
namespace {

/// Lists what the pipeline publishes, each with the number of its frame set.
class ListingSink : public Sink {
 public:
  Result<> start() override { return {}; }
  void stop() override {}
  PictureNeeds needs(std::size_t, hal::TimePoint) override { return need_of(PixelFormat::Rgb); }
  KeptViews keeps() const override { return {1, 1}; }
  void accept(const ViewPtr& view) override {
    add(std::string(view->name), view->frame_set);
    if (on_view) on_view(*view);
  }
  void accept(const Status& status) override {
    if (status.frame_set == 0) return;
    const bool is_first = std::exchange(reported_, status.frame_set) != status.frame_set;
    if (!is_first && !lists_heartbeats) return;
    add(is_first ? "status" : "heartbeat", status.frame_set);
    const std::lock_guard lock(mutex_);
    selected_.push_back(status.selected_view);
  }
  /// The first `count` publications, once they have come.
  std::vector<std::string> first(std::size_t count) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, std::chrono::seconds(30),
                                  [&] { return published_.size() >= count; }));
    return {published_.begin(),
            published_.begin() + static_cast<std::ptrdiff_t>(std::min(count, published_.size()))};
  }

  /// The selected view of each status that is listed.
  std::vector<std::size_t> selected() {
    const std::lock_guard lock(mutex_);
    return selected_;
  }

  bool lists_heartbeats = false;             ///< lists further statuses of a set, too
  std::function<void(const View&)> on_view;  ///< on the pipeline's thread; set before it starts

 private:
  void add(const std::string& what, std::uint64_t frame_set) {
    const std::lock_guard lock(mutex_);
    published_.push_back(what + " " + std::to_string(frame_set));
    changed_.notify_all();
  }

  std::uint64_t reported_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::string> published_;
  std::vector<std::size_t> selected_;
};

/// Three display views and a measured one.
class PictureOrder : public testing::Test {
 protected:
  void start() {
    PipelinePlan plan;
    auto hand = std::make_unique<HandCamera>("thermal", PixelFormat::Y16);
    camera = hand.get();
    plan.formats.push_back(hand->configure({}).value());
    plan.cameras.push_back(std::move(hand));
    plan.deadline = std::chrono::seconds(20);  // else a busy machine leaves out pictures
    plan.workers = 0;
    plan.views = {thermal_view(0, "a"), thermal_view(1, "b"), thermal_view(2, "c")};
    plan.recipes.push_back(compiled(recipe_plan(thermal_view(3, "measured"), 30000, 0.04)));
    plan.view_count = 4;
    pipeline.emplace(std::move(plan));
    ASSERT_TRUE(pipeline->start({&sink}));
    camera->expose(40000);
  }

  ListingSink sink;  // outlives the pipeline
  HandCamera* camera = nullptr;
  std::optional<Pipeline> pipeline;
};

using Published = std::vector<std::string>;

TEST_F(PictureOrder, PicturesFollowTheStatusOfTheirSet) {
  start();
  EXPECT_EQ(sink.first(5), (Published{"status 1", "measured 1", "a 1", "b 1", "c 1"}));
  camera->expose(40000);
  EXPECT_EQ(sink.first(10).back(), "c 2") << "the order stays";
}

TEST_F(PictureOrder, ASetThatArrivesMeanwhileIsMeasuredBeforeTheRemainingPictures) {
  sink.on_view = [&](const View& view) {
    if (view.name == "a" && view.frame_set == 1) camera->expose(40000);
  };
  start();
  EXPECT_EQ(sink.first(8), (Published{"status 1", "measured 1", "a 1", "status 2", "measured 2",
                                      "b 2", "c 2", "a 2"}));
}

TEST_F(PictureOrder, EveryViewGetsItsTurnWhileSetsAlwaysArriveMeanwhile) {
  sink.on_view = [&](const View& view) {
    if (view.name == "measured" && view.frame_set < 6) camera->expose(40000);
  };
  start();
  Published expected;
  for (const char* view : {"a 1", "b 2", "c 3", "a 4", "b 5"}) {
    const std::string set(1, std::string(view).back());
    expected.insert(expected.end(), {"status " + set, "measured " + set, view});
  }
  EXPECT_EQ(sink.first(expected.size()), expected);
}

TEST_F(PictureOrder, BetweenPicturesThatTakeLongTheHeartbeatContinues) {
  sink.lists_heartbeats = true;
  sink.on_view = [&](const View& view) {
    if (view.name == "measured") pipeline->select_view(2);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));  // time that a picture takes
  };
  start();
  EXPECT_EQ(sink.first(8), (Published{"status 1", "measured 1", "heartbeat 1", "a 1", "heartbeat 1",
                                      "b 1", "heartbeat 1", "c 1"}));
  std::vector<std::size_t> selected = sink.selected();
  selected.resize(4);
  EXPECT_EQ(selected, std::vector<std::size_t>(4, 0)) << "commands wait for the end of the set";
}

}  // namespace
}  // namespace orbwatch::app::pipeline
