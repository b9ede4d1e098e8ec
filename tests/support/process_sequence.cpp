// SPDX-License-Identifier: Apache-2.0
#include "tests/support/process_sequence.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

namespace orbwatch::tests {
namespace {

using optics::Vec2;
using optics::Vec3;

/// Factor by which the room is traced finer than the camera's pixels.
constexpr int kFine = 2;
/// Margin around the camera's picture for turns, px.
constexpr int kMargin = 12;

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed * 0x9e3779b97f4a7c15ULL + 0x2545f491ULL) {}
  double in(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  bool chance(double probability) { return in(0, 1) < probability; }
  int upto(int limit) { return std::uniform_int_distribution<int>(0, limit)(engine_); }

 private:
  std::mt19937_64 engine_;
};

/// Rodrigues' formula.
cv::Matx33d rotation(const Vec3& r) {
  const double angle = norm(r);
  if (angle == 0) return cv::Matx33d::eye();
  const Vec3 k = r * (1 / angle);
  const cv::Matx33d cross(0, -k.z, k.y, k.z, 0, -k.x, -k.y, k.x, 0);
  return cv::Matx33d::eye() + cross * std::sin(angle) + cross * cross * (1 - std::cos(angle));
}

Vec3 product(const cv::Matx33d& m, const Vec3& v) {
  const cv::Vec3d p = m * cv::Vec3d(v.x, v.y, v.z);
  return {p[0], p[1], p[2]};
}

/// The direction of a camera ray reflected by a unit sphere at `ball`; false when it misses that.
bool reflect(const Vec3& ray, const Vec3& ball, Vec3& out) {
  const double b = dot(ball, ray), root = b * b - (dot(ball, ball) - 1);
  if (root <= 0) return false;
  const Vec3 normal = ray * (b - std::sqrt(root)) - ball;
  out = ray - normal * (2 * dot(ray, normal));
  return true;
}

}  // namespace

/// State that lasts for ten seconds.
struct ProcessSequence::Slot {
  double exposure = 1;
  double offset = 0;  ///< thermal counts
  bool dark = false;
  std::uint64_t lamps = 0;  ///< equal numbers have equal light
  double vibration = 0;     ///< approximate px rms; its mean is 0
  double frequency = 0;
  int sparks = 0;
  bool tool = false;
  double tool_size = 0, tool_turn = 0, tool_speed = 0, tool_tone = 0;
  Vec2 tool_from, tool_to;
};

ProcessSequence::ProcessSequence(const ProcessSettings& settings) : settings_(settings) {
  trace({0.06, -0.04});
  Random random(settings.seed + 99);
  noise_.create(settings.height + 64, settings.width + 64, CV_32F);
  cv::RNG rng(static_cast<std::uint64_t>(random.in(1, 1e9)));
  rng.fill(noise_, cv::RNG::NORMAL, 0, settings.thermal ? 1.5 : 2.0);
}

void ProcessSequence::trace(const Vec2& off_axis) {
  MirrorRoomSettings room;
  room.seed = settings_.seed;
  room.width = kFine * (settings_.width + 2 * kMargin);
  room.height = kFine * (settings_.height + 2 * kMargin);
  room.distance = settings_.distance;
  room.radius = kFine * settings_.radius;
  room.off_axis = off_axis;
  room.limb_hidden = 0.04;
  room.noise = 0;
  room.blur = 1.2;
  room.thermal = settings_.thermal;
  const MirrorRoomPicture picture = mirror_room(room);
  cv::Mat grey = picture.pixels;
  if (!settings_.thermal) cv::cvtColor(picture.pixels, grey, cv::COLOR_BGR2GRAY);
  grey.convertTo(room_, CV_32F);
  focal_length_ = picture.focal_length / kFine;
  ball_ = picture.ball;
  const auto coarse = [](double u) { return (u + 0.5) / kFine - 0.5 - kMargin; };
  limb_ = {{coarse(picture.limb.centre.u), coarse(picture.limb.centre.v)},
           picture.limb.rx / kFine,
           picture.limb.ry / kFine};
  lit_slot_ = -1;
}

void ProcessSequence::shift_ball(const Vec2& off_axis) { trace(off_axis); }

