// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/pictures/camera_info.h"

#include <gtest/gtest.h>

#include "proc/optics/rotation.h"

namespace orbwatch::app::dds {
namespace {

using optics::ViewKind;
using optics::ViewSpec;

/// Projects a point of the optical frame by the message.
optics::Vec2 by_message(const CameraInfoMessage& info, const std::array<double, 4>& point) {
  std::array<double, 3> out{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      out[row] += info.p[row * 4 + column] * point[column];
    }
  }
  return {out[0] / out[2], out[1] / out[2]};
}

TEST(CameraInfo, ProjectsAsTheViewDoes) {
  for (const ViewSpec& spec : {ViewSpec{ViewKind::Perspective, {}, {}, {}, 640, 480},
                               ViewSpec{ViewKind::Perspective, {30, -20, 10}, 60, 70, 641, 333},
                               ViewSpec{ViewKind::Perspective, {-120, 5, 0}, 1.5, {}, 99, 1080}}) {
    const std::string frame = "front";
    const auto lens = lens_of(spec);
    ASSERT_TRUE(lens) << lens.error().message;
    const CameraInfoMessage info = camera_info(*lens, frame, {});
    const auto view = optics::ViewProjection::make(spec).value();
    const auto turned = optics::rotation(spec.orientation);
    for (const auto& [right, down] : {std::pair{0.0, 0.0}, {0.2, 0.1}, {-0.01, 0.3}}) {
      // The reference frame has x right, y ahead, z up.
      const auto pixel = view.pixel(optics::normalized(turned * optics::Vec3{right, 1, -down}));
      ASSERT_TRUE(pixel);
      const auto told = by_message(info, {3 * right, 3 * down, 3, 1});
      EXPECT_NEAR(told.u, pixel->u, 1e-9 * spec.width / 0.01);
      EXPECT_NEAR(told.v, pixel->v, 1e-9 * spec.height / 0.01);
    }
  }
}

TEST(CameraInfo, IsThatOfAnUndistortedMonocularCamera) {
  const std::string frame = "front";
  const auto lens = lens_of({ViewKind::Perspective, {}, 90.0, {}, 640, 480}).value();
  const CameraInfoMessage info = camera_info(lens, frame, {17, 18});
  EXPECT_EQ(info.header.stamp.sec, 17);
  EXPECT_EQ(info.header.stamp.nanosec, 18U);
  EXPECT_STREQ(info.header.frame_id, "front");
  EXPECT_EQ(info.width, 640U);
  EXPECT_EQ(info.height, 480U);
  EXPECT_STREQ(info.distortion_model, "plumb_bob");
  ASSERT_EQ(info.d._length, 5U);
  for (std::uint32_t i = 0; i < 5; ++i) EXPECT_EQ(info.d._buffer[i], 0);
  // 90 degrees from edge to edge of 640 pixels.
  const std::array k{320.0, 0.0, 319.5, 0.0, 320.0, 239.5, 0.0, 0.0, 1.0};
  const std::array identity{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_NEAR(info.k[i], k[i], 1e-9) << i;
    EXPECT_EQ(info.r[i], identity[i]) << i;
    EXPECT_EQ(info.p[i / 3 * 4 + i % 3], info.k[i]) << i;
  }
  for (const std::size_t translation : {3, 7, 11}) EXPECT_EQ(info.p[translation], 0);
  EXPECT_EQ(info.binning_x + info.binning_y + info.roi.width + info.roi.height, 0U);
  EXPECT_FALSE(info.roi.do_rectify);
}

TEST(CameraInfo, HasTheDistortionOfALens) {
  struct Case {
    optics::Distortion distortion;
    std::array<double, 8> coefficients;
    const char* model;
    std::uint32_t count;
  };
  const std::string frame = "colour";
  for (const auto& [distortion, coefficients, model, count] :
       {Case{optics::Distortion::None, {}, "plumb_bob", 5},
        Case{optics::Distortion::Pinhole, {-0.2, 0.1, 1e-3, 2e-3, 0.05}, "plumb_bob", 5},
        Case{optics::Distortion::Pinhole,
             {-0.2, 0.1, 1e-3, 2e-3, 0.05, 0.3, 0.01, 2e-3},
             "rational_polynomial",
             8},
        Case{optics::Distortion::Fisheye, {0.1, -0.02, 1e-3, 2e-3}, "equidistant", 4}}) {
    const optics::Intrinsics lens{64, 48, 100, 101, 31, 23, distortion, coefficients};
    const CameraInfoMessage info = camera_info(lens, frame, {});
    EXPECT_STREQ(info.distortion_model, model);
    ASSERT_EQ(info.d._length, count);
    for (std::uint32_t i = 0; i < count; ++i) EXPECT_EQ(info.d._buffer[i], coefficients[i]);
    EXPECT_EQ(info.k[0], 100);
    EXPECT_EQ(info.k[4], 101);
    EXPECT_EQ(info.p[6], 23);
  }
}

TEST(CameraInfo, OtherKindsHaveNone) {
  for (const ViewKind kind : {ViewKind::Equirectangular, ViewKind::Cylindrical,
                              ViewKind::Stereographic, ViewKind::Fisheye}) {
    const auto lens = lens_of({kind, {}, {}, {}, 640, 320});
    ASSERT_FALSE(lens);
    EXPECT_EQ(lens.error().message, "only a perspective view has a camera_info");
  }
  EXPECT_FALSE(lens_of({ViewKind::Ball, {}, {}, {}, 640, 320}));
  EXPECT_FALSE(lens_of({ViewKind::Perspective, {}, 180.0, {}, 640, 320}));
}

}  // namespace
}  // namespace orbwatch::app::dds
