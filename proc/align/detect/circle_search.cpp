#include "proc/align/detect/circle_search.h"

#include <algorithm>
#include <limits>

namespace orbwatch::align {
namespace {

using optics::Vec2;

constexpr double kSmall = 3000;  // px^2: as if so much of each circle had no evidence
constexpr double kLastStep = 0.03;
constexpr int kRounds = 4;  // per step

}  // namespace

double Circle::rank() const { return evidence / (radius * radius + kSmall); }

Circle best_circle(const Slopes& slopes, const ReflectionLaw& law, Vec2 centre, double nearest,
                   double farthest) {
  const PolarEvidence evidence(slopes, law, centre, nearest, farthest);
  Circle best{centre, nearest, std::numeric_limits<double>::lowest()};
  for (double r = nearest; r <= farthest; r += std::max(0.3, 0.02 * r)) {
    const Circle circle{centre, r, evidence(r)};
    if (circle.rank() > best.rank()) best = circle;
  }
  return best;
}

Circle climb(const Slopes& slopes, const ReflectionLaw& law, const Circle& circle, double first) {
  Circle best = best_circle(slopes, law, circle.centre, (1 - 2 * first) * circle.radius,
                            (1 + 2 * first) * circle.radius);
  for (double share = first; share > kLastStep; share /= 2) {
    for (int round = 0; round < kRounds; ++round) {
      const Circle before = best;
      const double step = share * before.radius;
      for (const Vec2 way : {Vec2{1, 0}, Vec2{-1, 0}, Vec2{0, 1}, Vec2{0, -1}, Vec2{1, 1},
                             Vec2{-1, 1}, Vec2{1, -1}, Vec2{-1, -1}}) {
        const Vec2 centre{before.centre.u + step * way.u, before.centre.v + step * way.v};
        const Circle next = best_circle(slopes, law, centre, (1 - 1.5 * share) * best.radius,
                                        (1 + 1.5 * share) * best.radius);
        if (next.rank() > best.rank()) best = next;
      }
      if (!(best.rank() > before.rank())) break;
    }
  }
  return best;
}

}  // namespace orbwatch::align
