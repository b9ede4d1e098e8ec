// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "proc/align/detect/ball_search.h"
#include "proc/align/detect/centre_votes.h"
#include "proc/align/detect/limb/limb_strip.h"
#include "proc/align/detect/picture/luminance.h"
#include "proc/align/detect/ring/ring_strip.h"
#include "tests/proc/align/detect/any_room.h"
#include "tests/support/picture_of_mat.h"

/// learn_limb_strips FILE RINGS: writes the strips that learn_limb_network.py learns from. FILE:
/// strips around the true limbs of simulated rooms, none of which is used by a gate, each off by
/// some pixels, and around false limbs found by BallSearch, most of them in rooms without a ball.
/// RINGS: strips around the places that slopes point to, and more of them around the balls. Takes
/// some minutes and two gigabytes.
///
/// A strip is, in 32 bit floats: the numbers of its rays and columns and its floor2; for each ray
/// the true limb's distance from the strip's middle, pixels, NaN where it is not in the strip; the
/// slopes along and then across the normal by ray and column, NaN beyond the picture.
namespace {

using namespace orbwatch;
using optics::Outline;

constexpr std::uint64_t kFirstRoom = 100'000, kRooms = 800;
constexpr std::uint64_t kFirstEmptyRoom = 300'000, kEmptyRooms = 160;
constexpr double kAround = 8;                          // px
constexpr std::array kRadii{60.0, 90.0, 90.0, 400.0};  // px: scales around a true limb
constexpr double kOff = 2.5, kOffShape = 0.5;          // px
constexpr std::size_t kMostWrong = 4;                  // for a room with a ball
// Most rings of a room: those that a ball's limb crosses, others, and those of a room without a
// ball.
constexpr std::size_t kMostRings = 7, kMostOtherRings = 6, kMostEmptyRings = 16;
constexpr double kOffRing = 0.13, kFarOffRing = 0.4;  // offset of the centre, radii
constexpr std::size_t kScales = 5, kVotes = 12;       // scales and votes for rings

struct File {
  std::FILE* file;
  std::vector<float> values;

  void write(const align::SlopeStrip& strip, const std::vector<float>& limb) {
    values = {static_cast<float>(strip.rays()), static_cast<float>(strip.columns()),
              strip.floor2()};
    values.insert(values.end(), limb.begin(), limb.end());
    for (const bool is_across : {false, true}) {
      for (int ray = 0; ray < strip.rays(); ++ray) {
        for (int k = 0; k < strip.columns(); ++k) {
          const auto slope = strip.slope(ray, k);
          const float value = slope ? is_across ? slope->across : slope->along
                                    : std::numeric_limits<float>::quiet_NaN();
          values.push_back(value);
        }
      }
    }
    std::fwrite(values.data(), sizeof(float), values.size(), file);
  }
};

/// The distance of `limb` from `outline` along its normal at an angle, NaN beyond kAround.
float distance_at(const Outline& outline, double angle, const Outline& limb) {
  const double c = std::cos(angle), s = std::sin(angle);
  const double length = std::hypot(outline.ry * c, outline.rx * s);
  const double turn = optics::radians(outline.angle), limb_turn = optics::radians(limb.angle);
  const auto beyond = [&](double t) {
    const double x = (outline.rx + outline.ry * t / length) * c;
    const double y = (outline.ry + outline.rx * t / length) * s;
    const double u = outline.centre.u + x * std::cos(turn) - y * std::sin(turn) - limb.centre.u;
    const double v = outline.centre.v + x * std::sin(turn) + y * std::cos(turn) - limb.centre.v;
    return std::hypot((u * std::cos(limb_turn) + v * std::sin(limb_turn)) / limb.rx,
                      (v * std::cos(limb_turn) - u * std::sin(limb_turn)) / limb.ry) > 1;
  };
  double from = -kAround, to = kAround;
  if (beyond(from) || !beyond(to)) return std::numeric_limits<float>::quiet_NaN();
  for (int halving = 0; halving < 24; ++halving) {
    (beyond((from + to) / 2) ? to : from) = (from + to) / 2;
  }
  return static_cast<float>(from);
}

/// The distance of a circular limb from the middle of a ring strip's columns along a ray, in the
/// strip's units; NaN beyond the strip and where `centre` is not within the ball.
float ring_distance(optics::Vec2 centre, double angle, const Outline& limb, int columns) {
  const double u = limb.centre.u - centre.u, v = limb.centre.v - centre.v;
  const double radius = (limb.rx + limb.ry) / 2, far2 = u * u + v * v;
  if (far2 >= radius * radius) return std::numeric_limits<float>::quiet_NaN();
  const double along = u * std::cos(angle) + v * std::sin(angle);
  const double crossing = along + std::sqrt(along * along - far2 + radius * radius);
  const double column =
      std::log(crossing / align::RingStrip::radius(0)) / align::RingStrip::kGrowth;
  if (column <= 0 || column >= columns - 1) return std::numeric_limits<float>::quiet_NaN();
  return static_cast<float>((column - (columns - 1) / 2.0) / align::SlopeStrip::kPerUnit);
}

/// Strips of a room's picture at all scales; the limb is absent in one without a ball.
class Strips {
 public:
  Strips(const cv::Mat& luminance, std::optional<Outline> limb, File& file)
      : pyramid_(luminance), limb_(limb), file_(file) {}

