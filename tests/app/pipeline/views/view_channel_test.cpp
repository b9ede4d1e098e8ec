// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/views/view_channel.h"

#include <gtest/gtest.h>

#include <cstring>
#include <optional>
#include <vector>

#include "hal/frame/frame_pool.h"
#include "tests/app/pipeline/views/rendered_view.h"
#include "tests/app/pipeline/views/thermal_view.h"

namespace orbwatch::app::pipeline {
namespace {

class ViewChannelTest : public testing::Test {
 protected:
  explicit ViewChannelTest() : plan(thermal_view(4, "thermal")) {
    buffer = hal::make_frame_pool(PixelFormat::Y16, kHandCameraSize, kHandCameraSize, 1).acquire();
    std::memset(buffer->memory, 1, buffer->capacity);
    set.frames[0] = buffer;
  }
  const View* render(ViewChannel& channel) {
    ++set.id;
    pyramids.build(set, {}, workers);
    if (!channel.plan().measured) return channel.render(set, pyramids, *buffers, workers);
    const View& view = channel.measure(set, pyramids, *buffers, workers);
    channel.draw(pyramids, workers);
    return &view;
  }
  /// Publishes until the readers, who may keep two, hold every one.
  std::vector<ViewPtr> hold_all(ViewChannel& channel) {
    std::vector<ViewPtr> held;
    for (int n = 0; n < 3; ++n) {
      EXPECT_TRUE(render(channel));
      held.push_back(channel.take());
      EXPECT_TRUE(held.back());
    }
    return held;
  }

