// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/pipeline.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <random>
#include <thread>

#include "tests/app/pipeline/measurement/measured_recipe.h"
#include "tests/app/pipeline/views/pointed_views.h"

namespace orbwatch::app::pipeline {
namespace {

/// View that a sink received.
struct Shown {
  std::size_t view = 0;
  std::string name;
  std::uint64_t frame_set = 0;
  std::uint64_t pointing = 0;
  std::vector<std::uint8_t> bytes;  ///< bytes of picture and validity
};

/// Keeps the newest of each view and of the status; the test waits for the expected one.
class WatchingSink : public Sink {
 public:
  Result<> start() override { return {}; }
  void stop() override {}
  PictureNeeds needs(std::size_t, hal::TimePoint) override { return need_of(PixelFormat::Rgb); }
  void accept(const ViewPtr& view) override {
    const std::lock_guard lock(mutex_);
    Shown& shown = newest_[view->index];
    shown = {view->index,
             std::string(view->name),
             view->frame_set,
             view->pointing,
             {view->bytes.begin(), view->bytes.end()}};
    if (on_view) on_view(shown);
    changed_.notify_all();
  }
  void accept(const Status& status) override {
    const std::lock_guard lock(mutex_);
    status_ = status;
    changed_.notify_all();
  }

  /// Waits for a set's status and its last view.
  Status wait_for_set(std::uint64_t number) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, std::chrono::seconds(30), [&] {
      return status_.frame_set >= number && newest_[kRight].frame_set >= number;
    }));
    return status_;
  }
  Shown wait_for_pointing(std::size_t view, std::uint64_t number) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, std::chrono::seconds(30),
                                  [&] { return newest_[view].pointing >= number; }));
    return newest_[view];
  }
  Shown newest(std::size_t view) {
    const std::lock_guard lock(mutex_);
    return newest_[view];
  }

  /// Called for each view, one call at a time; set before the pipeline starts.
  std::function<void(const Shown&)> on_view;

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::array<Shown, 3> newest_;
  Status status_;
};

/// Pipeline with one camera, two views to point and one that is measured.
class PointedStage {
 public:
  explicit PointedStage(const Pointing& left = kHome,
                        optics::ViewKind kind = optics::ViewKind::Perspective) {
    PipelinePlan plan;
    auto hand = std::make_unique<HandCamera>("camera", PixelFormat::Grey);
    plan.formats.push_back(hand->configure({}).value());
    camera = hand.get();
    plan.cameras.push_back(std::move(hand));
    plan.deadline = std::chrono::seconds(20);
    plan.views = {view_plan(kLeft, kind, left),
                  view_plan(kRight, optics::ViewKind::Perspective, kHome)};
    plan.recipes.push_back(
        compiled(recipe_plan(view_plan(kMeasured, optics::ViewKind::Perspective, kHome), 199)));
    plan.view_count = 3;
    pipeline.emplace(std::move(plan));
  }

  void start() { ASSERT_TRUE(pipeline->start({&sink})); }

  /// Exposes a frame and waits until its views were passed to the sink.
  void next_frame() {
    camera->expose(200);
    sink.wait_for_set(++frames_);
  }
  /// Exposes frames until one shows the request or a newer one.
  Shown frames_until(std::size_t view, std::uint64_t number) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    do {
      next_frame();
    } while (sink.newest(view).pointing < number && std::chrono::steady_clock::now() < end);
    EXPECT_GE(sink.newest(view).pointing, number);
    return sink.newest(view);
  }

  HandCamera* camera = nullptr;
  WatchingSink sink;
  std::optional<Pipeline> pipeline;

 private:
  std::uint64_t frames_ = 0;
};

/// First frame of a pipeline that was started with this pointing.
Shown started_with(const Pointing& left, std::size_t view = kLeft,
                   optics::ViewKind kind = optics::ViewKind::Perspective) {
  PointedStage stage(left, kind);
  stage.start();
  stage.next_frame();
  return stage.sink.newest(view);
}