  void add(const Outline& outline, std::size_t level) const {
    constexpr double kSmallest = 14;
    if (std::min(outline.rx, outline.ry) < kSmallest) return;
    const align::LimbStrip strip(pyramid_.level(level), outline, kAround);
    std::vector<float> limb(static_cast<std::size_t>(strip.rays()),
                            std::numeric_limits<float>::quiet_NaN());
    for (std::size_t ray = 0; limb_ && ray < limb.size(); ++ray) {
      const double angle =
          2 * std::numbers::pi * static_cast<double>(ray) / static_cast<double>(limb.size());
      limb[ray] = distance_at(outline, angle, align::Pyramid::between(*limb_, 0, level));
    }
    file_.write(strip, limb);
  }

  void add_rings(std::mt19937_64& random, File& rings) const {
    std::normal_distribution<double> normal(0, 1);
    std::vector<Place> crossed, others;
    for (std::size_t n = 0; n < std::min(kScales, pyramid_.size()); ++n) {
      const std::size_t level = pyramid_.size() - 1 - n;
      const cv::Mat& luminance = pyramid_.level(level);
      Outline limb;
      if (limb_) limb = align::Pyramid::between(*limb_, 0, level);
      constexpr double kNearest = align::RingStrip::kNearest;
      constexpr double kFarthest = align::RingStrip::kFarthest;
      const double farthest = std::min(kFarthest, 0.62 * std::min(luminance.cols, luminance.rows));
      if (farthest < kNearest) continue;
      for (const optics::Vec2 centre :
           align::centre_votes(align::slopes_of(luminance), kNearest, farthest, kVotes)) {
        const double off = std::hypot(limb.centre.u - centre.u, limb.centre.v - centre.v) / limb.rx;
        const bool is_crossed =
            limb_ && off < kFarOffRing && limb.rx > 0.85 * kNearest && limb.rx < 1.15 * kFarthest;
        (is_crossed ? crossed : others).push_back({level, centre});
      }
      if (!limb_ || limb.rx < kNearest || limb.rx > kFarthest) continue;
      for (int i = 0; i < 3; ++i) {
        const double u = limb.centre.u + kOffRing * limb.rx * normal(random);
        crossed.push_back({level, {u, limb.centre.v + kOffRing * limb.rx * normal(random)}});
      }
    }
    write_some(crossed, kMostRings, random, rings);
    write_some(others, limb_ ? kMostOtherRings : kMostEmptyRings, random, rings);
  }

