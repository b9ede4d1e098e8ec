// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/views/view_renderer.h"

#include <gtest/gtest.h>

#include <optional>
#include <tuple>

#include "app/pictures/colour_maps.h"
#include "hal/frame/frame_pool.h"
#include "proc/image/image_view.h"
#include "proc/optics/rotation.h"
#include "tests/app/pipeline/views/rendered_view.h"

namespace orbwatch::app::pipeline {
namespace {

using optics::BallModel;
using optics::BallProjection;
using optics::ViewKind;
using optics::ViewProjection;

constexpr int kPlainSide = 200;

/// Camera whose registration turns it `yaw` degrees around the ball.
ViewSource source(std::size_t camera, PixelFormat format, double yaw, double weight = 1) {
  const auto ball = BallProjection::make(BallModel::make(BallModel::Kind::Exact, 340).value(),
                                         {{99.5, 99.5}, 95, 95, 0}, optics::rotation({yaw, 0, 0}));
  return {camera,
          {format, {}, kPlainSide, kPlainSide, 30},
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

/// Picture of one colour, or of one count for 16 bit.
hal::Frame plain(PixelFormat format, std::uint16_t value) {
  auto buffer = hal::make_frame_pool(format, kPlainSide, kPlainSide, 1).acquire();
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

hal::Frame noise(PixelFormat format) {
  auto frame = std::const_pointer_cast<hal::FrameBuffer>(plain(format, 0));
  for (std::size_t i = 0; i < frame->capacity; ++i) {
    frame->memory[i] = static_cast<std::byte>(i * 2654435761U >> 24);
  }
  return frame;
}

/// Bytes of a plane or a picture, without what it does not use of its memory.
std::string bytes_of(const void* data, std::size_t count) {
  return {static_cast<const char*>(data), count};
}
std::string picture_bytes(const View& view) {
  const auto pixels = static_cast<std::size_t>(view.picture.width) * view.picture.height;
  const bool is_yuv = view.picture.format == PixelFormat::I420;
  return bytes_of(view.picture.planes[0].data,
                  is_yuv ? pixels * 3 / 2 : pixels * info(view.picture.format).channels());
}
std::string measured_bytes(const View& view) {
  const auto pixels = static_cast<std::size_t>(view.validity.width) * view.validity.height;
  return view.luminance.empty() ? bytes_of(view.radiometric.data, 2 * pixels)
                                : bytes_of(view.luminance.data, pixels);
}

std::string validity_bytes(const View& view) {
  return bytes_of(view.validity.data,
                  static_cast<std::size_t>(view.validity.width) * view.validity.height);
}

int red(const View& view, int lon) {
  return view.picture.samples<std::uint8_t>().at(lon + 180, 90)[0];
}
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

TEST_F(ViewRendererTest, AViewIsMadeInTheFormatThatItHas) {
  const ViewPlan plan =
      panorama({source(0, PixelFormat::Rgb, 0), source(1, PixelFormat::Grey, 180)});
  RenderedView rendered(plan);
  set.frames = {plain(PixelFormat::Rgb, 100), plain(PixelFormat::Grey, 200)};
  for (const PixelFormat format : {PixelFormat::Rgb, PixelFormat::Bgr, PixelFormat::Grey}) {
    rendered.set_format(format);
    const View& view = rendered.render(set, workers);
    ASSERT_EQ(view.picture.format, format);
    const auto samples = view.picture.samples<std::uint8_t>();
    EXPECT_EQ(samples.channels, info(format).channels());
    EXPECT_EQ(*samples.at(180, 90), 100);
    EXPECT_EQ(*samples.at(359, 90), 200);
  }
}

TEST_F(ViewRendererTest, WithoutAPictureOnlyWhatIsMeasuredIsMade) {
  ViewPlan plan = panorama({source(0, PixelFormat::Grey, 0), source(1, PixelFormat::Y16, 90)});
  plan.measured = 1;
  RenderedView rendered(plan);
  rendered.set_format(std::nullopt);
  set.frames = {plain(PixelFormat::Grey, 50), plain(PixelFormat::Y16, 40000)};
  const View& view = rendered.render(set, workers);
  EXPECT_EQ(view.picture.planes[0].data, nullptr);
  EXPECT_EQ(*view.radiometric.at(180, 90), 40000);
  EXPECT_EQ(validity(view, 0), Validity::Seen);
}

TEST_F(ViewRendererTest, WithoutAPictureOnlyTheMeasuredSourceIsHalved) {
  ViewPlan plan = panorama({source(0, PixelFormat::Grey, 0), source(1, PixelFormat::Y16, 90)});
  plan.interpolation = remap::Interpolation::Area;
  plan.projection = ViewProjection::make({ViewKind::Equirectangular, {}, {}, {}, 32, 16}).value();
  plan.measured = 1;
  const ViewRenderer renderer(plan);
  PictureUses with, without;
  renderer.add_use(with);
  renderer.add_measured_use(without);
  EXPECT_GT(with[0].mip_levels, 0);
  EXPECT_EQ(without[0].mip_levels, 0);
  EXPECT_EQ(without[1].mip_levels, with[1].mip_levels);
}

TEST_F(ViewRendererTest, WithoutAPictureNothingIsSharpened) {
  ViewPlan plan = panorama({source(0, PixelFormat::Rgb, 0)});
  plan.sources[0].sharpness = 0.8;
  plan.measured = 0;
  const ViewRenderer renderer(plan);
  PictureUses with, without;
  renderer.add_use(with);
  renderer.add_measured_use(without);
  EXPECT_EQ(with[0].sharpened().size(), 1U);
  EXPECT_TRUE(without[0].sharpened().empty());
}

/// Merge of two colour cameras and a thermal one, the measured one of them, and one without a
/// frame.
using Merged = std::tuple<Combine, std::size_t, std::optional<std::size_t>>;

class DrawnAfterItsPlane : public ViewRendererTest, public testing::WithParamInterface<Merged> {
 protected:
  DrawnAfterItsPlane() {
    plan.sources[0].sharpness = 0.8;
    plan.measured = std::get<1>(GetParam());
    set.id = 7;
    set.frames = {noise(PixelFormat::Rgb), noise(PixelFormat::Rgb), noise(PixelFormat::Y16)};
    if (absent) set.frames[*absent] = nullptr;
  }

  void render(View& view) {
    const ViewRenderer renderer(plan);
    FramePyramids pyramids(source_formats(plan), use_of(renderer));
    pyramids.set_match(1, match);
    pyramids.build(set, use_of(renderer), workers);
    renderer.render(set, pyramids, view, workers);
  }
  void measure_and_draw(View& view, const View& at_once) {
    const ViewRenderer renderer(plan);
    FramePyramids pyramids(source_formats(plan), use_of(renderer));
    pyramids.set_match(1, match);
    PictureUses uses;
    renderer.add_measured_use(uses);
    pyramids.build(set, uses, workers);
    renderer.measure(set, pyramids, view, workers);
    EXPECT_EQ(measured_bytes(view), measured_bytes(at_once)) << "before the picture";
    EXPECT_EQ(validity_bytes(view), validity_bytes(at_once)) << "before the picture";
    pyramids.extend(use_of(renderer), workers);
    renderer.draw(pyramids, view, workers);
  }

  const std::optional<std::size_t> absent = std::get<2>(GetParam());
  ViewPlan plan = panorama({source(0, PixelFormat::Rgb, 30), source(1, PixelFormat::Rgb, 150),
                            source(2, PixelFormat::Y16, 90)},
                           std::get<0>(GetParam()));
  const remap::PhotometricTable brighter{{.channels = {{{1.4, 0}, {1.2, 0.01}, {0.8, 0}}}},
                                         PixelFormat::Rgb};
  const remap::PhotometricTable* match = &brighter;
};

TEST_P(DrawnAfterItsPlane, AViewIsAsIfItWereRenderedAtOnce) {
  for (const PixelFormat format : {PixelFormat::Rgb, PixelFormat::I420, PixelFormat::Grey}) {
    View at_once = make_view(plan), view = make_view(plan);
    set_format(at_once, format);
    set_format(view, format);
    render(at_once);
    measure_and_draw(view, at_once);
    EXPECT_EQ(picture_bytes(view), picture_bytes(at_once)) << info(format).name;
    EXPECT_EQ(measured_bytes(view), measured_bytes(at_once)) << info(format).name;
    EXPECT_EQ(validity_bytes(view), validity_bytes(at_once)) << info(format).name;
    EXPECT_EQ(view.frame_set, at_once.frame_set);
    EXPECT_EQ(view.colours[2].has_value(), at_once.colours[2].has_value());
  }
}

/// Otherwise equal pictures would prove nothing about the match.
TEST_P(DrawnAfterItsPlane, ThePictureShowsTheMatchOfACameraThatIsThere) {
  View matched = make_view(plan), as_it_is = make_view(plan);
  set_format(matched, PixelFormat::Rgb);
  set_format(as_it_is, PixelFormat::Rgb);
  render(matched);
  match = nullptr;
  render(as_it_is);
  EXPECT_EQ(picture_bytes(matched) == picture_bytes(as_it_is), absent == 1U);
  EXPECT_EQ(measured_bytes(matched), measured_bytes(as_it_is));
}

INSTANTIATE_TEST_SUITE_P(
    Merges, DrawnAfterItsPlane,
    testing::Combine(testing::Values(Combine::Mix, Combine::Sharpest, Combine::Switch),
                     testing::Values(0, 1, 2), testing::Values(std::nullopt, 0, 1, 2)));

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
  std::vector<UntouchedVector<std::uint8_t>> results;
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
  PictureUses uses;
  for (const ViewPlan& plan : plans) ViewRenderer(plan).add_use(uses);
  EXPECT_GT(uses[0].mip_levels, 0);
  FramePyramids shared(source_formats(plans[0]), uses);
  shared.build(set, uses, workers);
  for (const ViewPlan& plan : plans) {
    View view = make_view(plan);
    set_format(view, PixelFormat::Rgb);
    ViewRenderer(plan).render(set, shared, view, workers);
    EXPECT_EQ(view.bytes, RenderedView(plan).render(set, workers).bytes);
  }
}

/// Panorama of one camera from noise, sharpened by the fixture's amount.
class SharpenedView : public ViewRendererTest, public testing::WithParamInterface<PixelFormat> {
 protected:
  struct Bytes {
    std::vector<std::uint8_t> shown, measured;
  };

  Bytes rendered(double sharpness, bool is_measured, const hal::Frame& frame,
                 remap::Interpolation interpolation = remap::Interpolation::Bilinear) {
    ViewPlan plan = panorama({source(0, GetParam(), 0)});
    plan.sources[0].sharpness = sharpness;
    plan.interpolation = interpolation;
    if (is_measured) plan.measured = 0;
    set.frames[0] = frame;
    RenderedView rendered(plan);
    const View& view = rendered.render(set, workers);
    const auto shown = view.picture.samples<std::uint8_t>();
    Bytes bytes{{shown.data, shown.row(shown.height)}, {}};
    if (is_measured) {
      bytes.measured.assign(view.luminance.data, view.luminance.row(view.luminance.height));
    }
    return bytes;
  }
};

TEST_P(SharpenedView, ShowsColourSharpenedAndMeasuresItAsItIs) {
  const hal::Frame frame = noise(GetParam());
  remap::SharpenedPicture sharpened(GetParam(), kPlainSide, kPlainSide, 0.8);
  sharpened.set_source(frame->picture);
  sharpened.fill({0, 0, kPlainSide, kPlainSide});
  const auto sharp_frame = std::make_shared<hal::FrameBuffer>();
  sharp_frame->picture = sharpened.picture();

  const Bytes as_it_is = rendered(0, true, frame);
  const Bytes both = rendered(0.8, true, frame);
  EXPECT_EQ(both.shown, rendered(0, false, sharp_frame).shown);
  EXPECT_NE(both.shown, as_it_is.shown);
  EXPECT_EQ(both.measured, as_it_is.measured);
  EXPECT_EQ(rendered(0.8, false, frame).shown, both.shown);
}

TEST_P(SharpenedView, ShowsTheNearestPixelsAsTheyAre) {
  const hal::Frame frame = noise(GetParam());
  constexpr auto kNearest = remap::Interpolation::Nearest;
  EXPECT_EQ(rendered(0.8, false, frame, kNearest).shown, rendered(0, false, frame, kNearest).shown);
}

INSTANTIATE_TEST_SUITE_P(Formats, SharpenedView,
                         testing::Values(PixelFormat::Rgb, PixelFormat::Bgra, PixelFormat::Nv12,
                                         PixelFormat::Yuyv, PixelFormat::I420),
                         [](const auto& test) {
                           return std::string(orbwatch::info(test.param).name);
                         });

TEST_F(ViewRendererTest, OneChannelIsNeverSharpened) {
  for (const PixelFormat format : {PixelFormat::Grey, PixelFormat::Y16}) {
    set.frames[0] = noise(format);
    ViewPlan plan = panorama({source(0, format, 0)});
    const auto as_it_is = RenderedView(plan).render(set, workers).bytes;
    plan.sources[0].sharpness = 0.8;
    EXPECT_EQ(RenderedView(plan).render(set, workers).bytes, as_it_is);
  }
}

}  // namespace
}  // namespace orbwatch::app::pipeline