ProcessSequence::Slot ProcessSequence::slot(std::int64_t n) const {
  Random random(settings_.seed * 1000003 + static_cast<std::uint64_t>(n));
  Slot s;
  s.exposure = std::exp2(random.chance(0.5) ? 0 : random.in(-1, 1));
  s.offset = random.in(-40, 40);
  s.dark = n > 0 && random.chance(0.04);
  s.lamps = static_cast<std::uint64_t>(n > 0 ? random.upto(6) : 0);
  s.vibration = random.chance(0.7) ? random.in(0.02, 0.3) : 0;
  s.frequency = random.in(2.5, 4.5);
  s.sparks = random.chance(0.6) ? random.upto(40) : 0;
  s.tool = n > 0 && random.chance(0.7);
  const auto place = [&] {
    return Vec2{limb_.centre.u + settings_.radius * random.in(-1, 1),
                limb_.centre.v + settings_.radius * random.in(-1, 1)};
  };
  s.tool_from = place();
  s.tool_to = place();
  s.tool_size = settings_.radius * random.in(0.1, 0.35);
  s.tool_turn = random.in(0, std::numbers::pi);
  s.tool_speed = random.in(0.02, 0.5);
  s.tool_tone = random.in(0, 1);
  return s;
}

bool ProcessSequence::is_dark(double seconds) const {
  return slot(static_cast<std::int64_t>(seconds / kSlot)).dark;
}

/// Applies the light of lamps: smooth gain, shadows with hard edges, highlights.
void ProcessSequence::light(std::int64_t n, const Slot& s) {
  if (lit_slot_ == n) return;
  lit_slot_ = n;
  lit_ = room_.clone();
  if (s.lamps == 0) return;
  Random random(settings_.seed * 77 + s.lamps);
  const auto place = [&] {
    return cv::Point(cvRound(random.in(0, lit_.cols)), cvRound(random.in(0, lit_.rows)));
  };
  cv::Mat small(12, 16, CV_32F), gain;
  cv::RNG rng(s.lamps * 31 + settings_.seed);
  rng.fill(small, cv::RNG::UNIFORM, settings_.thermal ? 0.998 : 0.5,
           settings_.thermal ? 1.002 : 1.3);
  cv::resize(small, gain, lit_.size(), 0, 0, cv::INTER_CUBIC);
  const double size = kFine * settings_.radius;
  for (int i = random.upto(4); i > 0; --i) {
    std::vector<cv::Point> corners{place(), place(), place()};
    cv::fillConvexPoly(gain, corners, cv::Scalar(settings_.thermal ? 0.999 : random.in(0.4, 0.9)));
  }
  cv::multiply(lit_, gain, lit_);
  const double bright = settings_.thermal ? 9000 : 255;
  for (int i = random.upto(5); i > 0; --i) {
    cv::circle(lit_, place(), cvRound(size * random.in(0.005, 0.05)), cv::Scalar(bright),
               cv::FILLED, cv::LINE_8);
  }
  cv::GaussianBlur(lit_, lit_, {}, 1.0);
}

/// Maps the camera's pixels to those of the traced room.
cv::Matx33d ProcessSequence::warp(double seconds, const Slot& s, const Vec3& turn) const {
  Random random(settings_.seed + static_cast<std::uint64_t>(seconds * 1000));
  // Part of the vibration is slow enough to appear as a wave, the rest as independent offsets of
  // frames.
  const double wave = 2 * std::numbers::pi * s.frequency * seconds, way = s.vibration;
  const double du = way * (std::sin(wave) + 0.7 * random.in(-1.7, 1.7));
  const double dv = way * (0.7 * std::cos(0.9 * wave) + 0.7 * random.in(-1.7, 1.7));
  const double cu = (settings_.width - 1) / 2.0, cv_ = (settings_.height - 1) / 2.0;
  const double f = focal_length_;
  const cv::Matx33d inverse(1 / f, 0, -(cu + du) / f, 0, 1 / f, -(cv_ + dv) / f, 0, 0, 1);
  const cv::Matx33d camera(f * kFine, 0, (cu + 0.5 + kMargin) * kFine - 0.5, 0, f * kFine,
                           (cv_ + 0.5 + kMargin) * kFine - 0.5, 0, 0, 1);
  return camera * rotation(turn).t() * inverse;
}

