#include "app/pipeline/views/view_channel.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "hal/frame/frame_pool.h"
#include "tests/app/pipeline/views/rendered_view.h"
#include "tests/app/pipeline/views/thermal_view.h"

namespace orbwatch::app {
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
    return channel.render(set, pyramids, workers);
  }

  ViewPlan plan;
  FramePyramids pyramids{source_formats(plan)};
  std::shared_ptr<hal::FrameBuffer> buffer;
  hal::FrameSet set;
  WorkerPool workers{0};
};

TEST_F(ViewChannelTest, HandsOverEachViewOnce) {
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
  ViewChannel channel(plan);
  std::vector<ViewPtr> held;
  for (std::size_t n = 0; n < kViewBuffers; ++n) {
    EXPECT_TRUE(render(channel));
    held.push_back(channel.take());
  }
  EXPECT_FALSE(render(channel));
  EXPECT_EQ(channel.take(), nullptr);
  held.pop_back();
  EXPECT_TRUE(render(channel));
  EXPECT_TRUE(channel.take());
}

TEST_F(ViewChannelTest, AMeasuredViewIsRenderedEvenThen) {
  plan.measured = 0;
  ViewChannel channel(plan);
  std::vector<ViewPtr> held;
  for (std::size_t n = 0; n < kViewBuffers; ++n) {
    render(channel);
    held.push_back(channel.take());
  }
  const View* const unshared = render(channel);
  ASSERT_TRUE(unshared);
  EXPECT_EQ(unshared->frame_set, kViewBuffers + 1);
  EXPECT_EQ(*unshared->radiometric.at(48, 32), 0x0101);
  EXPECT_EQ(channel.take(), nullptr) << "no sink gets it";
}

}  // namespace
}  // namespace orbwatch::app
