// SPDX-License-Identifier: Apache-2.0
#include "proc/align/obstacle/standing_box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "proc/align/obstacle/edge_agreement.h"

namespace orbwatch::align {
namespace {

using optics::Box;
using optics::Vec3;

constexpr int kColumns = 7;  // columns of the floor's grid in either direction
constexpr int kHeights = 8;
constexpr std::size_t kCoarsePlaces = 4;    // stride over places on the grid
constexpr std::size_t kImprovedPlaces = 5;  // best boxes of the grid, which are improved
constexpr double kPerPlace = 0.01;     // gain that a box must bring for each place that it covers
constexpr double kFinestShare = 0.05;  // share of the grid's step at which the improvement ends
// Significance thresholds; README.md gives the values that rooms without a box reach.
constexpr double kSignificant = 4.75;
constexpr double kConfirmed = 2.5;

/// Cells of the sphere that count.
enum class Cells { All, Even, Odd };

/// Effect of a box on the agreement.
struct Evidence {
  double gain = 0;  ///< agreement above chance, summed over places
  int places = 0;
  double significance = 0;  ///< significance of the gain, from the spread between cells

  double worth() const { return gain - kPerPlace * places; }
};

class BoxSearch {
 public:
  BoxSearch(const EdgeAgreement& agreement, const Box& walls, const optics::Ball& ball)
      : agreement_(agreement),
        walls_(walls),
        ball_(ball),
        highest_(ball.centre.z - ball.radius / EdgeAgreement::kClosest) {}

  std::optional<Box> best(Cells cells) const {
    std::optional<Box> best;
    double worth = 0;
    for (const Box& candidate : candidates(cells)) {
      const Box box = improved(candidate, cells);
      const auto evidence = weigh(box, cells, 1);
      if (!evidence || evidence->worth() <= worth) continue;
      worth = evidence->worth();
      best = box;
    }
    return best;
  }

  /// nullopt: no box, or one that cuts the ball. `stride`: evaluates every `stride`-th place.
  std::optional<Evidence> weigh(const Box& box, Cells cells, std::size_t stride) const {
    optics::Scene scene;
    scene.obstacles = {box};
    const auto proxy = optics::SceneProxy::make(scene, ball_);
    if (!proxy) return std::nullopt;
    Evidence evidence;
    std::array<double, EdgeAgreement::kCells> gains{};
    for (std::size_t n = 0; n < agreement_.places().size(); n += stride) {
      const EdgeAgreement::Place& place = agreement_.places()[n];
      const bool is_even = place.cell % 2 == 0;
      if (cells != Cells::All && is_even != (cells == Cells::Even)) continue;
      const double closeness = proxy->hit(place.direction).closeness;
      if (closeness <= place.stated) continue;
      const double gain =
          agreement_.above_chance(n, closeness) - agreement_.above_chance(n, place.stated);
      evidence.gain += gain;
      ++evidence.places;
      gains[place.cell] += gain;
    }
    double squares = 0;
    for (const double gain : gains) squares += gain * gain;
    evidence.significance = evidence.gain / std::sqrt(squares + 1e-9);
    return evidence;
  }

 private:
  Vec3 step() const { return (walls_.high - walls_.low) * (1.0 / kColumns); }

  /// Heights are spaced evenly in closeness, which determines the shift in a picture.
  double height(int n) const {
    const double floor = ball_.radius / (ball_.centre.z - walls_.low.z);
    const double closeness =
        std::lerp(floor, EdgeAgreement::kClosest, static_cast<double>(n) / kHeights);
    return ball_.centre.z - ball_.radius / closeness;
  }

  /// All boxes of the grid.
  std::vector<Box> grid() const {
    std::vector<std::pair<int, int>> spans;
    for (int from = 0; from < kColumns; ++from) {
      for (int to = from + 1; to <= kColumns; ++to) spans.emplace_back(from, to);
    }
    std::vector<Box> boxes;
    const Vec3 low = walls_.low;
    for (const auto& [west, east] : spans) {
      for (const auto& [south, north] : spans) {
        for (int n = 1; n <= kHeights; ++n) {
          boxes.push_back({{low.x + west * step().x, low.y + south * step().y, low.z},
                           {low.x + east * step().x, low.y + north * step().y, height(n)}});
        }
      }
    }
    return boxes;
  }