void ProcessSequence::draw_tool(double seconds, const Slot& s) {
  if (!s.tool) return;
  const double along = 0.5 + 0.5 * std::sin(2 * std::numbers::pi * s.tool_speed * seconds);
  const cv::Point2d middle(std::lerp(s.tool_from.u, s.tool_to.u, along),
                           std::lerp(s.tool_from.v, s.tool_to.v, along));
  const cv::Point2d way(std::cos(s.tool_turn), std::sin(s.tool_turn)), side(-way.y, way.x);
  const double range = settings_.thermal ? 9000 : 255, base = settings_.thermal ? 7300 : 0;
  constexpr int kStripes = 5;
  for (int i = 0; i < kStripes; ++i) {
    const double a = s.tool_size * 2 * (i - kStripes / 2.0), b = a + 2 * s.tool_size;
    std::vector<cv::Point> corners;
    for (const auto& [l, w] : {std::pair{a, -1.0}, {b, -1.0}, {b, 1.0}, {a, 1.0}}) {
      const cv::Point2d p = middle + way * (l / 2) + side * (w * s.tool_size / 2);
      corners.emplace_back(cvRound(p.x * 16), cvRound(p.y * 16));
    }
    const double tone = i % 2 == 0 ? s.tool_tone : 1 - s.tool_tone;
    cv::fillConvexPoly(seen_, corners, cv::Scalar(base + tone * (range - base) * 0.7), cv::LINE_8,
                       4);
  }
}

void ProcessSequence::draw_sparks(double seconds, const Slot& s) {
  Random random(settings_.seed * 13 + static_cast<std::uint64_t>(seconds * 1000));
  const double bright = settings_.thermal ? 30000 : 400;
  for (int i = 0; i < s.sparks; ++i) {
    const double turn = random.in(0, 2 * std::numbers::pi);
    const double away = settings_.radius * std::sqrt(random.in(0, 1.4));
    const cv::Point from(cvRound(limb_.centre.u + away * std::cos(turn)),
                         cvRound(limb_.centre.v + away * std::sin(turn)));
    const cv::Point to = from + cv::Point(random.upto(16) - 8, random.upto(16) - 8);
    cv::line(seen_, from, to, cv::Scalar(bright), 1 + random.upto(1));
  }
}

void ProcessSequence::add_noise(double seconds) {
  Random random(settings_.seed * 17 + static_cast<std::uint64_t>(seconds * 1000));
  seen_ += noise_(cv::Rect({random.upto(64), random.upto(64)}, seen_.size()));
}

const cv::Mat& ProcessSequence::frame(double seconds, const Vec3& turn) {
  const auto n = static_cast<std::int64_t>(seconds / kSlot);
  const Slot s = slot(n);
  light(n, s);
  cv::warpPerspective(lit_, seen_, warp(seconds, s, turn), {settings_.width, settings_.height},
                      cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  draw_tool(seconds, s);
  draw_sparks(seconds, s);
  if (settings_.thermal) {
    seen_ += s.offset;
  } else {
    seen_ *= s.dark ? 0.01 : s.exposure;
  }
  add_noise(seconds);
  seen_.convertTo(frame_, settings_.thermal ? CV_16U : CV_8U);
  return frame_;
}

double true_view_error(double focal_length, const Vec3& stored, const Vec3& true_ball,
                       const Vec3& turn) {
  const cv::Matx33d back = rotation(turn).t();
  const double radius = focal_length / std::sqrt(dot(stored, stored) - 1);
  const Vec2 centre{focal_length * stored.x / stored.z, focal_length * stored.y / stored.z};
  const double lowest = std::cos(optics::radians(150));
  double sum = 0, weight = 0;
  constexpr int kGrid = 160;
  for (int i = 0; i < kGrid * kGrid; ++i) {
    const auto ray = [&](double du, double dv) {
      return optics::normalized(
          {(centre.u + radius * ((i % kGrid + 0.5 + du) / kGrid * 2.04 - 1.02)) / focal_length,
           (centre.v + radius * ((i / kGrid + 0.5 + dv) / kGrid * 2.04 - 1.02)) / focal_length, 1});
    };
    Vec3 here, right, down, really;
    if (!reflect(ray(0, 0), stored, here) || !reflect(ray(0.01, 0), stored, right) ||
        !reflect(ray(0, 0.01), stored, down)) {
      continue;
    }
    if (dot(here, optics::normalized(-stored)) < lowest) continue;
    if (!reflect(product(back, ray(0, 0)), true_ball, really)) continue;
    const double solid_angle = norm(cross(right - here, down - here));
    const double angle = optics::degrees(angle_between(here, really));
    sum += solid_angle * angle * angle;
    weight += solid_angle;
  }
  return std::sqrt(sum / weight);
}

}  // namespace orbwatch::tests
