// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/remap_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/proc/optics/random_camera.h"

namespace orbwatch::fuzz {
namespace {

using optics::BallModel;
using optics::BallProjection;
using optics::ViewKind;

// Values are in whole steps, so that right angles, symmetric rigs and limits occur, unlike with
// arbitrary doubles.

/// Degrees, in tenths.
double angle(FuzzedDataProvider& bytes, double low, double high) {
  return bytes.ConsumeIntegralInRange(std::lround(low * 10), std::lround(high * 10)) / 10.0;
}

/// A share, in hundredths.
double share(FuzzedDataProvider& bytes, double low, double high) {
  return bytes.ConsumeIntegralInRange(std::lround(low * 100), std::lround(high * 100)) / 100.0;
}

optics::YawPitchRoll orientation(FuzzedDataProvider& bytes) {
  return {angle(bytes, -180, 180), angle(bytes, -90, 90), angle(bytes, -180, 180)};
}

int side(FuzzedDataProvider& bytes, int low, int high, bool even) {
  const int length = bytes.ConsumeIntegralInRange(low, high);
  return even ? (length + 1) / 2 * 2 : length;
}

optics::SceneProxy proxy(FuzzedDataProvider& bytes) {
  const auto room = static_cast<optics::Scene::Room>(bytes.ConsumeIntegralInRange(0, 3));
  return tests::scene_around_ball(room, bytes.ConsumeBool());
}

/// The limb's radius, px: from a few pixels to a ball that the picture cuts.
double limb_radius(FuzzedDataProvider& bytes, const SourceSize& source) {
  return std::max(source.width, source.height) * share(bytes, 0.02, 3);
}

Result<BallProjection> outlined_ball(FuzzedDataProvider& bytes, const SourceSize& source) {
  const auto kind = optics::kBallModels[bytes.ConsumeIntegralInRange<std::size_t>(
                                            0, optics::kBallModels.size() - 1)]
                        .value;
  std::optional<double> alpha;
  if (!optics::law(kind).is_orthographic) alpha = angle(bytes, 180.1, 360);
  return BallModel::make(kind, alpha, {}).and_then([&](const BallModel& model) {
    const double radius = limb_radius(bytes, source);
    const optics::Vec2 centre{source.width * share(bytes, -0.2, 1.2),
                              source.height * share(bytes, -0.2, 1.2)};
    const optics::Outline limb{centre, radius, radius * share(bytes, 0.5, 2),
                               angle(bytes, -180, 180)};
    const optics::Mat3 registration = optics::rotation(orientation(bytes));
    return BallProjection::make(model, limb, registration, tests::kBall, proxy(bytes));
  });
}

optics::Intrinsics intrinsics(FuzzedDataProvider& bytes, const SourceSize& source, double focal) {
  optics::Intrinsics lens{source.width,
                          source.height,
                          focal,
                          focal * share(bytes, 0.8, 1.25),
                          source.width * share(bytes, 0.2, 0.8),
                          source.height * share(bytes, 0.2, 0.8)};
  lens.distortion = static_cast<optics::Distortion>(bytes.ConsumeIntegralInRange(0, 2));
  if (lens.distortion == optics::Distortion::None) return lens;
  for (std::size_t k = 0; k < 4; ++k) lens.coefficients[k] = share(bytes, -0.3, 0.3);
  return lens;
}

Result<BallProjection> calibrated_ball(FuzzedDataProvider& bytes, const SourceSize& source) {
  const double distance = 1 + share(bytes, 0.05, 30), limb = std::asin(1 / distance);
  std::mt19937 anywhere(bytes.ConsumeIntegral<std::uint16_t>());
  optics::CalibratedCamera camera = tests::random_camera(
      anywhere, distance, limb * share(bytes, 0, 1.5) * 180 / std::numbers::pi);
  const double focal = limb_radius(bytes, source) / std::tan(limb);
  return optics::Lens::make(intrinsics(bytes, source, focal))
      .and_then([&](const optics::Lens& lens) {
        camera.lens = lens;
        if (bytes.ConsumeIntegralInRange(0, 7) == 7) {  // rare, since it is slow
          camera.window = optics::Window{tests::random_direction(anywhere), share(bytes, 0, 40),
                                         share(bytes, 1, 2)};
        }
        return BallProjection::make(BallModel::Kind::Exact, camera, tests::kBall, proxy(bytes));
      });
}

/// Most are as fine as real views, so that kernels are used; some are anything.
std::optional<double> field_of_view(FuzzedDataProvider& bytes, int pixels, double widest) {
  switch (bytes.ConsumeIntegralInRange(0, 3)) {
    case 0:
      return std::nullopt;
    case 1:
      return angle(bytes, 0.1, widest);
    default:
      return std::min(pixels * share(bytes, 0.05, 1.5), widest);
  }
}

optics::ViewSpec view_spec(FuzzedDataProvider& bytes, bool even) {
  optics::ViewSpec spec;
  spec.kind = static_cast<ViewKind>(bytes.ConsumeIntegralInRange(0, 5));
  const int longest = bytes.ConsumeIntegralInRange(0, 15) == 15 ? 400 : 129;
  spec.width = side(bytes, 1, longest, even);
  spec.height = side(bytes, 1, longest, even);
  if (spec.kind == ViewKind::Ball) return spec;
  spec.orientation = orientation(bytes);
  spec.h_fov = field_of_view(bytes, spec.width, spec.kind == ViewKind::Perspective ? 179.9 : 360);
  spec.v_fov = field_of_view(bytes, spec.height, 179.9);
  return spec;
}

}  // namespace

std::optional<RemapScene> make_scene(FuzzedDataProvider& bytes, bool even) {
  const SourceSize source{side(bytes, 16, kMaxSourceSide, even),
                          side(bytes, 16, kMaxSourceSide, even)};
  const auto ball =
      bytes.ConsumeBool() ? calibrated_ball(bytes, source) : outlined_ball(bytes, source);
  if (!ball) return std::nullopt;
  const auto view = optics::ViewProjection::make(view_spec(bytes, even), *ball);
  if (!view) return std::nullopt;
  return RemapScene(*view, *ball, source);
}

}  // namespace orbwatch::fuzz
