// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <new>
#include <string>
#include <thread>

#include "app/log_writer.h"
#include "app/pictures/colour_maps.h"
#include "app/pipeline/pipeline.h"
#include "hal/frame/frame_pool.h"
#include "hal/sync/frame_sync.h"
#include "hal/thread/mailbox.h"
#include "tests/app/pipeline/hand_camera.h"
#include "tests/app/pipeline/measurement/measured_recipe.h"
#include "tests/app/pipeline/views/rendered_view.h"
#include "tests/app/pipeline/views/thermal_view.h"
#include "tests/app/ports/recorder/events/recorded_machine.h"

namespace {

thread_local std::size_t allocations = 0;
thread_local std::size_t releases = 0;
std::atomic<std::ptrdiff_t> blocks = 0;  // all threads' blocks, not released yet

}  // namespace

// Counts every allocation of this program, and its release, on the thread that makes it.
void* operator new(std::size_t size) {
  ++allocations;
  ++blocks;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  if (memory == nullptr) return;
  ++releases;
  --blocks;
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept { operator delete(memory); }

namespace orbwatch::app::pipeline {
namespace {

constexpr int kSize = 120;

ViewPlan plan() {
  const auto view =
      optics::ViewProjection::make({optics::ViewKind::Perspective, {}, 100, {}, 200, 150}).value();
  const auto ball = optics::BallProjection::make(
                        optics::BallModel::make(optics::BallModel::Kind::Exact, 345).value(),
                        {{60, 60}, 55, 55, 0}, {})
                        .value();
  ViewPlan plan{0, "view", view, {}, Combine::Mix, remap::Interpolation::Area, 0};
  for (const std::size_t camera : {0, 1}) {
    const PixelFormat format = camera == 0 ? PixelFormat::Y16 : PixelFormat::Rgb;
    plan.sources.push_back({camera,
                            {format, {}, kSize, kSize, 30},
                            ball,
                            1,
                            {colour_map_table("hot"), 0, 65535},
                            0.8});
  }
  return plan;
}

TEST(FramePath, DoesNotAllocate) {
  hal::FramePool thermal = hal::make_frame_pool(PixelFormat::Y16, kSize, kSize);
  hal::FramePool colour = hal::make_frame_pool(PixelFormat::Rgb, kSize, kSize);
  hal::FrameSync sync(2, {std::chrono::seconds(1), std::chrono::seconds(1)});
  RecipePlan measured = recipe_plan(plan(), 20000, 0.04);
  signals::AlarmLimits limits;
  limits.high_alarm = 0.5;  // for hot_spot_present: always exceeded
  measured.alarms.push_back(limits);
  const auto recipe = compiled(std::move(measured));
  ViewBuffers buffers = buffers_for(recipe->plan().views[0], {1, 0});
  PictureUses measured_uses, uses;
  for (ViewChannel& view : recipe->views()) {
    view.set_reading(PixelFormat::Rgb, false);
    view.add_measured_use(measured_uses);
    view.add_use(uses);
  }
  ASSERT_EQ(uses[1].sharpened().size(), 1U);
  ASSERT_EQ(measured_uses[1].sharpened().size(), 0U) << "left for the picture";
  for (PictureUse& use : uses) use.mip_levels = remap::kMaxLevel;
  FramePyramids pyramids(source_formats(plan()), uses);
  WorkerPool workers(1);
  hal::Mailbox<ViewPtr> mailbox;

  const std::size_t before = allocations;
  for (std::uint64_t n = 0; n < 50; ++n) {
    for (std::size_t camera : {1U, 0U}) {
      auto frame = (camera == 0 ? thermal : colour).acquire();
      frame->metadata.sequence = n;
      frame->metadata.exposure_start = hal::Clock::now();
      std::memset(frame->memory, 0, frame->capacity);
      reinterpret_cast<std::uint16_t*>(frame->memory)[kSize * 60 + 60] = 50000;
      sync.put(camera, std::move(frame));
    }
    const auto set = sync.next(hal::Clock::now() + std::chrono::seconds(5));
    ASSERT_TRUE(set);
    pyramids.build(*set, measured_uses, workers);
    recipe->render(*set, pyramids, buffers, workers);
    recipe->measure();
    recipe->watch(set->stamp, true, {});
    pyramids.extend(uses, workers);
    recipe->views()[0].draw(pyramids, workers);
    ViewPtr view = recipe->views()[0].take();
    ASSERT_TRUE(view);
    mailbox.put(std::move(view));
  }
  EXPECT_EQ(allocations, before);
}

TEST(FramePath, KeepsPicturesForEventsWithoutAllocating) {
  using orbwatch::tests::RecordedMachine;
  recorder::EventSettings events;
  events.ring_mib = 1;
  events.longest = std::chrono::seconds(20);
  events.on_lines = {"button"};
  const RecorderSettings settings{.folder = "unused", .events = events};
  const StatusNames names{{}, {}, {}, {"button"}};
  const RecordedTexts texts;
  recorder::RecorderCounters counters;
  recorder::EventRecorder recorded(settings, RecordedMachine::cameras(), names, texts, counters);
  std::vector<hal::FrameSet> sets(200);
  for (std::uint64_t n = 0; n < sets.size(); ++n) {
    sets[n].id = n + 1;
    sets[n].stamp = RecordedMachine::at(100 * n);  // a second apart
    sets[n].frames[0] = orbwatch::tests::painted_frame(n, 0, sets[n].stamp, RecordedMachine::kWidth,
                                                       RecordedMachine::kHeight);
    sets[n].frames[1] = orbwatch::tests::jpeg_frame(n, sets[n].stamp, RecordedMachine::kWidth,
                                                    RecordedMachine::kHeight);
  }
  Status status;
  AlarmNotice notice;
  const std::size_t before = allocations;
  for (const hal::FrameSet& set : sets) {
    recorded.accept_frames(set);
    notice.stamp = status.stamp = set.stamp;
    notice.frame_set = status.frame_set = set.id;
    if (set.id % 10 == 0) recorded.accept_event(notice);
    status.process_input_edges[0] += set.id % 3;
    recorded.request();
    recorded.accept(status);
  }
  EXPECT_EQ(allocations, before);
  recorder::RecorderStatistics statistics;
  recorded.add_figures(statistics);
  EXPECT_GT(statistics.triggers_joined, 0U);
  EXPECT_GT(statistics.recordings_lost, 0U) << "nobody reads the windows";
  EXPECT_GT(statistics.ring_used, 0.0);
}

TEST(FramePath, LogsWithoutAllocation) {
  std::atomic<std::size_t> written = 0;
  LogWriter log([&written](const LogRecord&) { ++written; });
  const std::string detail(2 * LogWriter::kMaxText, 'd');
  const std::size_t before = allocations;
  for (std::size_t i = 0; i < 3 * LogWriter::kMaxWaiting; ++i) {
    log_soon(LogLevel::Warning, {"colour: stalled (", detail, ")"},
             {.camera = "colour", .fault = "stalled", .trigger = i});
  }
  EXPECT_EQ(allocations, before);
  log.flush();
  EXPECT_GE(written, LogWriter::kMaxWaiting);
}

/// Reads the counters of the pipeline's thread.
class CountingSink : public Sink {
 public:
  struct Reading {
    std::uint64_t frame_set = 0;
    std::uint16_t recipe = 0;
    std::uint64_t pointing = 0;
    std::size_t allocations = 0;
    std::size_t releases = 0;
  };

  Result<> start() override { return {}; }
  void stop() override {}
  PictureNeeds needs(std::size_t, hal::TimePoint) override { return need_of(PixelFormat::Rgb); }
  void accept(const ViewPtr& view) override {
    const std::lock_guard lock(mutex_);
    reading_.pointing = view->pointing;
  }
  void accept_event(const AlarmNotice&) override { ++notices_; }
  void accept(const Status& status) override {
    const std::lock_guard lock(mutex_);
    reading_.frame_set = status.frame_set;
    reading_.recipe = status.recipe;
    reading_.allocations = allocations;
    reading_.releases = releases;
    changed_.notify_all();
  }
  Reading wait_for_set(std::uint64_t number) {
    return wait_for([number](const Reading& reading) { return reading.frame_set >= number; });
  }
  Reading wait_for_recipe(std::uint16_t number) {
    return wait_for([number](const Reading& reading) { return reading.recipe == number; });
  }
  std::size_t notices() const { return notices_; }

 private:
  template <class Condition>
  Reading wait_for(const Condition& condition) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(
        changed_.wait_for(lock, std::chrono::seconds(30), [&] { return condition(reading_); }));
    return reading_;
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  Reading reading_;
  std::atomic<std::size_t> notices_{0};
};

TEST(FramePath, NeitherAllocatesNorFreesWhileAViewIsPointedAndColoured) {
  PipelinePlan displayed;
  auto hand = std::make_unique<HandCamera>("camera", PixelFormat::Grey);
  HandCamera& camera = *hand;
  displayed.formats.push_back(camera.configure({}).value());
  displayed.cameras.push_back(std::move(hand));
  displayed.deadline = std::chrono::seconds(20);
  displayed.view_count = 1;
  displayed.views.push_back(plan());
  displayed.views[0].measured.reset();
  displayed.views[0].sources.resize(1, displayed.views[0].sources[0]);
  displayed.views[0].sources[0].format = displayed.formats[0];
  displayed.colour_maps = {colour_map_table("grey"), colour_map_table("hot")};
  CountingSink sink;
  Pipeline pipeline(std::move(displayed));
  ASSERT_TRUE(pipeline.start({&sink}));

  std::uint64_t frames = 0;
  const auto next_frame = [&] {
    camera.expose(200);
    return sink.wait_for_set(++frames);
  };
  const CountingSink::Reading before = next_frame();
  CountingSink::Reading after;
  for (int i = 0; i < 30; ++i) {
    const auto number = pipeline.point(0, {{3.0 * i, 0, 0}, 90, {}});
    ASSERT_TRUE(number);
    ASSERT_EQ(pipeline.set_colour_map(0, 0, i % 2), CommandResult::Done);
    ASSERT_EQ(pipeline.set_colour_range(0, 0, {0, 1.0 + i}), CommandResult::Done);
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    do {
      after = next_frame();
    } while (after.pointing < *number && std::chrono::steady_clock::now() < end);
    ASSERT_EQ(after.pointing, *number);
  }
  EXPECT_EQ(after.allocations, before.allocations);
  EXPECT_EQ(after.releases, before.releases);
}

TEST(FramePath, NeitherAllocatesNorFreesWhileRecipesAreSelected) {
  PipelinePlan measured;
  auto hand = std::make_unique<HandCamera>("camera", PixelFormat::Y16);
  HandCamera& camera = *hand;
  measured.formats.push_back(camera.configure({}).value());
  measured.cameras.push_back(std::move(hand));
  measured.deadline = std::chrono::seconds(20);
  measured.view_count = 2;
  for (const std::uint16_t number : {1, 2}) {
    RecipePlan recipe = recipe_plan(thermal_view(number - 1U, "measured"), 30000, 0.04, number);
    signals::AlarmLimits limits;
    limits.high_alarm = 0.5;  // for hot_spot_present: raised until another recipe is selected
    recipe.alarms.push_back(limits);
    measured.recipes.push_back(compiled(std::move(recipe)));
  }
  CountingSink sink;
  Pipeline pipeline(std::move(measured));
  ASSERT_TRUE(pipeline.start({&sink}));

  std::uint64_t frames = 0;
  const auto next_frame_of = [&](std::uint16_t recipe) {
    EXPECT_EQ(pipeline.select_recipe(recipe), CommandResult::Done);
    sink.wait_for_recipe(recipe);
    camera.expose(40000);
    return sink.wait_for_set(++frames);
  };
  const CountingSink::Reading before = next_frame_of(2);
  CountingSink::Reading after;
  for (int i = 0; i < 30; ++i) after = next_frame_of(static_cast<std::uint16_t>(1 + i % 2));
  EXPECT_EQ(sink.notices(), 2 * 30U + 1)
      << "each recipe's alarm was raised, and suppressed by the next";
  EXPECT_EQ(after.allocations, before.allocations);
  EXPECT_EQ(after.releases, before.releases);
}

TEST(PanTiltZoom, FreesARendererWhenItWasReplaced) {
  ViewPlan displayed = plan();
  displayed.measured.reset();
  PanTiltZoom pan_tilt_zoom({&displayed, 1});
  std::unique_ptr<ViewRenderer> shown;
  const auto wait_until = [&](const auto& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!condition() && std::chrono::steady_clock::now() < end) std::this_thread::yield();
    return condition();
  };
  const auto point = [&] {
    const auto number = pan_tilt_zoom.point(0, {{30, 0, 0}, 90, {}});
    return wait_until([&] {
      pan_tilt_zoom.exchange(0, shown);
      return shown && shown->plan().pointing == *number;
    });
  };
  ASSERT_TRUE(point());
  const std::ptrdiff_t of_one = blocks;
  ASSERT_TRUE(point());
  EXPECT_TRUE(wait_until([&] { return blocks <= of_one; })) << blocks - of_one << " more";
}

}  // namespace
}  // namespace orbwatch::app::pipeline