  ViewPlan plan;
  FramePyramids pyramids{source_formats(plan)};
  std::shared_ptr<hal::FrameBuffer> buffer;
  hal::FrameSet set;
  WorkerPool workers{0};
  std::optional<ViewBuffers> buffers;
};

TEST_F(ViewChannelTest, HandsOverEachViewOnce) {
  buffers.emplace(buffers_for(plan));
  ViewChannel channel(plan);
  const View* const rendered = render(channel);
  const ViewPtr view = channel.take();
  ASSERT_TRUE(view);
  EXPECT_EQ(view.get(), rendered);
  EXPECT_EQ(view->index, 4U);
  EXPECT_EQ(view->name, "thermal");
  EXPECT_EQ(view->frame_set, 1U);
  EXPECT_EQ(channel.take(), nullptr);
}

TEST_F(ViewChannelTest, ADisplayViewIsSkippedWhileEveryBufferIsHeld) {
  buffers.emplace(buffers_for(plan, {2, 0}));
  ViewChannel channel(plan);
  std::vector<ViewPtr> held = hold_all(channel);
  EXPECT_FALSE(render(channel));
  EXPECT_EQ(channel.take(), nullptr);
  held.pop_back();
  EXPECT_TRUE(render(channel));
  EXPECT_TRUE(channel.take());
}

TEST_F(ViewChannelTest, AMeasuredViewIsRenderedEvenThen) {
  plan.measured = 0;
  buffers.emplace(buffers_for(plan, {2, 0}));
  ViewChannel channel(plan);
  std::vector<ViewPtr> held = hold_all(channel);
  for (int n = 0; n < 2; ++n) {
    const View* const unshared = render(channel);
    ASSERT_TRUE(unshared);
    EXPECT_EQ(unshared->frame_set, set.id);
    EXPECT_EQ(*unshared->radiometric.at(48, 32), 0x0101);
    EXPECT_EQ(channel.take(), nullptr) << "no sink gets it";
  }
  held.pop_back();
  EXPECT_TRUE(render(channel));
  EXPECT_TRUE(channel.take());
}

TEST_F(ViewChannelTest, ADisplayViewHasCountsOfTemperatureWhileTheyAreNeeded) {
  plan.sources[0].format.kelvin_per_count = 0.04;
  plan.sources[0].format.kelvin_offset = 273.15;
  buffers.emplace(buffers_for(plan));
  ViewChannel channel(plan);
  channel.set_reading(PixelFormat::Rgb, true);
  const View* const view = render(channel);
  ASSERT_TRUE(view);
  ASSERT_FALSE(view->counts.empty());
  EXPECT_EQ(*view->counts.at(48, 32), 0x0101);
  EXPECT_EQ(view->kelvin_per_count, 0.04);
  EXPECT_EQ(view->kelvin_offset, 273.15);
  EXPECT_TRUE(view->radiometric.empty()) << "it does not measure";
  channel.take();
  channel.set_reading(PixelFormat::Rgb, false);
  EXPECT_TRUE(render(channel)->counts.empty());
}

TEST_F(ViewChannelTest, AMeasuredViewHasThemIfItsCameraCountsTemperature) {
  plan.measured = 0;
  buffers.emplace(buffers_for(plan));
  ViewChannel unknown(plan);
  EXPECT_TRUE(render(unknown)->counts.empty()) << "they may be anything";
  unknown.take();
  plan.sources[0].format.kelvin_per_count = 0.04;
  ViewChannel thermal(plan);
  const View* const view = render(thermal);
  ASSERT_FALSE(view->counts.empty());
  EXPECT_EQ(view->counts.data, view->radiometric.data);
}

TEST_F(ViewChannelTest, AMeasuredViewHasItsPictureAfterItsPlane) {
  plan.measured = 0;
  buffers.emplace(buffers_for(plan));
  ViewChannel channel(plan);
  channel.set_reading(PixelFormat::Rgb, false);
  ++set.id;
  pyramids.build(set, {}, workers);
  const View& view = channel.measure(set, pyramids, *buffers, workers);
  EXPECT_EQ(*view.radiometric.at(48, 32), 0x0101);
  EXPECT_EQ(static_cast<Validity>(*view.validity.at(48, 32)), Validity::Seen);
  EXPECT_EQ(view.picture.planes[0].data, nullptr) << "nobody who measures waits for it";
  channel.draw(pyramids, workers);
  EXPECT_EQ(view.picture.format, PixelFormat::Rgb);
  EXPECT_NE(view.picture.planes[0].data, nullptr);
  EXPECT_TRUE(channel.take());
}

TEST_F(ViewChannelTest, NothingIsSampledForAPictureThatNoSinkGets) {
  plan.measured = 0;
  plan.interpolation = remap::Interpolation::Area;
  plan.projection =
      optics::ViewProjection::make({optics::ViewKind::Equirectangular, {}, {}, {}, 16, 8}).value();
  buffers.emplace(buffers_for(plan, {2, 0}));
  ViewChannel channel(plan);
  channel.set_reading(PixelFormat::Rgb, false);
  const auto levels_to_draw = [&] {
    PictureUses measured, drawn;
    channel.add_measured_use(measured);
    pyramids.build(set, measured, workers);
    channel.measure(set, pyramids, *buffers, workers);
    channel.add_use(drawn);
    channel.take();
    return drawn[0].mip_levels;
  };
  EXPECT_GT(levels_to_draw(), 0);
  std::vector<ViewPtr> held;
  while (ViewPtr view = buffers->acquire(plan)) held.push_back(std::move(view));
  EXPECT_EQ(levels_to_draw(), 0);
  held.pop_back();
  EXPECT_GT(levels_to_draw(), 0);
}

/// Recipes with views of one size follow each other.
TEST_F(ViewChannelTest, AChannelKeepsNothingOfWhatWasTaken) {
  plan.measured = 0;
  buffers.emplace(buffers_for(plan));
  ViewChannel one(plan), other(plan);
  std::vector<ViewPtr> held;
  ASSERT_TRUE(render(one));
  held.push_back(one.take());
  ASSERT_TRUE(render(one)) << "not shared";
  EXPECT_FALSE(one.take());
  EXPECT_TRUE(render(other)) << "in the same buffer";
}

}  // namespace
}  // namespace orbwatch::app::pipeline
