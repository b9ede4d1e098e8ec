// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <condition_variable>
#include <cstdio>
#include <mutex>

#include "app/pipeline/pipeline.h"
#include "app/ports/modbus/modbus_sink.h"
#include "tests/app/pipeline/views/pointed_views.h"
#include "tests/support/registers.h"

/// Measures from a PLC's command over Modbus to the picture that shows it.
namespace orbwatch::app::daemon {
namespace {

/// Records the pointing of the newest picture.
class NewestPointing : public Sink {
 public:
  Result<> start() override { return {}; }
  void stop() override {}
  void accept(const ViewPtr& view) override {
    const std::lock_guard lock(mutex_);
    pointing_ = view->pointing;
    frame_set_ = view->frame_set;
    changed_.notify_all();
  }
  void accept(const Status&) override {}
  /// Pointing of the frame set with this number.
  std::uint64_t of(std::uint64_t frame_set) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(
        changed_.wait_for(lock, std::chrono::seconds(30), [&] { return frame_set_ >= frame_set; }));
    return pointing_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t pointing_ = 0;
  std::uint64_t frame_set_ = 0;
};

TEST(CommandToEffect, APointedViewIsInTheNextFrame) {
  pipeline::PipelinePlan plan;
  auto hand = std::make_unique<pipeline::HandCamera>("camera", PixelFormat::Grey);
  pipeline::HandCamera& camera = *hand;
  plan.formats.push_back(camera.configure({}).value());
  plan.cameras.push_back(std::move(hand));
  plan.views.push_back(view_plan(pipeline::kLeft, optics::ViewKind::Perspective, pipeline::kHome));
  plan.view_count = 1;
  plan.deadline = std::chrono::seconds(20);  // else a busy machine leaves out pictures
  pipeline::Pipeline pipeline(std::move(plan));
  ModbusSettings settings;
  settings.address = "127.0.0.1";
  settings.port = 0;
  ModbusSink modbus(settings, [&](const Command& command) {
    const auto& [view, yaw, pitch, h_fov] = command.arguments;
    return pipeline.point_view(static_cast<std::size_t>(view), yaw, pitch, h_fov);
  });
  NewestPointing newest;
  ASSERT_TRUE(modbus.start());
  ASSERT_TRUE(pipeline.start({&newest, &modbus}));

  // Frames come as fast as possible, so a busy machine may show one before the view is compiled: a
  // camera's period later it is compiled.
  int in_the_next = 0;
  std::uint64_t frames = 0;
  constexpr int kCommands = 20;
  for (std::uint16_t n = 1; n <= kCommands; ++n) {
    orbwatch::tests::write_command(modbus.port(),
                                   static_cast<std::uint16_t>(CommandCode::PointView),
                                   {0, 100 * n, -500, 8000}, n);
    ASSERT_EQ(orbwatch::tests::read_register(modbus.port(), "acknowledged_sequence"), n);
    ASSERT_EQ(orbwatch::tests::read_register(modbus.port(), "command_result"), 0);
    const std::uint64_t before = frames;
    do {
      camera.expose(200);
    } while (newest.of(++frames) < n && frames - before < 10000);
    ASSERT_EQ(newest.of(frames), n);
    in_the_next += frames - before == 1 ? 1 : 0;
  }
  RecordProperty("in_the_next_frame", in_the_next);
  std::printf("%d of %d in the next frame\n", in_the_next, kCommands);
  EXPECT_GT(in_the_next, 0);
  pipeline.stop();
  modbus.stop();
}

}  // namespace
}  // namespace orbwatch::app::daemon
