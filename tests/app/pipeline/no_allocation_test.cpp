#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "app/pictures/colour_maps.h"
#include "app/pipeline/view_renderer.h"
#include "hal/frame_pool.h"
#include "hal/frame_sync.h"
#include "hal/mailbox.h"
#include "proc/signals/hot_spot.h"

namespace {

thread_local std::size_t allocations = 0;

}  // namespace

// Every allocation of this program is counted on the thread that makes it.
void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace orbwatch::app {
namespace {

constexpr int kSize = 120;

ViewPlan plan() {
  const auto view =
      optics::ViewProjection::make({optics::ViewKind::Perspective, {}, 100, {}, 200, 150}).value();
  const auto ball =
      optics::BallProjection::make(optics::BallModel::exact(345).value(), {{60, 60}, 55, 55, 0}, {})
          .value();
  ViewPlan plan{0, "view", view, {}, Combine::Mix, remap::Interpolation::Bilinear, 0};
  for (const std::size_t camera : {0, 1}) {
    const PixelFormat format = camera == 0 ? PixelFormat::Y16 : PixelFormat::Rgb;
    plan.sources.push_back(
        {camera, {format, {}, kSize, kSize, 30}, ball, 1, {colour_map_table("hot"), 0, 65535}});
  }
  return plan;
}

TEST(FramePath, DoesNotAllocate) {
  hal::FramePool thermal = hal::make_frame_pool(PixelFormat::Y16, kSize, kSize);
  hal::FramePool colour = hal::make_frame_pool(PixelFormat::Rgb, kSize, kSize);
  hal::FrameSync sync(2, std::chrono::seconds(1));
  ViewRenderer renderer(plan());
  std::vector<std::unique_ptr<View>> buffers;
  for (int i = 0; i < 3; ++i) buffers.push_back(std::make_unique<View>(renderer.make_view()));
  hal::BufferPool<View> views(std::move(buffers));
  signals::HotSpotDetector detector(renderer.plan().projection);
  WorkerPool workers(1);
  hal::Mailbox<ViewPtr> mailbox;

  const std::size_t before = allocations;
  for (std::uint64_t n = 0; n < 50; ++n) {
    for (std::size_t camera : {1U, 0U}) {
      auto frame = (camera == 0 ? thermal : colour).acquire();
      frame->metadata.sequence = n;
      frame->metadata.exposure_start = hal::Clock::now();
      reinterpret_cast<std::uint16_t*>(frame->memory)[kSize * 60 + 60] = 50000;
      sync.put(camera, std::move(frame));
    }
    const auto set = sync.next(hal::Clock::now() + std::chrono::seconds(5));
    ASSERT_TRUE(set);
    const auto view = views.acquire();
    renderer.render(*set, *view, workers);
    detector.measure(view->radiometric, view->validity, 20000);
    mailbox.put(view);
  }
  EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace orbwatch::app