TEST(PointedPipeline, ShowsWhatAPipelineShowsThatWasStartedThatWay) {
  PointedStage stage;
  stage.start();
  stage.next_frame();
  const Shown right = stage.sink.newest(kRight), measured = stage.sink.newest(kMeasured);
  std::vector<std::uint8_t> previous = stage.sink.newest(kLeft).bytes;
  std::uint64_t requests = 0;
  for (const Pointing& pointing :
       {Pointing{{30, 0, 0}, 100, {}}, Pointing{{30, -20, 0}, 100, {}},
        Pointing{{30, -20, 45}, 100, {}}, Pointing{{30, -20, 45}, 60, {}},
        Pointing{{30, -20, 45}, 60, 90}, kHome}) {
    const auto number = stage.pipeline->point(kLeft, pointing);
    ASSERT_TRUE(number) << number.error().message;
    EXPECT_EQ(*number, ++requests);
    const Shown shown = stage.frames_until(kLeft, *number);
    EXPECT_EQ(shown.pointing, *number);
    EXPECT_EQ(shown.name, kNames[kLeft]);
    EXPECT_EQ(shown.bytes, started_with(pointing).bytes) << "request " << *number;
    EXPECT_NE(shown.bytes, previous) << "request " << *number;
    previous = shown.bytes;
  }
  EXPECT_EQ(stage.sink.newest(kRight).bytes, right.bytes);
  EXPECT_EQ(stage.sink.newest(kRight).pointing, 0U);
  EXPECT_EQ(stage.sink.newest(kMeasured).bytes, measured.bytes);
}

TEST(PointedPipeline, KeepsTheKindOfTheView) {
  const Pointing wide{{}, 300, 100}, aside{{-50, 10, 0}, 240, 80};
  PointedStage stage(wide, optics::ViewKind::Equirectangular);
  stage.start();
  const auto number = stage.pipeline->point(kLeft, aside);
  ASSERT_TRUE(number) << number.error().message;
  EXPECT_EQ(stage.frames_until(kLeft, *number).bytes,
            started_with(aside, kLeft, optics::ViewKind::Equirectangular).bytes);
}

/// Direction of a view, and its expected picture.
struct Place {
  Pointing pointing;
  std::vector<std::uint8_t> bytes;
};

std::vector<Place> random_places(std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<double> angle(-60, 60), fov(40, 140);
  std::vector<Place> places;
  for (std::size_t i = 0; i < count; ++i) {
    const Pointing pointing{{angle(random), angle(random), angle(random)}, fov(random), {}};
    places.push_back({pointing, started_with(pointing).bytes});
  }
  return places;
}

/// Checks each frame of one view on arrival.
struct Audit {
  std::vector<const Place*> requests;  ///< index: number; 0: the initial direction
  std::uint64_t frames = 0, changes = 0, lost = 0, wrong = 0, backwards = 0, last = 0;

  void check(const Shown& shown) {
    lost += shown.frame_set != ++frames ? 1U : 0U;
    wrong += shown.bytes != requests.at(shown.pointing)->bytes ? 1U : 0U;
    backwards += shown.pointing < last ? 1U : 0U;
    changes += shown.pointing != last ? 1U : 0U;
    last = shown.pointing;
  }
};

