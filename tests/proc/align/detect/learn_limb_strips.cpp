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
#include "proc/align/detect/limb_strip.h"
#include "proc/align/detect/luminance.h"
#include "tests/proc/align/detect/any_room.h"
#include "tests/support/picture_of_mat.h"

/// learn_limb_strips FILE: what learn_limb_network.py learns from. Strips around the true limbs of
/// simulated rooms, none of them a gate's, each off by some pixels, and around what BallSearch
/// takes for limbs and is none, most of it in rooms without a ball. Takes some minutes and a
/// gigabyte.
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
constexpr std::size_t kMostWrong = 4;                  // of a room with a ball

struct File {
  std::FILE* file;
  std::vector<float> values;

  void write(const align::LimbStrip& strip, const std::vector<float>& limb) {
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

/// A room's picture at all scales; the limb is absent in one without a ball.
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

void add_room(std::uint64_t seed, bool ball, File& file) {
  tests::MirrorRoomSettings settings = tests::any_room(seed);
  settings.ball = ball;
  const tests::MirrorRoomPicture room = tests::mirror_room(settings);
  const cv::Mat luminance = align::luminance_of(tests::picture_of_mat(room.pixels));
  std::optional<Outline> limb;
  if (ball) limb = true_outline(room);
  const Strips strips(luminance, limb, file);
  std::mt19937_64 random(seed);
  if (ball) strips.add_true(random);
  std::size_t wrong = 0;
  for (const align::FoundLimb& found : align::BallSearch(luminance).run()) {
    const bool is_right =
        ball && align::difference(found.outline, *limb) < std::max(0.02, 3 / limb->rx);
    if (is_right || (ball && wrong == kMostWrong)) continue;
    ++wrong;
    strips.add_wrong(found.outline);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s FILE\n", argv[0]);
    return 2;
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> out(std::fopen(argv[1], "wb"), std::fclose);
  if (!out) {
    std::perror(argv[1]);
    return 1;
  }
  File file{out.get(), {}};
  for (std::uint64_t n = 0; n < kRooms; ++n) add_room(kFirstRoom + n, true, file);
  for (std::uint64_t n = 0; n < kEmptyRooms; ++n) add_room(kFirstEmptyRoom + n, false, file);
  return std::fflush(out.get()) == 0 && std::ferror(out.get()) == 0 ? 0 : 1;
}
