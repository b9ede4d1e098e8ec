#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "proc/align/detect/limb_profile.h"
#include "proc/align/detect/luminance.h"
#include "tests/proc/align/detect/any_room.h"
#include "tests/support/picture_of_mat.h"

/// Counts slopes around the true limbs of simulated rooms, none of them a gate's, and prints
/// proc/align/detect/limb_profile.inc. Takes some minutes.
namespace {

using namespace orbwatch;
using namespace orbwatch::align::limb_profile;

constexpr std::uint64_t kFirstRoom = 20'000, kRooms = 240;
constexpr double kAround = 8;  // px

/// How often each kind was seen, each room once.
struct Counts {
  std::array<std::array<double, kColumns>, kKinds> at;
  std::array<double, kKinds> anywhere;

  /// As if each had been seen a little, since logarithms are taken.
  Counts() {
    constexpr double kPrior = 0.002;
    for (auto& columns : at) columns.fill(kPrior);
    anywhere.fill(kPrior);
  }

  void add(const align::LimbStrip& strip) {
    const double weight = 1.0 / strip.rays();
    for (int ray = 0; ray < strip.rays(); ++ray) {
      for (int k = 0; k < strip.columns(); ++k) {
        const auto slope = strip.slope(ray, k);
        if (!slope) continue;
        const std::size_t n = kind(*slope, strip.floor2());
        anywhere[n] += weight;
        const int column = k - strip.limb() + kFarthest;
        if (column < 0 || column >= static_cast<int>(kColumns)) continue;
        at[n][static_cast<std::size_t>(column)] += weight;
      }
    }
  }
};

/// The limb; its longer axis points to the middle of the picture.
optics::Outline true_outline(const tests::MirrorRoomPicture& room) {
  const double u = room.limb.centre.u - (room.pixels.cols - 1) / 2.0;
  const double v = room.limb.centre.v - (room.pixels.rows - 1) / 2.0;
  return {room.limb.centre, room.limb.rx, room.limb.ry, optics::degrees(std::atan2(v, u))};
}

void print(const Counts& counts) {
  std::array<double, kColumns> columns{};
  double all = 0;
  for (std::size_t n = 0; n < kKinds; ++n) {
    for (std::size_t k = 0; k < kColumns; ++k) columns[k] += counts.at[n][k];
    all += counts.anywhere[n];
  }
  for (std::size_t n = 0; n < kKinds; ++n) {
    for (std::size_t k = 0; k < kColumns; ++k) {
      const double ratio = counts.at[n][k] / columns[k] / (counts.anywhere[n] / all);
      std::printf("%s%.2fF", k == 0 ? "{{" : ", ", std::log(ratio));
    }
    std::puts("}},");
  }
}

}  // namespace

int main() {
  Counts counts;
  for (std::uint64_t n = 0; n < kRooms; ++n) {
    const tests::MirrorRoomPicture room = tests::mirror_room(tests::any_room(kFirstRoom + n));
    const cv::Mat luminance = align::luminance_of(tests::picture_of_mat(room.pixels));
    counts.add(align::LimbStrip(luminance, true_outline(room), kAround));
  }
  print(counts);
}