  void add_true(std::mt19937_64& random) const {
    std::normal_distribution<double> normal(0, 1);
    for (const double radius : kRadii) {
      const std::size_t level = pyramid_.level_for(*limb_, radius);
      Outline outline = align::Pyramid::between(*limb_, 0, level);
      outline.centre.u += kOff * normal(random);
      outline.centre.v += kOff * normal(random);
      const double wider = kOff * normal(random), longer = kOffShape * normal(random);
      outline.rx += wider + longer;
      outline.ry += wider - longer;
      add(outline, level);
    }
  }

  void add_wrong(const Outline& outline) const {
    const std::size_t coarse = pyramid_.level_for(outline, 90);
    const std::size_t fine = pyramid_.level_for(outline, 400);
    add(align::Pyramid::between(outline, 0, coarse), coarse);
    if (fine != coarse) add(align::Pyramid::between(outline, 0, fine), fine);
  }

 private:
  struct Place {
    std::size_t level;
    optics::Vec2 centre;
  };

  void write_some(std::vector<Place> places, std::size_t most, std::mt19937_64& random,
                  File& rings) const {
    std::shuffle(places.begin(), places.end(), random);
    places.resize(std::min(places.size(), most));
    for (const auto& [level, centre] : places) {
      const align::RingStrip strip(pyramid_.level(level), centre);
      std::vector<float> limb(static_cast<std::size_t>(strip.rays()),
                              std::numeric_limits<float>::quiet_NaN());
      for (std::size_t ray = 0; limb_ && ray < limb.size(); ++ray) {
        const double angle =
            2 * std::numbers::pi * static_cast<double>(ray) / static_cast<double>(limb.size());
        limb[ray] = ring_distance(centre, angle, align::Pyramid::between(*limb_, 0, level),
                                  strip.columns());
      }
      rings.write(strip, limb);
    }
  }

  align::Pyramid pyramid_;
  std::optional<Outline> limb_;
  File& file_;
};

/// The limb; its longer axis points to the middle of the picture.
Outline true_outline(const tests::MirrorRoomPicture& room) {
  const double u = room.limb.centre.u - (room.pixels.cols - 1) / 2.0;
  const double v = room.limb.centre.v - (room.pixels.rows - 1) / 2.0;
  return {room.limb.centre, room.limb.rx, room.limb.ry, optics::degrees(std::atan2(v, u))};
}

void add_room(std::uint64_t seed, bool ball, File& file, File& rings) {
  tests::MirrorRoomSettings settings = tests::any_room(seed);
  settings.ball = ball;
  const tests::MirrorRoomPicture room = tests::mirror_room(settings);
  const cv::Mat luminance = align::luminance_of(tests::picture_of_mat(room.pixels));
  std::optional<Outline> limb;
  if (ball) limb = true_outline(room);
  const Strips strips(luminance, limb, file);
  std::mt19937_64 random(seed);
  if (ball) strips.add_true(random);
  strips.add_rings(random, rings);
  std::size_t wrong = 0;
  for (const align::FoundLimb& found : align::BallSearch(luminance).run()) {
    const bool is_right =
        ball && align::difference(found.outline, *limb) < std::max(0.02, 3 / limb->rx);
    if (is_right || (ball && wrong == kMostWrong)) continue;
    ++wrong;
    strips.add_wrong(found.outline);
  }
}

using OpenFile = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

OpenFile opened(const char* name) {
  OpenFile file(std::fopen(name, "wb"), std::fclose);
  if (!file) std::perror(name);
  return file;
}

bool is_written(const OpenFile& file) {
  return std::fflush(file.get()) == 0 && std::ferror(file.get()) == 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s FILE RINGS\n", argv[0]);
    return 2;
  }
  const OpenFile out = opened(argv[1]), rings_out = opened(argv[2]);
  if (!out || !rings_out) return 1;
  File file{out.get(), {}}, rings{rings_out.get(), {}};
  for (std::uint64_t n = 0; n < kRooms; ++n) add_room(kFirstRoom + n, true, file, rings);
  for (std::uint64_t n = 0; n < kEmptyRooms; ++n) {
    add_room(kFirstEmptyRoom + n, false, file, rings);
  }
  return is_written(out) && is_written(rings_out) ? 0 : 1;
}