TEST(PointedPipeline, EveryFrameDuringAThousandRequestsShowsOneOfThemWhole) {
  constexpr std::size_t kRequests = 500;  // requests for each of two views
  std::mt19937 random(4);
  const std::vector<Place> places = random_places(16, random);
  const Place home{kHome, started_with(kHome).bytes};
  const Place measured{kHome, started_with(kHome, kMeasured).bytes};
  std::array<Audit, 3> audits{Audit{{&home}}, Audit{{&home}}, Audit{{&measured}}};
  for (std::size_t n = 1; n <= kRequests; ++n) {
    for (const std::size_t v : {kLeft, kRight}) {
      audits[v].requests.push_back(&places[random() % places.size()]);
    }
  }
  PointedStage stage;
  stage.sink.on_view = [&](const Shown& shown) { audits[shown.view].check(shown); };
  stage.start();
  {
    const std::jthread exposing([&](const std::stop_token& stop) {
      while (!stop.stop_requested()) stage.next_frame();  // so no display view gives way
    });
    const auto operate = [&](std::size_t view) {
      for (std::size_t n = 1; n <= kRequests; ++n) {
        const auto number = stage.pipeline->point(view, audits[view].requests[n]->pointing);
        ASSERT_EQ(number.value_or(0), n);
        if (n % 10 == 0) stage.sink.wait_for_pointing(view, n);
      }
    };
    const std::jthread left(operate, kLeft), right(operate, kRight);
  }
  stage.pipeline->stop();
  const Status status = stage.sink.wait_for_set(audits[kMeasured].frames);
  for (const std::size_t v : {kLeft, kRight, kMeasured}) {
    EXPECT_EQ(audits[v].lost, 0U) << kNames[v];
    EXPECT_EQ(audits[v].wrong, 0U) << kNames[v];
    EXPECT_EQ(audits[v].backwards, 0U) << kNames[v];
  }
  for (const std::size_t v : {kLeft, kRight}) {
    EXPECT_GE(audits[v].changes, kRequests / 10);
    EXPECT_EQ(status.views[v].superseded + audits[v].changes, kRequests) << "shown or counted";
  }
}

TEST(PointedPipeline, TheNewestRequestWinsAndTheOthersAreCounted) {
  PointedStage stage;
  stage.start();
  const Pointing last{{20, 10, 0}, 80, {}};
  for (int i = 0; i < 99; ++i) {
    ASSERT_TRUE(stage.pipeline->point(kLeft, {{-30.0 + i / 2.0, 0, 0}, 80, {}}));
  }
  ASSERT_EQ(stage.pipeline->point(kLeft, last).value(), 100U);
  std::uint64_t shown = 0;
  for (std::uint64_t newest = 0; newest < 100; ++shown) {
    newest = stage.frames_until(kLeft, newest + 1).pointing;
  }
  EXPECT_EQ(stage.sink.newest(kLeft).bytes, started_with(last).bytes);
  const Status status = stage.sink.wait_for_set(stage.sink.newest(kLeft).frame_set);
  EXPECT_EQ(status.views[kLeft].superseded + shown, 100U);
  EXPECT_EQ(status.views[kRight].superseded, 0U);
}

TEST(PointedPipeline, StopsWithRequestsUnderWay) {
  for (int round = 0; round < 20; ++round) {
    PointedStage stage;
    stage.start();
    stage.next_frame();
    for (int i = 0; i < round; ++i) {
      ASSERT_TRUE(stage.pipeline->point(i % 2 == 0 ? kLeft : kRight, {{1.0 * i, 0, 0}, 80, {}}));
      if (i % 5 == 4) stage.next_frame();
    }
    stage.pipeline->stop();
    EXPECT_FALSE(stage.pipeline->point(kLeft, kHome));
  }
}

TEST(PointedPipeline, ThePipelineThatFollowsStartsAsConfigured) {
  PointedStage before;
  before.start();
  ASSERT_TRUE(before.pipeline->point(kLeft, {{30, 0, 0}, 80, {}}));
  before.pipeline.reset();
  const Shown shown = started_with(kHome);
  EXPECT_EQ(shown.pointing, 0U);
  EXPECT_EQ(shown.bytes, started_with(kHome, kRight).bytes);
}

TEST(PointedPipeline, TakesRequestsBeforeTheFirstFrame) {
  PointedStage stage;
  const Pointing aside{{-40, 0, 0}, 80, {}};
  const auto number = stage.pipeline->point(kLeft, aside);
  ASSERT_TRUE(number);
  stage.start();
  EXPECT_EQ(stage.frames_until(kLeft, *number).bytes, started_with(aside).bytes);
}

}  // namespace
}  // namespace orbwatch::app::pipeline