  std::vector<Box> candidates(Cells cells) const {
    std::vector<std::pair<double, Box>> boxes;
    for (const Box& box : grid()) {
      const auto evidence = weigh(box, cells, kCoarsePlaces);
      if (evidence) boxes.emplace_back(evidence->worth(), box);
    }
    const auto count = std::min(kImprovedPlaces, boxes.size());
    std::ranges::partial_sort(boxes, boxes.begin() + static_cast<std::ptrdiff_t>(count),
                              std::greater{}, [](const auto& box) { return box.first; });
    std::vector<Box> best;
    for (std::size_t n = 0; n < count; ++n) best.push_back(boxes[n].second);
    return best;
  }

  /// Moves sides and top in ever smaller steps as long as that improves the box.
  Box improved(Box box, Cells cells) const {
    const auto start = weigh(box, cells, 1);
    double worth = start ? start->worth() : 0;
    for (double share = 0.5; share > kFinestShare / 2; share /= 2) {
      constexpr int kMostRounds = 20;
      bool moved = true;
      for (int round = 0; moved && round < kMostRounds; ++round) {
        moved = false;
        for (const Box& other : neighbours(box, share)) {
          const auto evidence = weigh(other, cells, 1);
          if (!evidence || evidence->worth() <= worth + 1e-9) continue;
          worth = evidence->worth();
          box = other;
          moved = true;
        }
      }
    }
    return box;
  }

  /// Boxes that differ in one side, or in the top.
  std::vector<Box> neighbours(const Box& box, double share) const {
    const Vec3 by = step() * share;
    std::vector<Box> boxes;
    for (const double sign : {-1.0, 1.0}) {
      std::array<Box, 5> moved{box, box, box, box, box};
      moved[0].low.x = std::max(box.low.x + sign * by.x, walls_.low.x);
      moved[1].low.y = std::max(box.low.y + sign * by.y, walls_.low.y);
      moved[2].high.x = std::min(box.high.x + sign * by.x, walls_.high.x);
      moved[3].high.y = std::min(box.high.y + sign * by.y, walls_.high.y);
      moved[4].high.z = std::min(box.high.z + sign * by.z / 2, highest_);
      for (const Box& other : moved) {
        const bool is_box =
            other.low.x < other.high.x && other.low.y < other.high.y && other.low.z < other.high.z;
        if (is_box) boxes.push_back(other);
      }
    }
    return boxes;
  }

  const EdgeAgreement& agreement_;
  Box walls_;
  optics::Ball ball_;
  double highest_;  ///< highest top of a box
};

}  // namespace

Result<StandingBox> find_standing_box(const ReferenceCamera& first, const ReferenceCamera& second,
                                      const optics::Scene& scene) {
  if (scene.room != optics::Scene::Room::Box) return fail("the room must be a stated box");
  const optics::Ball& ball = first.ball.ball();
  if (ball.centre.z - ball.radius / EdgeAgreement::kClosest <= scene.walls.low.z) {
    return fail("the floor is too near to the ball for a box to stand below it");
  }
  const auto agreement = EdgeAgreement::measure(first, second, scene);
  if (!agreement) return tl::unexpected(agreement.error());
  const BoxSearch search(*agreement, scene.walls, ball);
  const auto box = search.best(Cells::All);
  const auto evidence = box ? search.weigh(*box, Cells::All, 1) : std::nullopt;
  if (!evidence || evidence->significance < kSignificant) {
    return fail("no box on the floor makes the pictures agree better than by accident");
  }
  // One half of the cells suggests a box, the other half confirms it; it does not confirm an
  // accidental fit.
  for (const auto& [half, rest] :
       {std::pair{Cells::Even, Cells::Odd}, std::pair{Cells::Odd, Cells::Even}}) {
    const auto suggested = search.best(half);
    const auto confirmed = suggested ? search.weigh(*suggested, rest, 1) : std::nullopt;
    if (!confirmed || confirmed->significance < kConfirmed) {
      return fail("half of what both cameras show does not confirm the box that the rest suggests");
    }
  }
  return StandingBox{*box, evidence->significance};
}

}  // namespace orbwatch::align
