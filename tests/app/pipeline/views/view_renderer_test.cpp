#include "app/pipeline/views/view_renderer.h"

#include <gtest/gtest.h>

#include "app/pictures/colour_maps.h"
#include "hal/frame/frame_pool.h"
#include "proc/image/image_view.h"
#include "proc/optics/rotation.h"
#include "tests/app/pipeline/views/rendered_view.h"

namespace orbwatch::app {
namespace {

using optics::BallModel;
using optics::BallProjection;
using optics::ViewKind;
using optics::ViewProjection;

constexpr int kSize = 200;

/// A camera whose registration turns it `yaw` degrees around the ball.
ViewSource source(std::size_t camera, PixelFormat format, double yaw, double weight = 1) {
  const auto ball = BallProjection::make(BallModel::make(BallModel::Kind::Exact, 340).value(),
                                         {{99.5, 99.5}, 95, 95, 0}, optics::rotation({yaw, 0, 0}));
  return {camera,
          {format, {}, kSize, kSize, 30},
          ball.value(),
          weight,
          remap::ColourMap(colour_map_table("grey"), 0,
                           info(format).bytes_per_sample() == 2 ? 65535 : 255)};
}

ViewPlan panorama(std::vector<ViewSource> sources, Combine combine = Combine::Mix) {
  return {3,
          "all",
          ViewProjection::make({ViewKind::Equirectangular, {}, {}, {}, 360, 180}).value(),
          std::move(sources),
          combine,
          remap::Interpolation::Bilinear,
          std::nullopt};
}

/// A picture of one colour, or of one count for 16 bit.
hal::Frame plain(PixelFormat format, std::uint16_t value) {
  auto buffer = hal::make_frame_pool(format, kSize, kSize, 1).acquire();
  const std::size_t samples =
      buffer->capacity / static_cast<std::size_t>(info(format).bytes_per_sample());
  for (std::size_t i = 0; i < samples; ++i) {
    if (info(format).bytes_per_sample() == 2) {
      reinterpret_cast<std::uint16_t*>(buffer->memory)[i] = value;
    } else {
      buffer->memory[i] = static_cast<std::byte>(value);
    }
  }
  return buffer;
}

int red(const View& view, int lon) { return view.colour.at(lon + 180, 90)[0]; }
Validity validity(const View& view, int lon) {
  return static_cast<Validity>(*view.validity.at(lon + 180, 90));
}

class ViewRendererTest : public testing::Test {
 protected:
  WorkerPool workers{1};
  hal::FrameSet set;
};

TEST_F(ViewRendererTest, ASecondCameraFillsTheBlindConeAndIsMixedElsewhere) {
  RenderedView rendered(
      panorama({source(0, PixelFormat::Rgb, 0, 3), source(1, PixelFormat::Rgb, 180, 1)}));
  set.id = 7;
  set.frames = {plain(PixelFormat::Rgb, 100), plain(PixelFormat::Rgb, 200)};
  const View& view = rendered.render(set, workers);
  EXPECT_EQ(view.frame_set, 7U);
  EXPECT_EQ(view.index, 3U);
  for (const int lon : {50, 90, 130}) EXPECT_NEAR(red(view, lon), 125, 1) << lon << ": 3 to 1";
  EXPECT_EQ(red(view, 179), 200) << "blind for the first";
  EXPECT_EQ(red(view, 0), 100) << "blind for the second";
  for (int lon = -180; lon < 180; ++lon) EXPECT_EQ(validity(view, lon), Validity::Seen);
}

TEST_F(ViewRendererTest, TheSharpestCameraPrevailsAndNoSeamShows) {
  RenderedView rendered(panorama({source(0, PixelFormat::Rgb, 0), source(1, PixelFormat::Rgb, 180)},
                                 Combine::Sharpest));
  set.frames = {plain(PixelFormat::Rgb, 100), plain(PixelFormat::Rgb, 200)};
  const View& view = rendered.render(set, workers);
  EXPECT_LE(red(view, 30), 101);
  EXPECT_GE(red(view, 150), 199);
  for (int lon = -179; lon < 180; ++lon) {
    EXPECT_NEAR(red(view, lon), red(view, lon - 1), 3) << lon;
  }
}

TEST_F(ViewRendererTest, AMissingFrameLeavesItsPartToTheOthers) {
  RenderedView rendered(
      panorama({source(0, PixelFormat::Rgb, 0), source(1, PixelFormat::Rgb, 180)}));
  set.frames = {nullptr, plain(PixelFormat::Rgb, 200)};
  const View& view = rendered.render(set, workers);
  for (const int lon : {15, 90, 180 - 1}) {
    EXPECT_EQ(red(view, lon), 200) << lon;
    EXPECT_EQ(validity(view, lon), Validity::Seen) << lon;
  }
  EXPECT_EQ(validity(view, 0), Validity::Blind) << "only the missing one sees it";
  EXPECT_EQ(red(view, 0), 0);
}

TEST_F(ViewRendererTest, SwitchedViewsShowTheFirstCameraThatSees) {
  RenderedView rendered(panorama({source(0, PixelFormat::Rgb, 0), source(1, PixelFormat::Rgb, 180)},
                                 Combine::Switch));
  set.frames = {plain(PixelFormat::Rgb, 100), plain(PixelFormat::Rgb, 200)};
  const View& view = rendered.render(set, workers);
  EXPECT_EQ(red(view, 90), 100);
  EXPECT_EQ(red(view, 179), 200);
  set.frames[0] = nullptr;
  rendered.render(set, workers);
  EXPECT_EQ(red(view, 90), 200) << "the first has a fault";
  EXPECT_EQ(validity(view, 0), Validity::Blind) << "only the missing one sees it";
  EXPECT_EQ(red(view, 0), 0);
}

TEST_F(ViewRendererTest, KeepsRawCountsBesideTheColours) {
  ViewPlan plan = panorama({source(0, PixelFormat::Grey, 0), source(1, PixelFormat::Y16, 90)});
  plan.measured = 1;
  RenderedView rendered(plan);
  set.frames = {plain(PixelFormat::Grey, 50), plain(PixelFormat::Y16, 40000)};
  const View& view = rendered.render(set, workers);
  EXPECT_TRUE(view.luminance.empty());
  EXPECT_EQ(*view.radiometric.at(180, 90), 40000);
  EXPECT_EQ(*view.radiometric.at(90, 90), 0) << "blind for the measured camera";
  EXPECT_NEAR(red(view, 45), 103, 1) << "both see it; 156 is 40000 of 65535";
  set.frames[1] = nullptr;
  rendered.render(set, workers);
  EXPECT_EQ(*view.radiometric.at(180, 90), 0) << "no stale counts";
}

TEST_F(ViewRendererTest, MeasuresTheLuminanceOfColour) {
  ViewPlan plan = panorama({source(0, PixelFormat::Rgb, 0)});
  plan.measured = 0;
  RenderedView rendered(plan);
  set.frames[0] = plain(PixelFormat::Rgb, 77);
  const View& view = rendered.render(set, workers);
  EXPECT_TRUE(view.radiometric.empty());
  EXPECT_EQ(*view.luminance.at(180, 90), 77);
}

TEST_F(ViewRendererTest, GivesTheSameBytesForAnyNumberOfThreads) {
  const auto plan = panorama({source(0, PixelFormat::Rgb, 10), source(1, PixelFormat::Y16, 170)});
  set.frames = {plain(PixelFormat::Rgb, 90), plain(PixelFormat::Y16, 30000)};
  std::vector<std::vector<std::uint8_t>> results;
  for (const std::size_t threads : {0, 1, 3}) {
    WorkerPool pool(threads);
    RenderedView rendered(plan);
    for (int i = 0; i < 19; ++i) rendered.render(set, pool);
    results.push_back(rendered.render(set, pool).bytes);
  }
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
}

TEST_F(ViewRendererTest, SharedMipLevelsGiveTheSameBytesAsThoseOfOneView) {
  auto frame = std::const_pointer_cast<hal::FrameBuffer>(plain(PixelFormat::Rgb, 0));
  for (std::size_t i = 0; i < frame->capacity; ++i) {
    frame->memory[i] = static_cast<std::byte>(i * 2654435761U >> 24);
  }
  set.frames[0] = frame;
  std::vector<ViewPlan> plans;
  for (const int width : {360, 40, 16}) {
    plans.push_back(panorama({source(0, PixelFormat::Rgb, 0)}));
    plans.back().projection =
        ViewProjection::make({ViewKind::Equirectangular, {}, {}, {}, width, width / 2}).value();
    plans.back().interpolation = remap::Interpolation::Area;
  }
  FramePyramids shared(source_formats(plans[0]));
  MipLevelCounts levels{};
  for (const ViewPlan& plan : plans) ViewRenderer(plan).require_levels(levels);
  EXPECT_GT(levels[0], 0);
  shared.build(set, levels, workers);
  for (const ViewPlan& plan : plans) {
    View view = make_view(plan);
    ViewRenderer(plan).render(set, shared, view, workers);
    EXPECT_EQ(view.bytes, RenderedView(plan).render(set, workers).bytes);
  }
}

}  // namespace
}  // namespace orbwatch::app
